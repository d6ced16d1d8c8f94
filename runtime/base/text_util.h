#pragma once
// Small things that the readers of foreign text share, under the names the runtime uses.

#include "config/read_file.h"
#include "config/text_util.h"

namespace rt {

using rapid::config::lowerCase;
using rapid::config::lowerLetter;
using rapid::config::parseNumber;
using rapid::config::readStream;
using rapid::config::sameName;
using rapid::config::shortestNumber;
using rapid::config::toUtf8;
using rapid::config::trimmed;
using rapid::config::upperCase;

} // namespace rt
