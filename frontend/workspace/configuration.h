#pragma once
// Configuration texts: what they add to a check, and what is wrong with them, with their lines.

#include "frontend/workspace/compilation.h"

#include <set>
#include <string>
#include <vector>

namespace rapid::workspace {

/// The configured signals and mechanical units by name and RAPID type; the runtime reads the same files again when the program
/// starts. The first of `files` are those of Inputs::configFiles; the others were found. `withSignals`: also what the controller
/// would find wrong with them.
void readConfiguration(Compilation& compilation, const Environment& environment, const Inputs& inputs,
                       const std::vector<std::string>& files, bool withSignals);

/// Units and signals of simulated conveyors exist without a configuration of their own.
void addConveyors(Compilation& compilation, const Environment& environment,
                  const std::vector<std::string>& conveyors);

/// Event routines and shared modules of SYS.cfg.
void readTaskSettings(Compilation& compilation);

/// The configuration of tasks in SYS.cfg: BindRef of each task; entry and type of the tasks of the command line (those of a backup
/// have theirs). `typesGiven`: tasks whose type the command line gives; that of the first task is NORMAL.
void configureTasks(Compilation& compilation, const std::set<std::string>& typesGiven, bool isBackup);

/// The robot of a backup: that of MOC.cfg, else the one among its options, which becomes part of the configuration.
void configureRobot(Compilation& compilation, const std::string& option);

/// Reports a robot of a backup that has no model. For inputs that are not executed: the controller of a run reports it, with what takes
/// its place.
void checkRobot(Compilation& compilation, const Environment& environment, const std::string& option);

/// All values in the configuration files, in lower case: event routines, service routines, interrupts by system signals.
std::set<std::string> namedByConfiguration(const Compilation& compilation);

} // namespace rapid::workspace
