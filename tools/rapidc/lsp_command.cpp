// rapidc lsp: the language server on standard input and output.

#include "runtime/host/command_line.h"
#include "tools/lsp/serve.h"
#include "tools/program/controller_environment.h"
#include "tools/program/pipeline.h"
#include "tools/rapidc/commands.h"
#include "tools/rapidc/usage.h"

#include "runtime/host/run_options.h"

#include <cstdio>
#include <fmt/format.h>

namespace rapidc {

namespace {

int serve(const Inputs& inputs) {
    rapid::lint::WarningLevels levels;
    for (const std::string& option : inputs.warnings)
        if (std::string problem; !rapid::lint::applyOption(option, levels, problem))
            return usageError("lsp", problem);
    return lsp::serve(controllerEnvironment(), inputs.warnings);
}

} // namespace

void addLspCommand(rt::CommandLine& line) {
    auto inputs = std::make_shared<Inputs>();
    auto stdio = std::make_shared<bool>(false);
    const rt::Command command =
        line.addCommand("lsp", "Language server for editors (LSP 3.17) on standard input and output",
                        [inputs] { return serve(*inputs); });
    addWarningOption(command, *inputs);
    command.addFlag("--stdio", *stdio, "Accepted, because some editors pass it; it is the only way");
}

} // namespace rapidc
