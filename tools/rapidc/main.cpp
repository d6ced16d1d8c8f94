// rapidc: one executable, its commands (design chapter 8).

#include "codegen/codegen.h"
#include "runtime/host/run_options.h"
#include "runtime/host/standard_streams.h"
#include "runtime/host/usage.h"
#include "tools/rapidc/commands.h"

#include <CLI/CLI.hpp>
#include <system_error>

int main(int argc, char** argv) { // NOLINT(bugprone-exception-escape): out of memory may end it
    rt::guardLimits("rapidc");
    codegen::guardMemory(rt::endOutOfMemory);
    rt::guardStandardStreams();
    CLI::App app{"rapidc compiles ABB RAPID to native code and runs it on a virtual controller"};
    app.name("rapidc");
    app.set_version_flag("--version", "rapidc " RAPIDC_VERSION);
    app.require_subcommand(1);
    int status = 0;
    rapidc::addCheckCommand(app, status);
    rapidc::addBuildCommand(app, status);
    rapidc::addRunCommand(app, status);
    rapidc::addEmitCommand(app, status);
    rapidc::addExplainCommand(app, status);
    rapidc::addBuiltinsCommand(app, status);
    rapidc::addSignalsCommand(app, status);
    rapidc::addRobotsCommand(app, status);
    rapidc::addFmtCommand(app, status);
    rapidc::addRenameCommand(app, status);
    rapidc::addSetValueCommand(app, status);
    rapidc::addCompileUnitCommand(app, status);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& problem) {
        status = rt::reportUsage(app, problem, "rapidc");
    } catch (const std::system_error&) { // fmt::print: standard output is full or closed, which is told below
        if (status == 0) status = static_cast<int>(rt::ExitStatus::BadUsage);
    }
    return rt::finishStandardOutput("rapidc", status);
}
