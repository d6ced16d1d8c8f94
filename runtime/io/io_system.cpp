// IoSystem: values, changes, delays and pulses. Reading EIO parameters: io_configure.cpp.

#include "runtime/io/io_system.h"

#include "runtime/base/text_util.h"
#include "runtime/io/signal.h"
#include "runtime/sched/scheduler.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rt {

const char* signalTypeName(SignalType type) {
    switch (type) {
    case SignalType::DI: return "DI";
    case SignalType::DO: return "DO";
    case SignalType::AI: return "AI";
    case SignalType::AO: return "AO";
    case SignalType::GI: return "GI";
    case SignalType::GO: return "GO";
    }
    return "";
}

IoSystem::IoSystem(Scheduler& scheduler) : scheduler_(scheduler) {}
IoSystem::~IoSystem() = default;

// ---- Names and handles ---------------------------------------------------------------------------------------------

SignalId IoSystem::addSignal(SignalConfig config) {
    const auto id = static_cast<SignalId>(signals_.size());
    if (!names_.emplace(upperCase(config.name), id).second) return -1;
    devices_.addDevice(config.device);
    auto signal = std::make_unique<Signal>();
    signal->value = config.defaultValue;
    signal->config = std::move(config);
    signals_.push_back(std::move(signal));
    return id;
}

SignalId IoSystem::find(std::string_view name) const {
    const auto found = names_.find(upperCase(name));
    return found == names_.end() ? -1 : found->second;
}

const SignalConfig& IoSystem::config(SignalId id) const {
    return signals_[static_cast<std::size_t>(id)]->config;
}

SignalId IoSystem::idOf(Handle handle) const {
    return handle < 1 || handle > static_cast<Handle>(signals_.size()) ? -1
                                                                       : static_cast<SignalId>(handle - 1);
}

Handle IoSystem::undefinedHandle(const std::string& name) {
    undefined_.push_back(name);
    return -static_cast<Handle>(undefined_.size());
}

std::string IoSystem::undefinedName(Handle handle) const {
    const auto index = static_cast<std::size_t>(-(handle + 1));
    return handle < 0 && index < undefined_.size() ? undefined_[index] : std::string();
}

IoSystem::Signal* IoSystem::byHandle(Handle handle) {
    const SignalId id = idOf(handle);
    return id < 0 ? nullptr : signals_[static_cast<std::size_t>(id)].get();
}

// ---- Values --------------------------------------------------------------------------------------------------------

double IoSystem::value(SignalId id) const {
    return signals_[static_cast<std::size_t>(id)]->value;
}

double IoSystem::read(Handle handle, IoResult& result) const {
    result = access(handle);
    return result == IoResult::NoSignal ? 0 : value(idOf(handle));
}

IoResult IoSystem::access(Handle handle) const {
    const SignalId id = idOf(handle);
    if (id < 0) return IoResult::NoSignal;
    const Signal& signal = *signals_[static_cast<std::size_t>(id)];
    return signal.deviceOff ? IoResult::DeviceOff : signal.invalid ? IoResult::NotValid : IoResult::Ok;
}

void IoSystem::setReachable(std::string_view device, bool reachable) {
    for (const auto& signal : signals_) {
        if (!sameName(signal->config.device, device)) continue;
        signal->deviceOff = !reachable;
        signal->changed.notifyAll();
    }
}

void IoSystem::setValid(SignalId id, bool valid) {
    Signal& signal = *signals_[static_cast<std::size_t>(id)];
    signal.invalid = !valid;
    signal.changed.notifyAll();
}

IoResult IoSystem::normalise(const SignalConfig& config, double& value) {
    // Programs read the value as a num.
    if (!(std::fabs(value) <= static_cast<double>(std::numeric_limits<float>::max())))
        return IoResult::OutOfRange;
    if (isDigital(config.type)) {
        value = value != 0 ? 1 : 0;
        return IoResult::Ok;
    }
    if (isGroup(config.type)) value = std::round(value);
    return value < config.minValue || value > config.maxValue ? IoResult::OutOfRange : IoResult::Ok;
}

IoResult IoSystem::check(Handle handle, double value, bool forOutput) const {
    const SignalId id = idOf(handle);
    if (id < 0) return IoResult::NoSignal;
    const SignalConfig& signal = config(id);
    if (forOutput && (isInput(signal.type) || !signal.writable)) return IoResult::NotWritable;
    return normalise(signal, value);
}

