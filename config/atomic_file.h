#pragma once
// Replacing a file so that whoever reads it, whenever the machine fails, finds the old content or the new one.

#include <string>
#include <string_view>

#include <sys/types.h>

namespace rapid::config {

/// Writes all bytes to an open file. 0 or the number of the error.
[[nodiscard]] int writeAll(int file, std::string_view bytes);
/// The permissions that open() gives to a new file of this mode.
mode_t permissionsOfNew(mode_t mode);

/// Writes `bytes` to a temporary file in the same folder, flushes it to the disk, renames it to `path` and flushes the
/// folder. Permissions (and, where allowed, the owner) of an existing file are kept; through a symbolic link the file
/// it names is replaced. A file without write permission is not replaced. A writer that is killed may leave a
/// TemporaryFile, which no reader of projects takes for a module and removeLeftovers() removes.
///
/// Returns what went wrong, for people ("cannot write 'x.mod': No space left on device"); empty: success.
[[nodiscard]] std::string replaceFile(const std::string& path, std::string_view bytes);

} // namespace rapid::config
