#pragma once
// One function per command: adds it to the command line.

namespace rt {
class CommandLine;
}

namespace rapidc {

void addCheckCommand(rt::CommandLine& line);
void addBuildCommand(rt::CommandLine& line);
void addRunCommand(rt::CommandLine& line);
void addTestCommand(rt::CommandLine& line);
void addEmitCommand(rt::CommandLine& line);
void addExplainCommand(rt::CommandLine& line);
void addBuiltinsCommand(rt::CommandLine& line);
void addSignalsCommand(rt::CommandLine& line);
void addRobotsCommand(rt::CommandLine& line);
void addFmtCommand(rt::CommandLine& line);
void addRenameCommand(rt::CommandLine& line);
void addSetValueCommand(rt::CommandLine& line);
void addLspCommand(rt::CommandLine& line);
void addDapCommand(rt::CommandLine& line);
void addServeCommand(rt::CommandLine& line);
void addCompileUnitCommand(rt::CommandLine& line);

} // namespace rapidc
