// rapidc: one executable, its commands.

#include "codegen/codegen.h"
#include "runtime/host/command_line.h"
#include "runtime/host/run_options.h"
#include "runtime/host/standard_streams.h"
#include "tools/rapidc/commands.h"

#include <system_error>

namespace {

constexpr rt::CommandEntry kCommands[] = {
    {"check", rapidc::addCheckCommand},       {"build", rapidc::addBuildCommand},
    {"run", rapidc::addRunCommand},           {"test", rapidc::addTestCommand},
    {"emit", rapidc::addEmitCommand},         {"explain", rapidc::addExplainCommand},
    {"builtins", rapidc::addBuiltinsCommand}, {"signals", rapidc::addSignalsCommand},
    {"robots", rapidc::addRobotsCommand},     {"fmt", rapidc::addFmtCommand},
    {"rename", rapidc::addRenameCommand},     {"set-value", rapidc::addSetValueCommand},
    {"lsp", rapidc::addLspCommand},           {"dap", rapidc::addDapCommand},
    {"serve", rapidc::addServeCommand},       {"compile-unit", rapidc::addCompileUnitCommand},
};

} // namespace

int main(int argc, char** argv) { // NOLINT(bugprone-exception-escape): out of memory may end it
    rt::guardLimits("rapidc");
    codegen::guardMemory(rt::endOutOfMemory);
    rt::guardStandardStreams();
    rt::CommandLine line("rapidc",
                         "rapidc compiles ABB RAPID to native code and runs it on a virtual controller");
    line.setVersion("rapidc " RAPIDC_VERSION);
    line.setCommands(kCommands);
    int status = static_cast<int>(rt::ExitStatus::BadUsage);
    try {
        status = line.run(argc, argv);
    } catch (
        const std::system_error&) { // fmt::print: standard output is full or closed, which is reported below
    }
    return rt::finishStandardOutput("rapidc", status);
}
