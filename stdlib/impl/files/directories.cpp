// Manual 1.16: directories.

#include "stdlib/impl/files/open_files.h"
#include "stdlib/impl/files/places.h"
#include "stdlib/impl/support/fail.h"
#include "stdlib/impl/time/calendar.h"

#include "natives/files.h"
#include "stdlib_constants.h"

#include <fmt/format.h>

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <memory>

using namespace rt;
using lib::LastLink;
using lib::OpenFiles;

namespace {

/// "." and ".." first, as on a controller, then the others in the order of their bytes: the same on every host.
bool namesIn(const VolumePlace& place, std::vector<std::string>& names) {
    const int file =
        ::openat(place.folder.number(), place.name.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC | O_NOFOLLOW);
    if (file < 0) return false;
    const std::unique_ptr<DIR, int (*)(DIR*)> folder(::fdopendir(file), ::closedir);
    if (folder == nullptr) {
        ::close(file);
        return false;
    }
    errno = 0;
    while (const dirent* entry = ::readdir(folder.get())) {
        const std::string name = entry->d_name;
        if (name != "." && name != "..") names.push_back(name);
    }
    if (errno != 0) return false;
    std::sort(names.begin(), names.end());
    names.insert(names.begin(), {".", ".."});
    return true;
}

} // namespace

extern "C" {

Status rt_MakeDir(TaskCore* task, const String* Path) {
    VolumePlace place;
    if (const Status status = lib::placeOf(task, *Path, LastLink::Follow, place)) return status;
    if (::mkdirat(place.folder.number(), place.name.c_str(), 0777) != 0)
        return lib::accessError(task, *Path, "made", errno);
    const timespec moment{static_cast<time_t>(lib::calendarNow(taskOf(task))), 0};
    const timespec both[] = {moment, moment};
    ::utimensat(place.folder.number(), place.name.c_str(), both, AT_SYMLINK_NOFOLLOW);
    return kOk;
}

Status rt_RemoveDir(TaskCore* task, const String* Path) {
    VolumePlace place;
    if (const Status status = lib::placeOf(task, *Path, LastLink::Keep, place)) return status;
    if (place.name == ".")
        return lib::fail(task, err::ERR_FILEACC,
                         fmt::format("{}: a volume cannot be removed", lib::shown(Path->view())));
    if (::unlinkat(place.folder.number(), place.name.c_str(), AT_REMOVEDIR) == 0) return kOk;
    return lib::accessError(task, *Path, "removed", errno);
}

Status rt_OpenDir(TaskCore* task, Handle* Dev, const String* Path) {
    OpenFiles& open = OpenFiles::of(taskOf(task).controller());
    if (open.directories().find(*Dev) != nullptr)
        return lib::fail(task, err::ERR_FILEACC, "the variable names an open directory: use CloseDir first");
    if (open.directories().size() >= OpenFiles::kMostOpen)
        return lib::fail(
            task, err::ERR_FILEACC,
            fmt::format("{} directories are open already, the maximum; close some", OpenFiles::kMostOpen));
    VolumePlace place;
    if (const Status status = lib::placeOf(task, *Path, LastLink::Follow, place)) return status;
    OpenFiles::Directory directory;
    directory.owner = taskOf(task).index();
    if (!namesIn(place, directory.names)) return lib::accessError(task, *Path, "opened", errno);
    *Dev = open.directories().create(std::move(directory));
    return kOk;
}

Status rt_ReadDir(TaskCore* task, bool* result, Handle* Dev, String* FileName) {
    OpenFiles::Directory* directory = OpenFiles::of(taskOf(task).controller()).directories().find(*Dev);
    if (directory == nullptr)
        return lib::fail(task, err::ERR_FILEACC, "the variable names no open directory: use OpenDir first");
    *result = directory->next < directory->names.size();
    if (!*result) return kOk;
    const std::string& name = directory->names[directory->next++];
    if (name.size() > kStringCapacity)
        return lib::fail(task, err::ERR_FILEACC,
                         fmt::format("the name {} has more than the 80 bytes of a string; the next ReadDir "
                                     "continues after it",
                                     lib::shown(name)));
    FileName->assign(name);
    return kOk;
}

Status rt_CloseDir(TaskCore* task, Handle* Dev) {
    OpenFiles::of(taskOf(task).controller()).directories().erase(*Dev);
    *Dev = 0;
    return kOk;
}
}
