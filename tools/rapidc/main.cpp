// rapidc: one executable, its commands (design chapter 8).

#include "runtime/host/usage.h"
#include "tools/rapidc/commands.h"

#include <CLI/CLI.hpp>

int main(int argc, char** argv) { // NOLINT(bugprone-exception-escape): out of memory may end it
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
    rapidc::addFmtCommand(app, status);
    rapidc::addRenameCommand(app, status);
    rapidc::addSetValueCommand(app, status);
    rapidc::addCompileUnitCommand(app, status);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& problem) {
        return rt::reportUsage(app, problem, "rapidc");
    }
    return status;
}
