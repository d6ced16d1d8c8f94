#include "stdlib/impl/system/whole_file.h"

#include "stdlib/impl/files/open_files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace rt::lib {
namespace {

/// An open file of a volume; `problem` says why there is none.
Descriptor openWhole(Controller& controller, std::string_view path, int flags, std::string& problem) {
    OpenFiles::of(controller).flushAll(controller);
    VolumePlace place;
    problem = controller.volumes().locate(path, Volumes::LastLink::Follow, place);
    if (!problem.empty()) return {};
    Descriptor file(::openat(place.folder.number(), place.name.c_str(),
                             flags | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY, 0666));
    struct stat status{};
    if (!file.isOpen() || ::fstat(file.number(), &status) != 0)
        problem = std::strerror(errno);
    else if (!S_ISREG(status.st_mode))
        problem = "it is not a file";
    return file;
}

} // namespace

std::string readWhole(Controller& controller, std::string_view path, std::string& bytes) {
    constexpr std::size_t kMost = std::size_t{4} << 20;
    std::string problem;
    const Descriptor file = openWhole(controller, path, O_RDONLY, problem);
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
    std::string problem;
    const Descriptor file = openWhole(controller, path, O_WRONLY | O_CREAT | O_TRUNC, problem);
    while (problem.empty() && !bytes.empty()) {
        const ssize_t count = ::write(file.number(), bytes.data(), bytes.size());
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return count == 0 ? "the disk is full" : std::strerror(errno);
        bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return problem;
}

} // namespace rt::lib
