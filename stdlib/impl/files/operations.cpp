// Manual 1.14, 1.16: copies, names, kinds, sizes and times of files.

#include "config/atomic_file.h"
#include "stdlib/impl/files/open_files.h"
#include "stdlib/impl/files/placed_file.h"
#include "stdlib/impl/files/places.h"
#include "stdlib/impl/support/fail.h"
#include "stdlib/impl/time/calendar.h"

#include "natives/files.h"
#include "natives/time.h"
#include "stdlib_constants.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>

using namespace rt;
using lib::LastLink;

namespace {

constexpr double kLargestNum = 8388608; // up to here num counts exactly

/// All bytes, and the time. 0 or the number of the error.
int copyBytes(int from, int to, const struct stat& source) {
    std::array<char, 65536> block{};
    for (;;) {
        const ssize_t count = ::read(from, block.data(), block.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return errno;
        if (count == 0) break;
        if (const int problem = rapid::config::writeAll(to, {block.data(), static_cast<std::size_t>(count)});
            problem != 0)
            return problem;
    }
    const timespec times[] = {source.st_atim, source.st_mtim};
    ::futimens(to, times);
    return 0;
}

/// Makes a new file of the bytes of another; nothing is left of it when that fails. 0 or the number of the error.
int copyFile(const VolumePlace& from, const VolumePlace& to) {
    const Descriptor source(
        ::openat(from.folder.number(), from.name.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
    if (!source.isOpen()) return errno;
    struct stat status{};
    if (::fstat(source.number(), &status) != 0) return errno;
    if (S_ISDIR(status.st_mode)) return EISDIR;
    if (!S_ISREG(status.st_mode)) return EINVAL;
    struct stat there{};
    if (::fstatat(to.folder.number(), to.name.c_str(), &there, AT_SYMLINK_NOFOLLOW) == 0) return EEXIST;
    lib::PlacedFile copy;
    if (const int problem = copy.make(to); problem != 0) return problem;
    if (const int problem = copyBytes(source.number(), copy.descriptor(), status); problem != 0)
        return problem;
    return copy.putNew(status.st_mode & 0777);
}

int renameFile(const VolumePlace& from, const VolumePlace& to) {
    if (::renameat2(from.folder.number(), from.name.c_str(), to.folder.number(), to.name.c_str(),
                    RENAME_NOREPLACE) == 0)
        return 0;
    if (errno != EXDEV) return errno;
    if (const int problem = copyFile(from, to); problem != 0) return problem;
    return ::unlinkat(from.folder.number(), from.name.c_str(), 0) == 0 ? 0 : errno;
}

using Transfer = int (*)(const VolumePlace&, const VolumePlace&);

Status transfer(TaskCore* task, const String& oldPath, const String& newPath, LastLink last, const char* verb,
                Transfer action) {
    Controller& controller = taskOf(task).controller();
    lib::OpenFiles::of(controller).flushAll(controller);
    VolumePlace from, to;
    if (const Status status = lib::placeOf(task, oldPath, last, from)) return status;
    if (const Status status = lib::placeOf(task, newPath, LastLink::Keep, to)) return status;
    const int problem = action(from, to);
    if (problem == 0) return kOk;
    return lib::fail(task, problem == EEXIST ? err::ERR_FILEEXIST : err::ERR_FILEACC,
                     fmt::format("{} cannot be {} to {}: {}", lib::shown(oldPath.view()), verb,
                                 lib::shown(newPath.view()), std::strerror(problem)));
}

Status tooLarge(TaskCore* task, const String& path) {
    return lib::fail(
        task, err::ERR_FILESIZE,
        fmt::format("the size of {} is beyond 8388608, up to which num is exact", lib::shown(path.view())));
}

Status fileTime(TaskCore* task, const String& path, bool access, String* digits, int64_t& seconds) {
    struct stat status{};
    if (const Status problem = lib::statusOf(task, path, status)) return problem;
    // The host notes changes of the status in its own time, which is not the controller's.
    seconds = access ? status.st_atim.tv_sec : status.st_mtim.tv_sec;
    if (digits != nullptr) digits->assign(std::to_string(seconds));
    return kOk;
}

} // namespace

extern "C" {

Status rt_CopyFile(TaskCore* task, const String* OldPath, const String* NewPath) {
    return transfer(task, *OldPath, *NewPath, LastLink::Follow, "copied", copyFile);
}

Status rt_RenameFile(TaskCore* task, const String* OldPath, const String* NewPath) {
    return transfer(task, *OldPath, *NewPath, LastLink::Keep, "renamed", renameFile);
}

Status rt_RemoveFile(TaskCore* task, const String* Path) {
    VolumePlace place;
    if (const Status status = lib::placeOf(task, *Path, LastLink::Keep, place)) return status;
    if (::unlinkat(place.folder.number(), place.name.c_str(), 0) == 0) return kOk;
    return lib::accessError(task, *Path, "removed", errno);
}

/// Without a switch: whether there is anything. With one it must be there.
Status rt_ISFile(TaskCore* task, bool* result, const String* Path, bool Directory, bool Fifo, bool RegFile,
                 bool BlockSpec, bool CharSpec) {
    VolumePlace place;
    *result = false;
    const bool asksKind = Directory || Fifo || RegFile || BlockSpec || CharSpec;
    const std::string problem =
        taskOf(task).controller().volumes().locate(Path->view(), LastLink::Follow, place);
    if (!problem.empty() && (asksKind || place.leaves))
        return lib::fail(task, err::ERR_FILEACC, fmt::format("{}: {}", lib::shown(Path->view()), problem));
    struct stat status{};
    const bool exists = problem.empty() && ::fstatat(place.folder.number(), place.name.c_str(), &status,
                                                     AT_SYMLINK_NOFOLLOW) == 0;
    if (!exists && asksKind)
        return lib::fail(
            task, err::ERR_FILEACC,
            fmt::format("{} does not exist; ask without a switch whether it does", Path->view()));
    const mode_t kind = status.st_mode & S_IFMT;
    *result = exists && (!asksKind || (Directory && kind == S_IFDIR) || (Fifo && kind == S_IFIFO) ||
                         (RegFile && kind == S_IFREG) || (BlockSpec && kind == S_IFBLK) ||
                         (CharSpec && kind == S_IFCHR));
    return kOk;
}

Status rt_FileSize(TaskCore* task, float* result, const String* Path) {
    struct stat status{};
    if (const Status problem = lib::statusOf(task, *Path, status)) return problem;
    if (!S_ISREG(status.st_mode))
        return lib::fail(task, err::ERR_FILEACC,
                         fmt::format("{} is not a regular file", lib::shown(Path->view())));
    if (static_cast<double>(status.st_size) > kLargestNum) return tooLarge(task, *Path);
    *result = static_cast<float>(status.st_size);
    return kOk;
}

Status rt_FSSize(TaskCore* task, float* result, const String* Name, bool, bool Free, bool Kbyte, bool Mbyte) {
    if (Kbyte && Mbyte)
        return lib::fail(task, err::ERR_ARGVALERR, "FSSize takes \\Kbyte or \\Mbyte, not both");
    VolumePlace place;
    if (const Status status = lib::placeOf(task, *Name, LastLink::Follow, place)) return status;
    struct statvfs disk{};
    if (::fstatvfs(place.folder.number(), &disk) != 0)
        return lib::accessError(task, *Name, "measured", errno);
    const double bytes =
        static_cast<double>(Free ? disk.f_bavail : disk.f_blocks) * static_cast<double>(disk.f_frsize);
    const double size = std::floor(bytes / (Mbyte ? 1024.0 * 1024.0 : Kbyte ? 1024.0 : 1.0));
    if (size > kLargestNum) return tooLarge(task, *Name);
    *result = static_cast<float>(size);
    return kOk;
}

Status rt_FileTimeDnum(TaskCore* task, double* result, const String* Path, bool, bool AccessTime, bool,
                       String* StrDig) {
    int64_t seconds = 0;
    const Status status = fileTime(task, *Path, AccessTime, StrDig, seconds);
    *result = static_cast<double>(seconds);
    return status;
}

Status rt_FileTime(TaskCore* task, float* result, const String* Path, bool, bool AccessTime, bool,
                   String* StrDig) {
    int64_t seconds = 0;
    const Status status = fileTime(task, *Path, AccessTime, StrDig, seconds);
    *result = static_cast<float>(seconds);
    return status;
}
}
