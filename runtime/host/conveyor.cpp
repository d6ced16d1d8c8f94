#include "runtime/host/conveyor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace rt {

namespace {

constexpr double kNear = 1e-6;                   // mm; rounding of times
constexpr Time kPulse = 20 * kMillisecond;       // of signals that report something
constexpr Time kShowPeriod = 100 * kMillisecond; // of position signals while an object is connected
constexpr double kCounterRange = 4294967296.0;   // 32 bits

constexpr ConveyorSignal kConveyorSignals[] = {
    {"ObjectsInQ", SignalType::GI, 16},  {"CntFromEnc", SignalType::GI, 32},
    {"CntToEnc", SignalType::GO, 32},    {"Counts", SignalType::GI, 32},
    {"Position", SignalType::AI, 1},     {"Speed", SignalType::AI, 1},
    {"NewObjStrobe", SignalType::DI, 1}, {"PassStw", SignalType::DI, 1},
    {"Connected", SignalType::DI, 1},    {"NullSpeed", SignalType::DI, 1},
    {"DirOfTravel", SignalType::DI, 1},  {"Simulating", SignalType::DI, 1},
    {"CntToEncStr", SignalType::DO, 1},  {"PosInJobQ", SignalType::DO, 1},
    {"Rem1PObj", SignalType::DO, 1},     {"RemAllPObj", SignalType::DO, 1},
    {"DropWObj", SignalType::DO, 1},     {"SoftSyncSig", SignalType::DO, 1},
    {"SimMode", SignalType::DO, 1},
};

} // namespace

std::span<const ConveyorSignal> allConveyorSignals() {
    return kConveyorSignals;
}

/// The connected object. It outlives the connection as long as movements refer to it.
class Conveyor::Link final : public motion::TrackedObject {
  public:
    Link(std::shared_ptr<const Belt> belt, const ConveyorSettings& settings, double origin)
        : belt_(std::move(belt)), settings_(settings), origin_(origin) {}

    double position(motion::TimeNs time) const override { return belt_->position(time) - origin_; }
    double speed(motion::TimeNs time) const override { return belt_->speed(time); }
    motion::Pose frame(double position) const override {
        motion::Pose moved;
        if (settings_.rotating)
            moved.rot = robot::fromAxisAngle({0, 0, 1}, position);
        else
            moved.pos.x = position;
        return settings_.base * moved;
    }
    bool isConnected() const override { return isConnected_; }
    double adjustmentSpeed() const override { return settings_.adjustmentSpeed; }
    double adjustmentAcceleration() const override { return settings_.adjustmentAcceleration; }

    double origin() const { return origin_; }
    void end() { isConnected_ = false; }

  private:
    std::shared_ptr<const Belt> belt_;
    ConveyorSettings settings_;
    double origin_;
    bool isConnected_ = true;
};

Conveyor::Conveyor(Scheduler& scheduler, IoSystem& io, EventLog& log, ConveyorSettings settings)
    : scheduler_(scheduler), io_(io), log_(log), settings_(std::move(settings)),
      belt_(std::make_shared<Belt>(settings_.speed, settings_.acceleration)) {
    if (settings_.every > 0) nextObject_ = settings_.every;
}

Conveyor::~Conveyor() {
    for (const uint64_t listener : listeners_)
        io_.removeListener(listener);
}

// ---- Signals ---------------------------------------------------------------------------------------------------------

void Conveyor::addSignals() {
    for (const ConveyorSignal& kind : kConveyorSignals)
        addSignal(kind.name, kind.type, kind.bits);
}

void Conveyor::addSignal(const char* name, SignalType type, uint32_t bits) {
    if (signal(name) >= 0) return;
    SignalConfig config;
    config.name = settings_.prefix + name;
    config.type = type;
    config.bits = bits;
    config.maxValue = isGroup(type) ? std::exp2(bits) - 1 : 1;
    if (isAnalog(type)) config.minValue = -1e9, config.maxValue = 1e9;
    io_.addSignal(std::move(config));
}

void Conveyor::onSignal(const char* name, std::function<void()> action) {
    const SignalId id = signal(name);
    if (id < 0) return;
    listeners_.push_back(io_.addListener(id, [action = std::move(action)](SignalId, double, double value) {
        if (value != 0) action();
    }));
}