IoResult IoSystem::checkWrite(Handle handle, double& value, Signal*& signal) {
    signal = byHandle(handle);
    const IoResult result = check(handle, value, true);
    if (result != IoResult::Ok) return result;
    if (const IoResult access = this->access(handle); access != IoResult::Ok) return access;
    normalise(signal->config, value);
    return IoResult::Ok;
}

void IoSystem::cancelPending(Signal& signal) {
    if (signal.pending == Pending::None) return;
    scheduler_.cancel(signal.event);
    if (signal.pending == Pending::Delay) --delayed_;
    signal.pending = Pending::None;
}

IoResult IoSystem::set(Handle handle, double value) {
    Signal* signal = nullptr;
    const IoResult result = checkWrite(handle, value, signal);
    if (result != IoResult::Ok) return result;
    cancelPending(*signal);
    change(idOf(handle), value, true);
    return IoResult::Ok;
}

IoResult IoSystem::setDelayed(Handle handle, double value, Time delay) {
    if (delay <= 0) return set(handle, value);
    Signal* signal = nullptr;
    const IoResult result = checkWrite(handle, value, signal);
    if (result != IoResult::Ok) return result;
    if (delay > kMaxSpan) return IoResult::BadTime;
    if (signal->pending != Pending::Delay && delayed_ >= kMaxDelays) return IoResult::TooManyDelays;
    cancelPending(*signal);
    signal->pending = Pending::Delay;
    ++delayed_;
    const SignalId id = idOf(handle);
    signal->event = scheduler_.after(delay, [this, id, value, signal] {
        signal->pending = Pending::None;
        --delayed_;
        change(id, value, false); // delays are not carried over by cross connections (manual 2.10)
    });
    return IoResult::Ok;
}

IoResult IoSystem::pulse(Handle handle, Time length, bool high) {
    Signal* signal = nullptr;
    double value = 0;
    const IoResult result = checkWrite(handle, value, signal);
    if (result != IoResult::Ok) return result;
    if (!isDigital(signal->config.type)) return IoResult::NotWritable;
    if (length < kMinSpan || length > kMaxSpan) return IoResult::BadTime;
    const bool running = signal->pending == Pending::Pulse;
    // A pulse ordered during a pulse makes it longer; its end brings back what was before the first.
    const double during = high ? 1 : running ? signal->value : 1 - signal->value;
    cancelPending(*signal);
    signal->pending = Pending::Pulse;
    const SignalId id = idOf(handle);
    signal->event = scheduler_.after(length, [this, id, during, signal] {
        signal->pending = Pending::None;
        change(id, 1 - during, false); // neither are pulses
    });
    change(id, during, false);
    return IoResult::Ok;
}

IoResult IoSystem::invert(Handle handle) {
    IoResult result{};
    const double present = read(handle, result);
    return result == IoResult::Ok ? set(handle, present == 0 ? 1 : 0) : result;
}

void IoSystem::powerOn() {
    for (SignalId id = 0; id < static_cast<SignalId>(signals_.size()); ++id) {
        Signal& signal = *signals_[static_cast<std::size_t>(id)];
        cancelPending(signal);
        if (isInput(signal.config.type) || signal.config.store || signal.driven) continue;
        change(id, signal.config.defaultValue, true);
    }
}

IoResult IoSystem::force(SignalId id, double value) {
    if (id < 0 || id >= static_cast<SignalId>(signals_.size())) return IoResult::NoSignal;
    Signal& signal = *signals_[static_cast<std::size_t>(id)];
    if (isInput(signal.config.type) && signal.driven) return IoResult::NotWritable;
    const IoResult result = normalise(signal.config, value);
    if (result != IoResult::Ok) return result;
    cancelPending(signal);
    change(id, value, true);
    return IoResult::Ok;
}

void IoSystem::simulate(SignalId id, bool on) {
    Signal& signal = *signals_[static_cast<std::size_t>(id)];
    if (signal.isSimulated == on) return;
    if (on) signal.plantValue = signal.value;
    signal.isSimulated = on;
    if (!on && isInput(signal.config.type)) assign(id, signal.plantValue, true);
}

bool IoSystem::isSimulated(SignalId id) const {
    return signals_[static_cast<std::size_t>(id)]->isSimulated;
}

