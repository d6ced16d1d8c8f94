#include "runtime/host/rapidc_compiler.h"

#include "config/letter_case.h"
#include "runtime/host/rapidc_process.h"
#include "runtime/host/unit_messages.h"
#include "runtime/io/io_system.h"

#include <fmt/format.h>

#include <cctype>
#include <utility>

namespace rt {
namespace {

/// Asks for a unit or for open references; `problem` is set when there is no answer.
UnitAnswer askForUnit(const std::string& request, std::string& problem) {
    const RapidcAnswer answer = askRapidc({"compile-unit"}, request);
    if (answer.status < 0) {
        problem = answer.notStarted("load modules");
        return {};
    }
    std::optional<UnitAnswer> unit;
    if (answer.status == 0) unit = readUnitAnswer(answer.out);
    if (unit) return std::move(*unit);
    problem = fmt::format(
        "'{}' cannot compile a module for this executable (status {}{}{}): it must be the "
        "rapidc that the executable was built by; name that one in the environment variable {}, or "
        "build the program again",
        answer.program, answer.status, answer.said.empty() ? "" : ", ", answer.said, kRapidcVariable);
    return {};
}

SignalNames signalsOf(const IoSystem& io) {
    SignalNames signals;
    for (SignalId id = 0; id < static_cast<SignalId>(io.size()); ++id) {
        signals.emplace_back(io.config(id).name,
                             "signal" + rapid::config::lowerCase(signalTypeName(io.config(id).type)));
    }
    return signals;
}

} // namespace

CompiledUnit RapidcCompiler::compile(const LoadRequest& request, const ProgramState& state) {
    std::string problem;
    UnitAnswer answer =
        askForUnit(writeUnitRequest(sources_, false, request, state, signalsOf(io_)), problem);
    if (!problem.empty()) {
        answer.unit.verdict = LoadResult::Verdict::NoCompiler;
        answer.unit.problems = std::move(problem);
    }
    return std::move(answer.unit);
}

OpenReferences RapidcCompiler::unresolved(const std::string& task, const ProgramState& state) {
    std::string problem;
    LoadRequest request;
    request.task = task;
    UnitAnswer answer = askForUnit(writeUnitRequest(sources_, true, request, state, signalsOf(io_)), problem);
    if (!problem.empty()) answer.open.problem = std::move(problem);
    return std::move(answer.open);
}

} // namespace rt
