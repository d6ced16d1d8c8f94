#pragma once
// Date and time of the controller. On virtual time they begin at a fixed moment, so that a program that prints the date
// gives the same output on every run; with --realtime they are those of the wall clock (UTC).

#include "runtime/sched/task.h"

#include <cstdint>

namespace rt {
class Controller;
}

namespace rt::lib {

/// 2026-01-01 00:00:00, a Thursday, in seconds since 1970: the moment main starts on virtual time.
inline constexpr int64_t kVirtualEpoch = 1767225600;

struct DateTime {
    int year = 0, month = 0, day = 0; ///< month and day from 1
    int weekday = 0;                  ///< 1 = Monday .. 7 = Sunday
    int hour = 0, minute = 0, second = 0;
};

/// Gregorian date of a number of seconds since 1970.
DateTime dateTimeOf(int64_t seconds);
/// The controller's date and time now, seconds since 1970.
int64_t calendarNow(Controller& controller);
int64_t calendarNow(const Task& task);

} // namespace rt::lib
