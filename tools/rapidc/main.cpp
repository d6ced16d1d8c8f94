// rapidc: one executable, its commands.

#include "codegen/codegen.h"
#include "runtime/host/command_line.h"
#include "runtime/host/run_options.h"
#include "runtime/host/standard_streams.h"
#include "tools/rapidc/commands.h"

#include <system_error>

int main(int argc, char** argv) { // NOLINT(bugprone-exception-escape): out of memory may end it
    rt::guardLimits("rapidc");
    codegen::guardMemory(rt::endOutOfMemory);
    rt::guardStandardStreams();
    rt::CommandLine line("rapidc",
                         "rapidc compiles ABB RAPID to native code and runs it on a virtual controller");
    line.setVersion("rapidc " RAPIDC_VERSION);
    rapidc::addCheckCommand(line);
    rapidc::addBuildCommand(line);
    rapidc::addRunCommand(line);
    rapidc::addTestCommand(line);
    rapidc::addEmitCommand(line);
    rapidc::addExplainCommand(line);
    rapidc::addBuiltinsCommand(line);
    rapidc::addSignalsCommand(line);
    rapidc::addRobotsCommand(line);
    rapidc::addFmtCommand(line);
    rapidc::addRenameCommand(line);
    rapidc::addSetValueCommand(line);
    rapidc::addLspCommand(line);
    rapidc::addDapCommand(line);
    rapidc::addServeCommand(line);
    rapidc::addCompileUnitCommand(line);
    int status = static_cast<int>(rt::ExitStatus::BadUsage);
    try {
        status = line.run(argc, argv);
    } catch (
        const std::system_error&) { // fmt::print: standard output is full or closed, which is reported below
    }
    return rt::finishStandardOutput("rapidc", status);
}
