#include "config/atomic_file.h"

#include "config/temporary.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace rapid::config {

namespace {

namespace fs = std::filesystem;

std::string failure(const char* verb, const std::string& path, int error) {
    return fmt::format("cannot {} '{}': {}", verb, path, std::strerror(error));
}

/// Fills the open temporary file; 0 or the number of the error.
int fill(int file, std::string_view bytes, const struct stat* old) {
    if (const int error = writeAll(file, bytes); error != 0) return error;
    // Another owner can be kept by the superuser only; the content matters more.
    if (old && ::fchown(file, old->st_uid, old->st_gid) != 0) errno = 0;
    if (::fchmod(file, old ? old->st_mode & 07777 : permissionsOfNew(0666)) != 0) return errno;
    return ::fsync(file) == 0 ? 0 : errno;
}

void flushFolder(const std::string& folder) {
    const int handle = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (handle < 0) return; // some file systems have no folders to open; the file itself is safe
    ::fsync(handle);
    ::close(handle);
}

} // namespace

int writeAll(int file, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t done = ::write(file, bytes.data(), bytes.size());
        if (done < 0 && errno == EINTR) continue;
        if (done <= 0) return done == 0 ? EIO : errno;
        bytes.remove_prefix(static_cast<size_t>(done));
    }
    return 0;
}

mode_t permissionsOfNew(mode_t mode) {
    const mode_t mask = ::umask(0);
    ::umask(mask);
    return mode & ~mask;
}

std::string replaceFile(const std::string& path, std::string_view bytes) {
    std::error_code missing;
    const fs::path real = fs::canonical(path, missing);
    const fs::path target = missing ? fs::path(path) : real;
    struct stat old{};
    const bool exists = ::stat(target.c_str(), &old) == 0;
    if (exists && !S_ISREG(old.st_mode)) return fmt::format("cannot write '{}': it is not a file", path);
    if (exists && ::access(target.c_str(), W_OK) != 0) return failure("write", path, errno);

    const std::string folder = target.has_parent_path() ? target.parent_path().string() : ".";
    TemporaryFile temporary;
    if (const int error = temporary.make(folder, target.filename().string()); error != 0)
        return failure("write beside", path, error);
    int error = fill(temporary.descriptor(), bytes, exists ? &old : nullptr);
    if (error == 0) error = temporary.renameTo(target);
    if (error != 0) return failure("write", path, error);
    flushFolder(folder);
    return {};
}

} // namespace rapid::config
