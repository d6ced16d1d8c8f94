#pragma once
// Words of the configuration of system signals.

#include "runtime/base/text_util.h"
#include "runtime/io/cfg_parser.h"
#include "runtime/io/io_system.h"

#include <fmt/format.h>

#include <string_view>
#include <utility>
#include <vector>

namespace rt {

/// The value of a word; the first one of the enumeration when it is not in the table.
template <class T, std::size_t N>
T wordIn(const std::pair<const char*, T> (&table)[N], std::string_view word) {
    for (const auto& [name, value] : table)
        if (sameName(name, word)) return value;
    return T{};
}

/// -Signal of the instance; -1 with a warning when there is no such signal.
inline SignalId systemSignal(const IoSystem& io, const std::string& file, const CfgInstance& instance,
                             std::vector<CfgProblem>& problems) {
    const std::string name = instance.text("Signal");
    const SignalId id = io.find(name);
    if (id >= 0) return id;
    problems.push_back(
        {file, instance.line,
         name.empty() ? "system signal without a signal: add -Signal and its name"
                      : fmt::format("system signal: signal '{}' is not defined; add it to EIO_SIGNAL", name),
         true});
    return -1;
}

} // namespace rt
