#include "tools/service/folder_work.h"

#include "config/atomic_file.h"
#include "runtime/base/descriptor.h"

#include <fmt/format.h>

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>

namespace rapidc::service {

namespace {

using rapid::config::writeAll;
using rt::Descriptor;

constexpr int kMostDepth = 64; // folders in folders
constexpr std::size_t kBlock = std::size_t{1} << 18;

/// As config::TemporaryFile names them, so that leftovers are recognised.
std::string unfinishedName() {
    static std::atomic<unsigned> last = 0;
    return fmt::format(".copy.rapidc-{}-{:06}.tmp", ::getpid(), ++last % 1'000'000);
}

int openNew(int folder, const std::string& name, Descriptor& file) {
    file = Descriptor(
        ::openat(folder, name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666));
    if (!file.isOpen()) return errno;
    (void)::flock(file.number(),
                  LOCK_EX | LOCK_NB); // held while this process lives: others do not take it for a leftover
    return 0;
}

int openFolder(int parent, const std::string& name, Descriptor& folder) {
    folder = Descriptor(::openat(parent, name.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
    return folder.isOpen() ? 0 : errno;
}

int removeTree(int parent, const std::string& name, int depth) {
    if (::unlinkat(parent, name.c_str(), 0) == 0) return 0;
    if (errno != EISDIR && errno != EPERM) return errno;
    if (depth >= kMostDepth) return ELOOP;
    Descriptor folder;
    if (const int error = openFolder(parent, name, folder); error != 0) return error;
    std::vector<std::string> names;
    if (!namesIn(folder.number(), names)) return errno;
    for (const std::string& each : names)
        if (const int error = removeTree(folder.number(), each, depth + 1); error != 0 && error != ENOENT)
            return error;
    return ::unlinkat(parent, name.c_str(), AT_REMOVEDIR) == 0 ? 0 : errno;
}

int copyFile(int from, const std::string& name, int to, const std::string& target) {
    const Descriptor source(::openat(from, name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    struct stat status{};
    if (!source.isOpen() || ::fstat(source.number(), &status) != 0) return errno;
    if (!S_ISREG(status.st_mode)) return S_ISDIR(status.st_mode) ? EISDIR : EINVAL;
    Descriptor file;
    if (const int error = openNew(to, target, file); error != 0) return error;
    std::string block(kBlock, '\0');
    for (;;) {
        const ssize_t count = ::read(source.number(), block.data(), block.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return errno;
        if (count == 0) break;
        if (const int error = writeAll(file.number(), {block.data(), static_cast<std::size_t>(count)});
            error != 0)
            return error;
    }
    return ::fsync(file.number()) == 0 ? 0 : errno;
}

int copyTree(int from, const std::string& name, int to, const std::string& target, int depth) {
    const int copied = copyFile(from, name, to, target);
    if (copied != EISDIR) return copied;
    if (depth >= kMostDepth) return ELOOP;
    Descriptor source, made;
    if (const int error = openFolder(from, name, source); error != 0) return error;
    std::vector<std::string> names;
    if (!namesIn(source.number(), names)) return errno;
    if (::mkdirat(to, target.c_str(), 0777) != 0) return errno;
    if (const int error = openFolder(to, target, made); error != 0) return error;
    for (const std::string& each : names) {
        struct stat status{};
        const bool isCopied = ::fstatat(source.number(), each.c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0 &&
                              (S_ISREG(status.st_mode) || S_ISDIR(status.st_mode)) && !isUnfinished(each);
        if (!isCopied) continue;
        if (const int error = copyTree(source.number(), each, made.number(), each, depth + 1); error != 0)
            return error;
    }
    return 0;
}

} // namespace

bool namesIn(int folder, std::vector<std::string>& names) {
    const int own = ::openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC); // closedir() closes it
    DIR* open = own < 0 ? nullptr : ::fdopendir(own);
    if (open == nullptr) {
        if (own >= 0) ::close(own);
        return false;
    }
    while (const dirent* entry = ::readdir(open)) {
        const std::string_view name = entry->d_name;
        if (name != "." && name != "..") names.emplace_back(name);
    }
    ::closedir(open);
    return true;
}

bool isUnfinished(std::string_view name) {
    return name.starts_with('.') && name.find(".rapidc-") != std::string_view::npos;
}

int removeIn(int folder, const std::string& name) {
    return removeTree(folder, name, 0);
}

int copyIn(int folder, const std::string& name, const std::string& target) {
    const std::string temporary = unfinishedName();
    int error = copyTree(folder, name, folder, temporary, 0);
    if (error == 0 && ::renameat(folder, temporary.c_str(), folder, target.c_str()) != 0) error = errno;
    if (error != 0) removeTree(folder, temporary, 0);
    return error;
}

int copyAll(int from, int to, const std::string& except) {
    struct stat forbidden{};
    const bool isExcept = ::stat(except.c_str(), &forbidden) == 0;
    std::vector<std::string> names;
    if (!namesIn(from, names)) return errno;
    for (const std::string& name : names) {
        struct stat status{};
        if (isUnfinished(name) || ::fstatat(from, name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0) continue;
        if (!S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode)) continue;
        if (isExcept && status.st_dev == forbidden.st_dev && status.st_ino == forbidden.st_ino) continue;
        if (const int error = copyTree(from, name, to, name, 0); error != 0 && error != ENOENT) return error;
    }
    return 0;
}

} // namespace rapidc::service
