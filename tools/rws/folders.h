#pragma once
// Folders: resources that only list what lies below them. Clients ask for / to see whether the controller is there.

#include "tools/rws/router.h"

namespace rapidc::rws {

void addFolders(Router& router);

} // namespace rapidc::rws
