#pragma once
// One function per command: adds it to the command line. The callback stores the exit status.

namespace CLI {
class App;
}

namespace rapidc {

void addCheckCommand(CLI::App& app, int& status);
void addBuildCommand(CLI::App& app, int& status);
void addRunCommand(CLI::App& app, int& status);
void addEmitCommand(CLI::App& app, int& status);
void addExplainCommand(CLI::App& app, int& status);
void addBuiltinsCommand(CLI::App& app, int& status);
void addSignalsCommand(CLI::App& app, int& status);
void addRobotsCommand(CLI::App& app, int& status);
void addFmtCommand(CLI::App& app, int& status);
void addRenameCommand(CLI::App& app, int& status);
void addSetValueCommand(CLI::App& app, int& status);
void addCompileUnitCommand(CLI::App& app, int& status);

} // namespace rapidc
