// rapidc compile-unit: what built executables call to load modules; not meant for people.

#include "runtime/host/command_line.h"
#include "runtime/host/unit_messages.h"
#include "tools/program/unit_compiler.h"
#include "tools/rapidc/commands.h"

#include <fmt/format.h>
#include <iostream>
#include <iterator>

namespace rapidc {

namespace {

int fail(std::string_view problem) {
    fmt::print(stderr, "{}\n", problem);
    return 1;
}

int compileUnit() {
    const std::string bytes(std::istreambuf_iterator<char>(std::cin), {});
    const auto request = rt::readUnitRequest(bytes);
    if (!request)
        return fail("compile-unit serves executables made by `rapidc build`; this is not a request of one");
    std::string problem;
    const auto sources = unpack(request->sources, problem);
    if (!sources) return fail(problem);
    // Those the executable was built with, and what it was given since by --config.
    sources->options.signals.clear();
    for (const auto& [name, type] : request->signals)
        sources->options.signals.push_back({name, type});
    sources->options.configurationKnown = sources->options.configurationKnown || !request->signals.empty();
    SourceCompiler compiler(*sources);
    const rt::ProgramState state{request->tables, request->files};
    rt::UnitAnswer answer;
    if (request->references)
        answer.open = compiler.unresolved(request->load.task, state);
    else
        answer.unit = compiler.compile(request->load, state);
    std::cout << rt::writeUnitAnswer(answer) << std::flush;
    return 0;
}

} // namespace

void addCompileUnitCommand(rt::CommandLine& line) {
    const rt::Command command = line.addCommand("compile-unit", "Serve an executable that loads a module",
                                                [] { return compileUnit(); });
    command.hide(); // not listed
}

} // namespace rapidc
