// Manual 1.10: Open, Close, Rewind, ClearIOBuff.

#include "stdlib/impl/files/open_files.h"
#include "stdlib/impl/files/places.h"
#include "stdlib/impl/support/fail.h"
#include "stdlib/impl/time/calendar.h"

#include "natives/devices.h"
#include "stdlib_constants.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

using namespace rt;
using lib::OpenFile;
using lib::OpenFiles;

namespace {

struct Way {
    bool read = false, write = false, append = false, binary = false;

    /// Nothing said: text is written from the beginning, binary files are read, and written at the end.
    OpenFile::Mode mode() const {
        const bool both = binary && !read && !write;
        return {read || both, !read, both || append};
    }
};

int flagsOf(const OpenFile::Mode& mode) {
    int flags = O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY;
    flags |= mode.reads && mode.writes ? O_RDWR : mode.writes ? O_WRONLY : O_RDONLY;
    if (mode.writes) flags |= O_CREAT | (mode.appends ? O_APPEND : O_TRUNC);
    return flags;
}

/// Why no more than `problem` can be opened, and which error says so.
struct Refusal {
    Status error = err::ERR_FILEOPEN;
    std::string problem;
};

/// Opens one file of a volume. A FIFO is opened both ways: so it has no end while its writer is away.
Descriptor openPath(const Volumes& volumes, const std::string& path, const OpenFile::Mode& mode,
                    Refusal& refusal) {
    VolumePlace place;
    if (refusal.problem = volumes.locate(path, Volumes::LastLink::Follow, place); !refusal.problem.empty()) {
        if (place.leaves) refusal.error = err::ERR_FILEACC;
        return {};
    }
    struct stat status{};
    const bool exists =
        ::fstatat(place.folder.number(), place.name.c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0;
    const auto isPossible = [&status] { return S_ISREG(status.st_mode) || S_ISFIFO(status.st_mode); };
    if (exists && !isPossible()) {
        refusal.problem = S_ISDIR(status.st_mode) ? "it is a directory; give the file name, too (\\File)"
                                                  : "it is not a file";
        return {};
    }
    const int flags = exists && S_ISFIFO(status.st_mode)
                          ? O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_RDWR
                          : flagsOf(mode);
    Descriptor file(::openat(place.folder.number(), place.name.c_str(), flags, 0666));
    if (!file.isOpen()) {
        refusal.problem = std::strerror(errno);
        return {};
    }
    if (::fstat(file.number(), &status) != 0 || !isPossible()) {
        refusal.problem = "it is not a file";
        return {};
    }
    if (mode.appends && S_ISREG(status.st_mode))
        ::lseek(file.number(), 0, SEEK_END); // reading begins there, too
    return file;
}

std::shared_ptr<OpenFile> openDevice(const Volumes& volumes, const Volumes::Device& device,
                                     const std::string& name, OpenFile::Mode mode, Refusal& refusal) {
    Descriptor input, output;
    if (mode.reads) {
        input = openPath(volumes, device.input, {true, false, false}, refusal);
        if (!input.isOpen()) return nullptr;
    }
    if (mode.writes) {
        output = openPath(volumes, device.output, {false, true, true}, refusal);
        if (!output.isOpen()) return nullptr;
    }
    return std::make_shared<OpenFile>(name, mode, std::move(input), std::move(output), true);
}

std::shared_ptr<OpenFile> openFile(Controller& controller, const std::string& path, const Way& way,
                                   Refusal& refusal) {
    const Volumes& volumes = controller.volumes();
    const OpenFile::Mode mode = way.mode();
    if (const Volumes::Device* device = volumes.device(path))
        return openDevice(volumes, *device, path.substr(0, path.find(':') + 1), mode, refusal);
    Descriptor file = openPath(volumes, path, mode, refusal);
    if (!file.isOpen()) return nullptr;
    struct stat status{};
    const bool isPipe = ::fstat(file.number(), &status) == 0 && S_ISFIFO(status.st_mode);
    auto opened = std::make_shared<OpenFile>(lib::shown(path), mode, std::move(file), Descriptor(), isPipe);
    if (mode.writes && status.st_size == 0) opened->noteChange();
    return opened;
}

} // namespace

extern "C" {

Status rt_Open(TaskCore* task, const String* Object, const String* File, Handle* IODevice, bool Read,
               bool Write, bool Append, bool Bin) {
    Controller& controller = taskOf(task).controller();
    OpenFiles& open = OpenFiles::of(controller);
    if (const OpenFiles::Entry* used = open.files().find(*IODevice))
        return lib::fail(task, err::ERR_FILEOPEN,
                         fmt::format("the variable names {} already: use Close first", used->file->name()));
    const std::string path = Volumes::joined(Object->view(), File != nullptr ? File->view() : "");
    if (open.files().size() >= OpenFiles::kMostOpen)
        return lib::fail(task, err::ERR_FILEOPEN,
                         fmt::format("{}: {} files are open already, the maximum; close some",
                                     lib::shown(path), OpenFiles::kMostOpen));
    open.flushAll(controller); // the same file may be open already
    Refusal refusal;
    std::shared_ptr<OpenFile> file = openFile(controller, path, {Read, Write, Append, Bin}, refusal);
    if (file == nullptr)
        return lib::fail(task, refusal.error,
                         fmt::format("{} cannot be opened: {}", lib::shown(path), refusal.problem));
    *IODevice = open.files().create(OpenFiles::Entry{std::move(file), taskOf(task).index()});
    return kOk;
}

/// Without effect on a variable that names nothing: programs close to be sure. What cannot be written stays, so that the
/// program can make room and close again.
Status rt_Close(TaskCore* task, Handle* IODevice) {
    Controller& controller = taskOf(task).controller();
    OpenFiles& open = OpenFiles::of(controller);
    if (const OpenFiles::Entry* entry = open.files().find(*IODevice)) {
        if (const std::string problem = entry->file->flush(lib::calendarNow(controller)); !problem.empty())
            return lib::fail(task, err::ERR_FILEACC, fmt::format("{}: {}", entry->file->name(), problem));
        open.files().erase(*IODevice);
    }
    *IODevice = 0;
    return kOk;
}

Status rt_Rewind(TaskCore* task, Handle* IODevice) {
    Status status = kOk;
    const std::shared_ptr<OpenFile> file = lib::fileOf(task, *IODevice, status);
    if (file == nullptr) return status;
    const std::string problem = file->rewind();
    return problem.empty() ? kOk
                           : lib::fail(task, err::ERR_FILEACC, fmt::format("{}: {}", file->name(), problem));
}

Status rt_ClearIOBuff(TaskCore* task, Handle* IODevice) {
    Status status = kOk;
    const std::shared_ptr<OpenFile> file = lib::fileToRead(task, *IODevice, status);
    if (file == nullptr) return status;
    if (!file->isDevice())
        return lib::fail(task, err::ERR_FILEACC,
                         fmt::format("{}: ClearIOBuff is for serial channels, not for files", file->name()));
    Controller& controller = taskOf(task).controller();
    OpenFiles::of(controller)
        .flushAll(controller); // the program itself may have written what the device receives
    file->discardInput();
    return kOk;
}
}
