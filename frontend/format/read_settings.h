#pragma once
// The section "format" of a project file -> FormatSettings.

#include "frontend/format/format_settings.h"
#include "frontend/project/settings.h"

namespace rapid::format {

/// Settings that are not named keep their default. Unknown names and values that cannot be used are reported.
FormatSettings readFormatSettings(const project::Settings& settings, diag::Sink& sink);

} // namespace rapid::format
