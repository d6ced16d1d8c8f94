#include "stdlib/impl/motion/search.h"

#include "runtime/value/value_text.h"

#include <cmath>
#include <utility>

namespace rt::lib {

bool Search::value() const {
    if (source_.persistent != nullptr) return *source_.persistent;
    return task_.controller().io().value(source_.signal) != 0;
}

void Search::begin() {
    if (isOver_) return;
    if (conditions_.activeLevel != value()) return watch();
    wasActive_ = true;
    task_.controller().motion(task_).breakOff(BreakOff::OnPath);
}

void Search::watch() {
    level_ = task_.controller().motion(task_).pathLevel();
    last_ = value();
    if (source_.persistent != nullptr)
        dataWatch_ = task_.scheduler().watchData([this] { look(); });
    else
        listener_ =
            task_.controller().io().addListener(source_.signal, [this](SignalId, double, double) { look(); });
}

/// Movements on another path level, which a trap routine makes meanwhile, are not part of the search.
void Search::look() {
    const bool now = value();
    if (now == std::exchange(last_, now)) return;
    MotionDriver& driver = task_.controller().motion(task_);
    if (driver.pathLevel() != level_ || !(now ? conditions_.rising : conditions_.falling)) return;
    if (hits_++ > 0) return;
    place_ = driver.system().currentJoints();
    if (!conditions_.stops) return;
    stopWatching();
    checkSpeed(driver);
    driver.breakOff(conditions_.stop);
}

/// A stiff stop keeps the path up to 100 mm/s only (manual of SearchL, \Stop).
void Search::checkSpeed(MotionDriver& driver) {
    constexpr double kStiffest = 100, kRounding = 0.5; // mm/s
    const double speed = driver.system().current().tcpSpeed;
    if (conditions_.stop == BreakOff::Stiff && speed > kStiffest + kRounding)
        task_.report(EventId::StiffStopFast,
                     {"The search", formatDisplayNum(static_cast<float>(std::round(speed)))});
}

void Search::stopWatching() {
    if (listener_ != 0) task_.controller().io().removeListener(std::exchange(listener_, 0));
    if (dataWatch_ != 0) task_.scheduler().unwatchData(std::exchange(dataWatch_, 0));
}

void Search::end() {
    isOver_ = true;
    stopWatching();
}

} // namespace rt::lib