IoResult IoSystem::setByClient(SignalId id, double value) {
    if (id < 0 || id >= static_cast<SignalId>(signals_.size())) return IoResult::NoSignal;
    const Signal& signal = *signals_[static_cast<std::size_t>(id)];
    if (!signal.isSimulated || !isInput(signal.config.type)) return force(id, value);
    const IoResult result = normalise(signal.config, value);
    if (result == IoResult::Ok) assign(id, value, true);
    return result;
}

// ---- Changes -------------------------------------------------------------------------------------------------------

WaitQueue& IoSystem::changed(SignalId id) {
    return signals_[static_cast<std::size_t>(id)]->changed;
}

uint64_t IoSystem::addListener(SignalId id, Listener listener) {
    listeners_.push_back({++lastListener_, id, std::move(listener)});
    return lastListener_;
}

void IoSystem::removeListener(uint64_t number) {
    for (ListenerEntry& entry : listeners_) {
        if (entry.number == number) entry.number = 0;
    }
    if (calling_ == 0)
        std::erase_if(listeners_, [](const ListenerEntry& entry) { return entry.number == 0; });
}

void IoSystem::change(SignalId id, double value, bool propagate) {
    Signal& signal = *signals_[static_cast<std::size_t>(id)];
    if (signal.isSimulated && isInput(signal.config.type))
        signal.plantValue = value;
    else
        assign(id, value, propagate);
}

void IoSystem::assign(SignalId id, double value, bool propagate) {
    Signal& signal = *signals_[static_cast<std::size_t>(id)];
    const double old = signal.value;
    if (old == value) return;
    signal.value = value;
    ++calling_;
    // By index: a listener may add others; those are not called for this change.
    for (std::size_t i = 0, count = listeners_.size(); i < count; ++i) {
        if (listeners_[i].number == 0 || (listeners_[i].signal >= 0 && listeners_[i].signal != id)) continue;
        const Listener call = listeners_[i].call;
        call(id, old, value);
    }
    if (--calling_ == 0)
        std::erase_if(listeners_, [](const ListenerEntry& entry) { return entry.number == 0; });
    signal.changed.notifyAll();
    if (propagate) propagateFrom(id);
}

// ---- Cross connections ---------------------------------------------------------------------------------------------

bool IoSystem::reaches(SignalId from, SignalId to) const {
    std::vector<SignalId> open{from};
    std::vector<bool> seen(signals_.size(), false);
    while (!open.empty()) {
        const SignalId at = open.back();
        open.pop_back();
        if (at == to) return true;
        if (seen[static_cast<std::size_t>(at)]) continue;
        seen[static_cast<std::size_t>(at)] = true;
        for (const CrossConnection& connection : connections_) {
            const auto isActor = [at](const CrossActor& actor) { return actor.signal == at; };
            if (std::any_of(connection.actors.begin(), connection.actors.end(), isActor)) {
                open.push_back(connection.result);
            }
        }
    }
    return false;
}

bool IoSystem::addCrossConnection(CrossConnection connection) {
    for (const CrossActor& actor : connection.actors) {
        if (reaches(connection.result, actor.signal)) return false;
    }
    signals_[static_cast<std::size_t>(connection.result)]->driven = true;
    connections_.push_back(std::move(connection));
    return true;
}

double IoSystem::evaluate(const CrossConnection& connection) const {
    const SignalType type = config(connection.result).type;
    if (isGroup(type) && connection.actors.size() == 1 && !connection.actors.front().inverted) {
        double whole = value(connection.actors.front().signal);
        return normalise(config(connection.result), whole) == IoResult::Ok ? whole : value(connection.result);
    }
    bool result = false;
    for (std::size_t i = 0; i < connection.actors.size(); ++i) {
        const CrossActor& actor = connection.actors[i];
        const bool on = (value(actor.signal) != 0) != actor.inverted;
        if (i == 0)
            result = on;
        else if (connection.operators[i - 1] == CrossOperator::And)
            result = result && on;
        else
            result = result || on;
    }
    return result ? 1 : 0;
}

void IoSystem::propagateFrom(SignalId id) {
    for (std::size_t i = 0; i < connections_.size(); ++i) {
        const CrossConnection& connection = connections_[i];
        const auto isActor = [id](const CrossActor& actor) { return actor.signal == id; };
        if (std::none_of(connection.actors.begin(), connection.actors.end(), isActor)) continue;
        cancelPending(*signals_[static_cast<std::size_t>(connection.result)]);
        change(connection.result, evaluate(connection), true);
    }
}

} // namespace rt
