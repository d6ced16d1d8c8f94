#include "tools/service/observers.h"

namespace rapidc::service {

Observers::Token Observers::add(Observer observer) {
    observers_.emplace(++last_, std::move(observer));
    return last_;
}

void Observers::remove(Token token) {
    observers_.erase(token);
}

/// An observer may remove itself and add others meanwhile.
template <class Call> void Observers::each(const Call& call) {
    for (auto at = observers_.begin(); at != observers_.end();) {
        const Token token = at->first;
        call(at->second);
        at = observers_.upper_bound(token);
    }
}

void Observers::changed(Change change, const rt::Task* task) {
    each([&](const Observer& observer) {
        if (const auto notify = observer.changed) notify(change, task);
    });
}

void Observers::event(const rt::Event& event) {
    each([&](const Observer& observer) {
        if (const auto notify = observer.event) notify(event);
    });
}

void Observers::signal(rt::SignalId id, double value) {
    each([&](const Observer& observer) {
        if (observer.signal) observer.signal(id, value);
    });
}

void Observers::motion() {
    each([&](const Observer& observer) {
        if (observer.motion) observer.motion();
    });
}

} // namespace rapidc::service
