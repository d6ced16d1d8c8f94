#include "stdlib/impl/system/whole_file.h"

#include "stdlib/impl/files/open_files.h"
#include "stdlib/impl/files/placed_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace rt::lib {
namespace {

/// An open file of a volume; `problem` says why there is none.
Descriptor openWhole(Controller& controller, std::string_view path, std::string& problem) {
    OpenFiles::of(controller).flushAll(controller);
    VolumePlace place;
    problem = controller.volumes().locate(path, Volumes::LastLink::Follow, place);
    if (!problem.empty()) return {};
    Descriptor file(::openat(place.folder.number(), place.name.c_str(),
                             O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY));
    struct stat status{};
    if (!file.isOpen() || ::fstat(file.number(), &status) != 0)
        problem = std::strerror(errno);
    else if (!S_ISREG(status.st_mode))
        problem = "it is not a file";
    return file;
}

/// "" or the problem.
std::string replaceIn(const VolumePlace& place, std::string_view bytes) {
    struct stat old{};
    const bool exists = ::fstatat(place.folder.number(), place.name.c_str(), &old, AT_SYMLINK_NOFOLLOW) == 0;
    if (exists && !S_ISREG(old.st_mode)) return "it is not a file";
    if (exists && ::faccessat(place.folder.number(), place.name.c_str(), W_OK, 0) != 0)
        return std::strerror(errno);
    const int error = replaceWhole(place, bytes);
    return error == 0 ? std::string() : std::strerror(error);
}

} // namespace

std::string readWhole(Controller& controller, std::string_view path, std::string& bytes) {
    constexpr std::size_t kMost = std::size_t{4} << 20;
    std::string problem;
    const Descriptor file = openWhole(controller, path, problem);
    if (!problem.empty()) return problem;
    char block[16384];
    for (;;) {
        const ssize_t count = ::read(file.number(), block, sizeof block);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return std::strerror(errno);
        if (count == 0) return {};
        bytes.append(block, static_cast<std::size_t>(count));
        if (bytes.size() > kMost) return "it is larger than 4 MB";
    }
}

std::string writeWhole(Controller& controller, std::string_view path, std::string_view bytes) {
    OpenFiles::of(controller).flushAll(controller);
    VolumePlace place;
    if (std::string problem = controller.volumes().locate(path, Volumes::LastLink::Follow, place);
        !problem.empty())
        return problem;
    return replaceIn(place, bytes);
}

} // namespace rt::lib
