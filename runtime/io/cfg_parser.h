#pragma once
// The reader of configuration files, under the names the runtime uses.

#include "config/cfg_parser.h"

namespace rt {

using rapid::config::CfgAttribute;
using rapid::config::CfgFile;
using rapid::config::CfgInstance;
using rapid::config::CfgProblem;
using rapid::config::CfgSection;
using rapid::config::parseCfg;
using rapid::config::readCfg;

} // namespace rt
