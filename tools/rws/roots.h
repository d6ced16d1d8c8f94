#pragma once
// The folders at the root: / (which clients ask for as a sign of life) and /rw.

#include "tools/rws/router.h"

namespace rapidc::rws {

void addRoots(Router& router);

} // namespace rapidc::rws
