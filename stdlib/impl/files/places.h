#pragma once
// Paths of programs as places in volumes; what leads nowhere raises ERR_FILEACC.

#include "runtime/host/controller.h"

#include <sys/stat.h>

#include <string>
#include <string_view>

namespace rt::lib {

using LastLink = Volumes::LastLink;

/// A path or text as messages show it: control characters as \\hh.
std::string shown(std::string_view text);
/// The place need not exist; its folder must.
Status placeOf(TaskCore* task, const String& path, LastLink last, VolumePlace& place);
/// The attributes of an existing file or directory, with everything that programs have written to it.
Status statusOf(TaskCore* task, const String& path, struct stat& status);
/// Raises ERR_FILEACC: "HOME:/x cannot be removed: ...". `problem`: number of an error of the host.
Status accessError(TaskCore* task, const String& path, std::string_view verb, int problem);

} // namespace rt::lib
