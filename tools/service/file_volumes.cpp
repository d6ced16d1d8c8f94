#include "tools/service/file_volumes.h"

#include "config/letter_case.h"
#include "config/temporary.h"
#include "frontend/source/source_file.h"
#include "stdlib/impl/files/placed_file.h"
#include "tools/service/folder_work.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace rapidc::service {

namespace {

using rapid::config::sameName;
using rt::Descriptor;
using rt::VolumePlace;
using LastLink = rt::Volumes::LastLink;

constexpr uint64_t kRoomLeft = uint64_t{16} << 20; // bytes that an upload leaves free on the disk

FileResult done() {
    return {};
}

/// "$HOME/a/b" as volume and rest.
std::pair<std::string, std::string> split(const std::string& path) {
    const std::size_t begin = path.starts_with('$') ? 1 : 0;
    const std::size_t slash = std::min(path.find('/'), path.size());
    return {path.substr(begin, slash - begin), path.substr(std::min(slash + 1, path.size()))};
}

/// A name of an entry of a folder.
bool isBareName(std::string_view name) {
    return !name.empty() && name.size() <= 255 && name != "." && name != ".." &&
           name.find_first_of("/\\") == std::string_view::npos &&
           std::none_of(name.begin(), name.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; });
}

/// A name for a new entry: in UTF-8, as replies can show it. Entries with other names, such as those of old backups, can be read,
/// replaced and removed.
bool isNewName(std::string_view name) {
    return isBareName(name) && rapid::isValidUtf8(name);
}

FileResult badName(const std::string& name) {
    const char* const why = rapid::isValidUtf8(name) ? "a name for a file or folder" : "a name in UTF-8";
    return {FileProblem::Outside, fmt::format("'{}' is not {}", name, why)};
}

FileEntry entryOf(const std::string& name, const struct stat& status) {
    FileEntry entry;
    entry.name = name;
    entry.isFolder = S_ISDIR(status.st_mode);
    entry.isReadOnly = (status.st_mode & S_IWUSR) == 0;
    entry.size = static_cast<uint64_t>(status.st_size);
    entry.created = entry.modified = status.st_mtime;
    return entry;
}

bool statusOf(const VolumePlace& place, struct stat& status) {
    return ::fstatat(place.folder.number(), place.name.c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0;
}

} // namespace

bool isPlainFileName(std::string_view name) {
    return isNewName(name) && name.size() <= 80 && name.front() != '.' &&
           name.find_first_of(":$") == std::string_view::npos;
}

bool FileVolumes::add(const std::string& name, const std::string& folder) {
    std::string error;
    if (!volumes_.use(name, folder, error)) return false;
    names_.push_back(name);
    return true;
}

bool FileVolumes::has(const std::string& path) const {
    const std::string volume = split(path).first;
    return std::any_of(names_.begin(), names_.end(),
                       [&](const std::string& name) { return sameName(name, volume); });
}

FileResult FileVolumes::locate(const std::string& path, LastLink last, VolumePlace& place) const {
    if (path.find('\0') != std::string::npos || path.size() > 4096)
        return {FileProblem::Outside, "the path is not a possible one"};
    if (!has(path)) return {FileProblem::NoPath, fmt::format("there is no volume {}", split(path).first)};
    const auto [volume, rest] = split(path);
    const std::string problem = volumes_.locate(volume + ":" + rest, last, place);
    if (problem.empty()) return done();
    return {place.leaves ? FileProblem::Outside : FileProblem::NoPath, fmt::format("{}: {}", path, problem)};
}

FileResult FileVolumes::hostPath(const std::string& path, std::string& host) const {
    VolumePlace place;
    if (FileResult found = locate(path, LastLink::Follow, place); !found.isDone()) return found;
    const auto [volume, rest] = split(path);
    if (volumes_.resolve(volume + ":" + rest, host)) return done();
    return {FileProblem::NoPath, fmt::format("{} does not exist", path)};
}

std::pair<uint64_t, uint64_t> FileVolumes::space(const std::string& volume) const {
    VolumePlace place;
    struct statvfs status{};
    if (!locate(volume, LastLink::Follow, place).isDone() || ::fstatvfs(place.folder.number(), &status) != 0)
        return {0, 0};
    return {uint64_t{status.f_bavail} * status.f_frsize, uint64_t{status.f_blocks} * status.f_frsize};
}

