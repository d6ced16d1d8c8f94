#pragma once
// What is wrong with configuration files, told with their lines.

#include "config/cfg_parser.h"
#include "frontend/diag/diagnostic.h"

#include <span>
#include <string>

namespace rapidc {

/// Reports problems of the file `name` with the content `text`.
void reportConfigurationProblems(rapid::diag::Sink& sink, const std::string& name, const std::string& text,
                                 std::span<const rapid::config::CfgProblem> problems);

/// Adds what a controller that starts with these files would find wrong with signals and cross connections.
void judgeSignals(std::vector<rapid::config::CfgProblem>& problems, const std::vector<std::string>& names,
                  const std::vector<std::string>& texts);

} // namespace rapidc
