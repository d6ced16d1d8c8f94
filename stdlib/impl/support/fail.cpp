#include "stdlib/impl/support/fail.h"

#include "runtime/value/value_text.h"

#include <fmt/format.h>

#include <cmath>

using namespace rt;

namespace {

/// With all digits that tell the number from others: a message says why this very number does not fit.
std::string digitsOf(double value) {
    const auto asNum = static_cast<float>(value);
    return std::trunc(value) != value && static_cast<double>(asNum) == value ? fmt::format("{}", asNum)
                                                                             : formatDnum(value);
}

/// Replaces the first "{}".
void fillIn(std::string& text, double value) {
    if (const size_t at = text.find("{}"); at != std::string::npos) text.replace(at, 2, digitsOf(value));
}

} // namespace

extern "C" {

Status rt_fail(TaskCore* task, Status number, const char* text, int64_t size) {
    return task ? taskOf(task).raise(number, std::string(text, static_cast<size_t>(size))) : number;
}

Status rt_failWith(TaskCore* task, Status number, const char* text, double first, double second) {
    std::string filled = text;
    fillIn(filled, first);
    fillIn(filled, second);
    return rt_fail(task, number, filled.data(), static_cast<int64_t>(filled.size()));
}
}
