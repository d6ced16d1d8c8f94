// rapidc: one executable, its commands (design chapter 8).

#include "runtime/host/run_options.h"
#include "tools/rapidc/commands.h"

#include <CLI/CLI.hpp>

int main(int argc, char** argv) {
    CLI::App app{"rapidc compiles ABB RAPID to native code and runs it on a virtual controller"};
    app.name("rapidc");
    app.set_version_flag("--version", "rapidc " RAPIDC_VERSION);
    app.require_subcommand(1);
    app.failure_message(CLI::FailureMessage::simple);
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
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& problem) {
        const bool asked = problem.get_exit_code() == 0; // --help, --version
        app.exit(problem);
        return asked ? 0 : static_cast<int>(rt::ExitStatus::BadUsage);
    }
    return status;
}
