#include "stdlib/impl/support/fail.h"

#include <fmt/format.h>

using namespace rt;

namespace {

/// Replaces the first "{}".
void fillIn(std::string& text, double value) {
    if (const size_t at = text.find("{}"); at != std::string::npos)
        text.replace(at, 2, fmt::format("{:g}", value));
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