// ---- Questions -----------------------------------------------------------------------------------------------------

FileResult FileVolumes::describe(const std::string& path, FileEntry& entry) const {
    VolumePlace place;
    struct stat status{};
    if (FileResult found = locate(path, LastLink::Follow, place); !found.isDone()) return found;
    if (!statusOf(place, status)) return {FileProblem::NoPath, fmt::format("{} does not exist", path)};
    entry = entryOf(place.name == "." ? split(path).first : place.name, status);
    return done();
}

FileResult FileVolumes::list(const std::string& path, std::vector<FileEntry>& entries) const {
    VolumePlace place;
    if (FileResult found = locate(path, LastLink::Follow, place); !found.isDone()) return found;
    const Descriptor folder(
        ::openat(place.folder.number(), place.name.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
    std::vector<std::string> names;
    if (!folder.isOpen() || !namesIn(folder.number(), names))
        return {FileProblem::NoPath, fmt::format("{} is not a folder", path)};
    for (const std::string& name : names) {
        if (isUnfinished(name)) continue;
        struct stat status{};
        if (::fstatat(folder.number(), name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0)
            continue; // gone meanwhile
        FileEntry entry;
        if (S_ISLNK(status.st_mode)) {
            if (!describe(path + "/" + name, entry).isDone())
                continue; // it leads nowhere, or out of the volume
            entry.name = name;
        } else if (S_ISREG(status.st_mode) || S_ISDIR(status.st_mode)) {
            entry = entryOf(name, status);
        } else {
            continue;
        }
        entries.push_back(std::move(entry));
    }
    std::sort(entries.begin(), entries.end(), [](const FileEntry& a, const FileEntry& b) {
        return a.isFolder != b.isFolder ? a.isFolder : a.name < b.name;
    });
    return done();
}

FileResult FileVolumes::read(const std::string& path, std::string& bytes) const {
    VolumePlace place;
    if (FileResult found = locate(path, LastLink::Follow, place); !found.isDone()) return found;
    const Descriptor file(
        ::openat(place.folder.number(), place.name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    struct stat status{};
    if (!file.isOpen() || ::fstat(file.number(), &status) != 0)
        return {errno == EACCES ? FileProblem::Refused : FileProblem::NoPath,
                fmt::format("{}: {}", path, std::strerror(errno))};
    if (!S_ISREG(status.st_mode)) return {FileProblem::Refused, fmt::format("{} is not a file", path)};
    if (static_cast<uint64_t>(status.st_size) > kLargestRead)
        return {FileProblem::TooLarge, fmt::format("{} has more than {} bytes", path, kLargestRead)};
    bytes.resize(static_cast<std::size_t>(status.st_size));
    std::size_t have = 0;
    while (have < bytes.size()) {
        const ssize_t got = ::read(file.number(), bytes.data() + have, bytes.size() - have);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return {FileProblem::Failed, fmt::format("{}: {}", path, std::strerror(errno))};
        if (got == 0) break; // the file has become shorter meanwhile
        have += static_cast<std::size_t>(got);
    }
    bytes.resize(have);
    return done();
}

// ---- Changes -------------------------------------------------------------------------------------------------------

FileResult FileVolumes::write(const std::string& path, std::string_view bytes, bool& isNew) const {
    VolumePlace place;
    struct stat status{};
    if (FileResult found = locate(path, LastLink::Follow, place); !found.isDone()) return found;
    if (place.name != "." && !isBareName(place.name)) return badName(place.name);
    isNew = !statusOf(place, status);
    if (isNew && !isNewName(place.name)) return badName(place.name);
    if (place.name == "." || (!isNew && !S_ISREG(status.st_mode)))
        return {FileProblem::Refused, fmt::format("{} is not a file", path)};
    if (!isNew && (status.st_mode & S_IWUSR) == 0)
        return {FileProblem::Refused, fmt::format("{} may not be written", path)};
    struct statvfs disk{};
    if (::fstatvfs(place.folder.number(), &disk) == 0 &&
        uint64_t{disk.f_bavail} * disk.f_frsize < bytes.size() + kRoomLeft)
        return {FileProblem::TooLarge,
                fmt::format("the disk of {} has no room for {} bytes", path, bytes.size())};
    if (const int error = rt::lib::replaceWhole(place, bytes); error != 0)
        return {error == ENOSPC ? FileProblem::TooLarge : FileProblem::Failed,
                fmt::format("{}: {}", path, std::strerror(error))};
    return done();
}

FileResult FileVolumes::makeFolder(const std::string& parent, const std::string& name) const {
    if (!isNewName(name)) return badName(name);
    VolumePlace place;
    if (FileResult found = locate(parent + "/" + name, LastLink::Keep, place); !found.isDone()) return found;
    if (::mkdirat(place.folder.number(), place.name.c_str(), 0777) == 0) return done();
    return {errno == EEXIST ? FileProblem::Exists : FileProblem::Failed,
            fmt::format("{}/{}: {}", parent, name, std::strerror(errno))};
}

FileResult FileVolumes::remove(const std::string& path) const {
    VolumePlace place;
    struct stat status{};
    if (FileResult found = locate(path, LastLink::Keep, place); !found.isDone()) return found;
    if (place.name == ".") return {FileProblem::Refused, "a volume cannot be removed"};
    if (!statusOf(place, status)) return {FileProblem::NoPath, fmt::format("{} does not exist", path)};
    if (const int error = removeIn(place.folder.number(), place.name); error != 0)
        return {FileProblem::Failed, fmt::format("{}: {}", path, std::strerror(error))};
    return done();
}

FileResult FileVolumes::rename(const std::string& path, const std::string& name) const {
    if (!isNewName(name)) return badName(name);
    VolumePlace place;
    struct stat status{};
    if (FileResult found = locate(path, LastLink::Keep, place); !found.isDone()) return found;
    if (place.name == ".") return {FileProblem::Refused, "a volume cannot be renamed"};
    if (!statusOf(place, status)) return {FileProblem::NoPath, fmt::format("{} does not exist", path)};
    const int folder = place.folder.number();
    if (::renameat2(folder, place.name.c_str(), folder, name.c_str(), RENAME_NOREPLACE) != 0)
        return {errno == EEXIST ? FileProblem::Exists : FileProblem::Failed,
                fmt::format("{} to {}: {}", path, name, std::strerror(errno))};
    return done();
}

FileResult FileVolumes::copy(const std::string& path, const std::string& name, bool overwrite) const {
    if (!isNewName(name)) return badName(name);
    VolumePlace place;
    struct stat status{};
    if (FileResult found = locate(path, LastLink::Follow, place); !found.isDone()) return found;
    if (place.name == ".") return {FileProblem::Refused, "a volume cannot be copied"};
    if (!statusOf(place, status)) return {FileProblem::NoPath, fmt::format("{} does not exist", path)};
    if (place.name == name) return {FileProblem::Exists, fmt::format("{} cannot be copied to itself", path)};
    struct stat target{};
    const bool exists = ::fstatat(place.folder.number(), name.c_str(), &target, AT_SYMLINK_NOFOLLOW) == 0;
    if (exists && (!overwrite || !S_ISREG(target.st_mode) || !S_ISREG(status.st_mode)))
        return {FileProblem::Exists, fmt::format("{} exists already", name)};
    if (const int error = copyIn(place.folder.number(), place.name, name); error != 0)
        return {error == ENOSPC ? FileProblem::TooLarge : FileProblem::Failed,
                fmt::format("{} to {}: {}", path, name, std::strerror(error))};
    return done();
}

FileResult FileVolumes::copyTo(const std::string& from, const std::string& to, bool overwrite) const {
    FileEntry source, target;
    if (FileResult found = describe(from, source); !found.isDone()) return found;
    if (source.isFolder) return {FileProblem::Refused, fmt::format("{} is a folder: give a bare name", from)};
    if (describe(to, target).isDone() && (!overwrite || target.isFolder))
        return {FileProblem::Exists, fmt::format("{} exists already", to)};
    std::string bytes;
    if (FileResult found = read(from, bytes); !found.isDone()) return found;
    bool isNew = false;
    return write(to, bytes, isNew);
}

} // namespace rapidc::service
