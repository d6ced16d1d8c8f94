#pragma once
// check --missing: everything that a program needs and that is not there, in one table.

#include "tools/program/pipeline.h"

#include <string>

namespace rapidc {

/// The table for people; "nothing is missing" when it would be empty. Paths below `root`, unless that is empty, are shown
/// without it. The compilation must have kept the inside of
/// routines (Inputs::onlyDiagnostics).
std::string missingTable(const Compilation& compilation, const std::string& root);

/// The same as JSON: {"missing":[{kind,name,detail,count,places:[{file,line,column}]}]}.
std::string missingJson(const Compilation& compilation);

} // namespace rapidc
