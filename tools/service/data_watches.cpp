#include "tools/service/data_watches.h"

#include "tools/service/virtual_controller.h"

#include <cstring>
#include <utility>

namespace rapidc::service {

DataWatches::DataWatches(VirtualController& controller) : controller_(controller) {
    Observer observer;
    observer.changed = [this](Change change, const rt::Task*) {
        if (change == Change::Generation || change == Change::Modules)
            findAgain(change == Change::Generation);
    };
    observer_ = controller_.observers().add(std::move(observer));
}

DataWatches::~DataWatches() {
    controller_.observers().remove(observer_);
    if (schedulerWatch_ != 0) controller_.core().scheduler().unwatchData(schedulerWatch_);
}

DataWatches::Token DataWatches::add(DataPath path, std::function<void(const std::string&)> changed) {
    Watched& watched = watches_[++last_];
    watched.path = std::move(path);
    watched.changed = std::move(changed);
    find(watched);
    attach();
    return last_;
}

void DataWatches::remove(Token token) {
    watches_.erase(token);
    attach();
}

void DataWatches::attach() {
    const bool isWatching = schedulerWatch_ != 0;
    if (isWatching == !watches_.empty()) return;
    rt::Scheduler& scheduler = controller_.core().scheduler();
    if (isWatching)
        scheduler.unwatchData(std::exchange(schedulerWatch_, 0));
    else
        schedulerWatch_ = scheduler.watchData([this] { look(); });
}

void DataWatches::find(Watched& watched) {
    watched.found = findData(controller_, watched.path);
    watched.last.clear();
    if (watched.found.data != nullptr)
        watched.last.assign(static_cast<const char*>(watched.found.data), watched.found.bytes());
}

void DataWatches::findAgain(bool anotherController) {
    if (anotherController) {
        schedulerWatch_ = 0; // it went with its controller
        attach();
    }
    for (auto& [token, watched] : watches_) {
        const std::string before = watched.last;
        find(watched);
        if (watched.found.data != nullptr && watched.last != before)
            if (const auto value = valueOf(watched.found)) watched.changed(*value);
    }
}

void DataWatches::look() {
    for (auto& [token, watched] : watches_) {
        if (watched.found.data == nullptr ||
            std::memcmp(watched.found.data, watched.last.data(), watched.last.size()) == 0)
            continue;
        watched.last.assign(static_cast<const char*>(watched.found.data), watched.last.size());
        if (const auto value = valueOf(watched.found)) watched.changed(*value);
    }
}

} // namespace rapidc::service
