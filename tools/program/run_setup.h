#pragma once
// The steps between the check of a program and its run, by `rapidc run` and by the debug adapter.

#include "config/temporary.h"
#include "frontend/workspace/compilation.h"
#include "runtime/host/run_options.h"

#include <string>
#include <vector>

namespace rapidc {

/// Gives the options of a run that concern its inputs to them: tasks, configuration, robots, conveyors, cameras, HOME.
void takeOptions(rapid::workspace::Inputs& inputs, const rt::RunOptions& options);

/// A folder may hold the stimulus its program is meant to be run with.
void findStimulus(rt::RunOptions& options, const std::vector<std::string>& inputs);

/// HOME of a backup for one run: a copy, so that the backup stays as it is. The folder of the copy; empty with a message
/// when it cannot be made.
std::string copyHome(const std::string& from, rapid::config::TemporaryFolder& folder, std::string& error);

/// A pipe can be read once: what it holds is kept. False with a message when it cannot be read.
bool readStimulus(rt::RunOptions& options, std::string& error);

} // namespace rapidc
