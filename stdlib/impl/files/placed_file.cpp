#include "stdlib/impl/files/placed_file.h"

#include "config/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>

namespace rt::lib {

int PlacedFile::make(const VolumePlace& place) {
    place_ = &place;
    folder_ = fmt::format("/proc/self/fd/{}", place.folder.number());
    rapid::config::removeLeftovers(folder_);
    return file_.make(folder_, place.name);
}

int PlacedFile::replace(mode_t mode) {
    if (::fchmod(descriptor(), mode) != 0) return errno;
    return file_.renameTo(folder_ + "/" + place_->name);
}

int PlacedFile::putNew(mode_t mode) {
    if (::fchmod(descriptor(), rapid::config::permissionsOfNew(mode)) != 0) return errno;
    const std::string own = fmt::format("/proc/self/fd/{}", descriptor());
    if (::linkat(AT_FDCWD, own.c_str(), place_->folder.number(), place_->name.c_str(), AT_SYMLINK_FOLLOW) ==
        0)
        return 0;
    if (errno == EEXIST) return errno;
    // File systems without hard links: nothing was there a moment ago, which is as near as they come.
    struct stat status{};
    if (::fstatat(place_->folder.number(), place_->name.c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0)
        return EEXIST;
    return file_.renameTo(folder_ + "/" + place_->name);
}

int replaceWhole(const VolumePlace& place, std::string_view bytes) {
    const int folder = place.folder.number();
    struct stat old{};
    const bool exists = ::fstatat(folder, place.name.c_str(), &old, AT_SYMLINK_NOFOLLOW) == 0;
    PlacedFile file;
    int error = file.make(place);
    if (error == 0) error = rapid::config::writeAll(file.descriptor(), bytes);
    if (error == 0 && ::fsync(file.descriptor()) != 0) error = errno;
    if (error == 0)
        error = file.replace(exists ? old.st_mode & 07777 : rapid::config::permissionsOfNew(0666));
    if (error != 0) return error;
    const Descriptor readable(
        ::openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC)); // it may be a mere path
    if (readable.isOpen()) ::fsync(readable.number());
    return 0;
}

} // namespace rt::lib
