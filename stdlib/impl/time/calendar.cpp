#include "stdlib/impl/time/calendar.h"

#include "runtime/host/controller.h"
#include "stdlib/impl/support/fail.h"

#include "natives/time.h"
#include "stdlib_constants.h"

#include <chrono>
#include <cstdio>

using namespace rt;

namespace rt::lib {

DateTime dateTimeOf(int64_t seconds) {
    using namespace std::chrono;
    const sys_seconds moment{std::chrono::seconds{seconds}};
    const sys_days day = floor<days>(moment);
    const year_month_day date(day);
    const hh_mm_ss<std::chrono::seconds> time(moment - day);
    return {static_cast<int>(date.year()),
            static_cast<int>(static_cast<unsigned>(date.month())),
            static_cast<int>(static_cast<unsigned>(date.day())),
            static_cast<int>(weekday(day).iso_encoding()),
            static_cast<int>(time.hours().count()),
            static_cast<int>(time.minutes().count()),
            static_cast<int>(time.seconds().count())};
}

int64_t calendarNow(Controller& controller) {
    if (controller.options().realtime) return controller.calendarSeconds();
    return kVirtualEpoch + controller.scheduler().now() / kSecond;
}

int64_t calendarNow(const Task& task) {
    return calendarNow(task.controller());
}

} // namespace rt::lib

namespace {

void formatted(String* result, const char* format, int a, int b, int c) {
    char buffer[32];
    const int size = std::snprintf(buffer, sizeof buffer, format, a, b, c);
    result->assign({buffer, static_cast<size_t>(size)});
}

} // namespace

extern "C" {

Status rt_CDate(TaskCore* task, String* result) {
    const lib::DateTime now = lib::dateTimeOf(lib::calendarNow(taskOf(task)));
    formatted(result, "%04d-%02d-%02d", now.year, now.month, now.day);
    return kOk;
}

Status rt_CTime(TaskCore* task, String* result) {
    const lib::DateTime now = lib::dateTimeOf(lib::calendarNow(taskOf(task)));
    formatted(result, "%02d:%02d:%02d", now.hour, now.minute, now.second);
    return kOk;
}

Status rt_GetTime(TaskCore* task, float* result, bool WDay, bool Hour, bool Min, bool Sec) {
    if (WDay + Hour + Min + Sec != 1)
        return lib::fail(task, err::ERR_ARGVALERR, "GetTime needs one of \\WDay, \\Hour, \\Min and \\Sec");
    const lib::DateTime now = lib::dateTimeOf(lib::calendarNow(taskOf(task)));
    *result = static_cast<float>(WDay ? now.weekday : Hour ? now.hour : Min ? now.minute : now.second);
    return kOk;
}
}
