#include "stdlib/impl/files/places.h"

#include "stdlib/impl/files/open_files.h"
#include "stdlib/impl/support/fail.h"

#include "stdlib_constants.h"

#include <fmt/format.h>

#include <fcntl.h>

#include <cerrno>
#include <cstring>

namespace rt::lib {

std::string shown(std::string_view text) {
    if (text.empty()) return "\"\"";
    std::string out;
    for (const char c : text) {
        const auto code = static_cast<unsigned char>(c);
        if (code < 0x20 || code == 0x7F)
            out += fmt::format("\\{:02X}", code);
        else
            out += c;
    }
    return out;
}

Status placeOf(TaskCore* task, const String& path, LastLink last, VolumePlace& place) {
    const std::string problem = taskOf(task).controller().volumes().locate(path.view(), last, place);
    return problem.empty() ? kOk
                           : fail(task, err::ERR_FILEACC, fmt::format("{}: {}", shown(path.view()), problem));
}

Status statusOf(TaskCore* task, const String& path, struct stat& status) {
    Controller& controller = taskOf(task).controller();
    OpenFiles::of(controller).flushAll(controller);
    VolumePlace place;
    if (const Status problem = placeOf(task, path, LastLink::Follow, place)) return problem;
    if (::fstatat(place.folder.number(), place.name.c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0) return kOk;
    return accessError(task, path, "found", errno);
}

Status accessError(TaskCore* task, const String& path, std::string_view verb, int problem) {
    return fail(task, err::ERR_FILEACC,
                fmt::format("{} cannot be {}: {}", shown(path.view()), verb, std::strerror(problem)));
}

} // namespace rt::lib
