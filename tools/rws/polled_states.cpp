#include "tools/rws/polled_states.h"

namespace rapidc::rws {

namespace {

class PolledWatch final : public Watch {
  public:
    PolledWatch(Subscribables::Polls& polls, std::function<Entry()> read, Changed changed)
        : polls_(polls), read_(std::move(read)), changed_(std::move(changed)), last_(read_()),
          place_(polls.insert(polls.end(), [this] { look(); })) {}
    ~PolledWatch() override { polls_.erase(place_); }
    PolledWatch(const PolledWatch&) = delete;
    PolledWatch& operator=(const PolledWatch&) = delete;

    const Entry& entry() const { return last_; }

  private:
    void look() {
        Entry now = read_();
        if (now.values == last_.values) return;
        last_ = std::move(now);
        changed_(last_);
    }

    Subscribables::Polls& polls_;
    std::function<Entry()> read_;
    Changed changed_;
    Entry last_;
    Subscribables::Polls::iterator place_;
};

} // namespace

std::optional<Failure> watchPolled(const Subscribables& subscribables, std::function<Entry()> read,
                                   Changed changed, Subscription& out) {
    auto watch = std::make_unique<PolledWatch>(subscribables.polls(), std::move(read), std::move(changed));
    out.initial.push_back(watch->entry());
    out.watch = std::move(watch);
    return std::nullopt;
}

} // namespace rapidc::rws
