#include "tools/rws/signal_watches.h"

#include "tools/rws/request_values.h"

#include <algorithm>

namespace rapidc::rws {

class SignalWatches::OneWatch final : public Watch {
  public:
    OneWatch(const std::shared_ptr<Table>& table, uint64_t number) : table_(table), number_(number) {}
    ~OneWatch() override {
        if (const auto table = table_.lock()) table->remove(number_);
    }

  private:
    std::weak_ptr<Table> table_;
    uint64_t number_;
};

void SignalWatches::Table::remove(uint64_t number) {
    listeners.erase(number);
    for (auto& [signal, numbers] : bySignal)
        std::erase(numbers, number);
}

SignalWatches::SignalWatches(service::VirtualController& controller) : controller_(controller) {
    service::Observer observer;
    observer.signal = [this](rt::SignalId signal, double) { tell(signal); };
    observer.changed = [this](service::Change change, const rt::Task*) {
        if (change == service::Change::Generation) beginGeneration();
    };
    token_ = controller_.observers().add(std::move(observer));
}

SignalWatches::~SignalWatches() {
    controller_.observers().remove(token_);
}

Entry SignalWatches::entryOf(const rt::IoSystem& io, rt::SignalId signal) {
    Entry entry;
    entry.type = "ios-signalstate-ev";
    entry.title = io.config(signal).name;
    entry.value("lvalue", shown(io.value(signal)));
    entry.value("lstate", io.isSimulated(signal) ? "simulated" : "not simulated");
    return entry;
}

std::unique_ptr<Watch> SignalWatches::watch(rt::SignalId signal, Changed changed) {
    const uint64_t number = ++table_->last;
    table_->listeners[number] = {controller_.core().io().config(signal).name, std::move(changed)};
    table_->bySignal[signal].push_back(number);
    return std::make_unique<OneWatch>(table_, number);
}

void SignalWatches::tell(rt::SignalId signal) {
    const auto found = table_->bySignal.find(signal);
    if (found == table_->bySignal.end() || found->second.empty()) return;
    const Entry entry = entryOf(controller_.core().io(), signal);
    for (const uint64_t number : std::vector(found->second)) { // one of them may end a watch
        const auto listener = table_->listeners.find(number);
        if (listener != table_->listeners.end()) listener->second.changed(entry);
    }
}

void SignalWatches::beginGeneration() {
    table_->bySignal.clear();
    const rt::IoSystem& io = controller_.core().io();
    for (const auto& [number, listener] : table_->listeners)
        if (const rt::SignalId signal = io.find(listener.name); signal >= 0)
            table_->bySignal[signal].push_back(number);
    std::vector<rt::SignalId> signals;
    for (const auto& [signal, numbers] : table_->bySignal)
        signals.push_back(signal);
    std::sort(signals.begin(), signals.end());
    for (const rt::SignalId signal : signals)
        tell(signal);
}

} // namespace rapidc::rws
