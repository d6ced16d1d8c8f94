#include "tools/rws/state_watch.h"

namespace rapidc::rws {

namespace {

class StateWatch final : public Watch {
  public:
    StateWatch(service::Observers& observers, std::set<service::Change> changes, std::function<Entry()> read,
               Changed changed)
        : observers_(observers), changes_(std::move(changes)), read_(std::move(read)),
          changed_(std::move(changed)), last_(read_()) {
        changes_.insert(service::Change::Generation);
        service::Observer observer;
        observer.changed = [this](service::Change change, const rt::Task*) {
            if (changes_.contains(change)) look();
        };
        token_ = observers_.add(std::move(observer));
    }
    ~StateWatch() override { observers_.remove(token_); }
    StateWatch(const StateWatch&) = delete;
    StateWatch& operator=(const StateWatch&) = delete;

    const Entry& entry() const { return last_; }

  private:
    void look() {
        Entry now = read_();
        if (now.values == last_.values) return;
        last_ = std::move(now);
        changed_(last_);
    }

    service::Observers& observers_;
    std::set<service::Change> changes_;
    std::function<Entry()> read_;
    Changed changed_;
    Entry last_;
    service::Observers::Token token_ = 0;
};

} // namespace

std::optional<Failure> watchState(service::Observers& observers, std::set<service::Change> changes,
                                  std::function<Entry()> read, Changed changed, Subscription& out) {
    auto watch =
        std::make_unique<StateWatch>(observers, std::move(changes), std::move(read), std::move(changed));
    out.initial.push_back(watch->entry());
    out.watch = std::move(watch);
    return std::nullopt;
}

} // namespace rapidc::rws