void Conveyor::show(const char* name, double value) {
    const SignalId id = signal(name);
    if (id >= 0 && io_.value(id) != value) io_.force(id, value);
}

void Conveyor::pulse(const char* name) {
    if (signal(name) < 0) return;
    show(name, 1);
    scheduler_.after(kPulse, [this, name] { show(name, 0); });
}

double Conveyor::counts(double position) const {
    const double unit = settings_.rotating ? 360.0 : 1000.0;
    const double whole = std::round(position * settings_.countsPerMetre / unit);
    return whole - kCounterRange * std::floor(whole / kCounterRange);
}

void Conveyor::showSignals() {
    const double unit = settings_.rotating ? 1 : 1e-3;
    const auto rounded = [](double value) { return std::round(value * 1e4) / 1e4; };
    show("ObjectsInQ", static_cast<double>(queue_.size() + (link_ ? 1 : 0)));
    show("Connected", link_ ? 1 : 0);
    show("Position", rounded(link_ ? connectedPosition() * unit : 0));
    show("Speed", rounded(speed() * unit));
    show("NullSpeed", speed() == 0 ? 1 : 0);
    show("DirOfTravel", speed() < 0 ? 1 : 0);
    show("Counts", counts(position()));
}

void Conveyor::begin() {
    onSignal("Rem1PObj", [this] { removeFirst(); });
    onSignal("RemAllPObj", [this] { removeAll(); });
    onSignal("DropWObj", [this] {
        if (link_) lose("signal " + settings_.prefix + "DropWObj has dropped it");
    });
    onSignal("SoftSyncSig", [this] { objectAtSync(); });
    onSignal("CntToEncStr", [this] { // an object from a queue that the program keeps
        const SignalId id = signal("CntToEnc");
        if (id < 0) return;
        const double unit = settings_.rotating ? 360.0 : 1000.0;
        const double now = counts(position()), then = io_.value(id);
        const double ago = now >= then ? now - then : now - then + kCounterRange;
        addObject(ago * unit / settings_.countsPerMetre - settings_.sync);
    });
    if (const SignalId id = signal("SimMode"); id >= 0)
        listeners_.push_back(
            io_.addListener(id, [this](SignalId, double, double value) { show("Simulating", value); }));
    showSignals();
    schedule();
}

// ---- The belt --------------------------------------------------------------------------------------------------------

void Conveyor::setSpeed(double speed) {
    belt_->setSpeed(scheduler_.now(), speed);
    showSignals();
    schedule();
    for (const auto& action : speedActions_)
        action();
    changed_.notifyAll();
}

double Conveyor::speed() const {
    return belt_->speed(scheduler_.now());
}

double Conveyor::position() const {
    return belt_->position(scheduler_.now());
}

robot::Pose Conveyor::frame(double position) const {
    return Link(belt_, settings_, 0).frame(position);
}

// ---- Objects ---------------------------------------------------------------------------------------------------------

void Conveyor::setActive(bool active) {
    if (isActive_ == active) return;
    isActive_ = active;
    if (!active) {
        queue_.clear();
        drop();
    }
    showSignals();
    schedule();
    changed_.notifyAll();
}

void Conveyor::objectAtSync(double ahead) {
    const double here = position() - ahead;
    if (lastSync_ && std::fabs(here - *lastSync_) < settings_.separation) return;
    lastSync_ = here;
    show("CntFromEnc", counts(here));
    pulse("NewObjStrobe");
    const SignalId manual = signal("PosInJobQ");
    if (manual >= 0 && io_.value(manual) != 0) return; // the program keeps the queue
    addObject(ahead - settings_.sync);
}

void Conveyor::addObject(double position) {
    if (!isActive_) return;
    const double origin = this->position() - position;
    queue_.insert(std::upper_bound(queue_.begin(), queue_.end(), origin), origin);
    passWindow();
    showSignals();
    schedule();
    changed_.notifyAll();
}

void Conveyor::removeFirst() {
    if (queue_.empty()) return;
    queue_.pop_front();
    showSignals();
    schedule();
}

void Conveyor::removeAll() {
    queue_.clear();
    showSignals();
    schedule();
}

bool Conveyor::hasObjectInWindow() const {
    return !queue_.empty() && objectPosition(queue_.front()) >= -kNear;
}

std::shared_ptr<const motion::TrackedObject> Conveyor::connected() const {
    return link_;
}

double Conveyor::connectedPosition() const {
    return link_ ? objectPosition(link_->origin()) : 0;
}

std::shared_ptr<const motion::TrackedObject> Conveyor::connect() {
    if (link_ || !hasObjectInWindow()) return nullptr;
    link_ = std::make_shared<Link>(belt_, settings_, queue_.front());
    queue_.pop_front();
    showSignals();
    schedule();
    changed_.notifyAll();
    return link_;
}

void Conveyor::drop() {
    if (!link_) return;
    std::exchange(link_, nullptr)->end();
    watched_.reset();
    showSignals();
    schedule();
    changed_.notifyAll();
}

void Conveyor::lose(const std::string& why) {
    drop();
    for (const auto& action : lostActions_)
        action(why);
}

void Conveyor::watch(double position) {
    watched_ = position;
    schedule();
}

// ---- Between two processes -------------------------------------------------------------------------------------------

Conveyor::Kept Conveyor::kept() const {
    Kept kept{isActive_, position(), speed(),    belt_->target(), {queue_.begin(), queue_.end()},
              {},        lastSync_,  nextObject_};
    if (link_) kept.connected = link_->origin();
    return kept;
}

void Conveyor::restore(const Kept& kept) {
    isActive_ = kept.isActive;
    belt_->restore(scheduler_.now(), kept.position, kept.speed, kept.target);
    queue_.assign(kept.queue.begin(), kept.queue.end());
    link_ = kept.connected ? std::make_shared<Link>(belt_, settings_, *kept.connected) : nullptr;
    lastSync_ = kept.lastSync;
    // The options may say something else now.
    nextObject_.reset();
    if (settings_.every > 0) {
        const double furthest = kept.position + settings_.every;
        nextObject_ = std::clamp(kept.nextObject.value_or(furthest), kept.position, furthest);
    }
    showSignals();
    schedule();
}

// ---- Time ------------------------------------------------------------------------------------------------------------

/// The next moment at which an object comes to a place that matters.
void Conveyor::schedule() {
    if (next_ != 0) scheduler_.cancel(std::exchange(next_, 0));
    const Time now = scheduler_.now();
    Time next = kNever;
    const auto consider = [&](double beltPosition) {
        if (std::fabs(beltPosition - position()) <= kNear) return; // has been dealt with
        next = std::min(next, std::max(belt_->whenAt(beltPosition, now), now + 1));
    };
    if (nextObject_) consider(*nextObject_);
    for (const double origin : queue_) {
        consider(origin);
        consider(origin + settings_.window);
    }
    if (link_) {
        consider(link_->origin() + settings_.maximum);
        consider(link_->origin() + settings_.minimum);
        if (watched_) consider(link_->origin() + *watched_);
        if (speed() != 0 || belt_->target() != 0) next = std::min(next, addTime(now, kShowPeriod));
    }
    if (next != kNever) next_ = scheduler_.at(next, [this] { act(); });
}

void Conveyor::act() {
    next_ = 0;
    while (nextObject_ && position() >= *nextObject_ - kNear) {
        const double ahead = position() - *nextObject_;
        *nextObject_ += settings_.every;
        objectAtSync(ahead);
    }
    passWindow();
    checkLimits();
    showSignals();
    schedule();
    changed_.notifyAll();
}

/// Objects that leave the start window without a connection are lost.
void Conveyor::passWindow() {
    while (!queue_.empty() && objectPosition(queue_.front()) >= settings_.window - kNear) {
        queue_.pop_front();
        pulse("PassStw");
    }
}

void Conveyor::checkLimits() {
    if (!link_) return;
    const double here = connectedPosition();
    const bool isBeyond = here >= settings_.maximum - kNear;
    if (!isBeyond && here > settings_.minimum + kNear) return;
    const double limit = isBeyond ? settings_.maximum : settings_.minimum;
    log_.write(EventId::ConveyorObjectLost, nullptr,
               {settings_.name, fmt::format("{:.0f} {}", limit, settings_.rotating ? "degrees" : "mm"),
                isBeyond ? "maximum" : "minimum"});
    lose(
        fmt::format("it has passed the {} distance of {}", isBeyond ? "maximum" : "minimum", settings_.name));
}

} // namespace rt
