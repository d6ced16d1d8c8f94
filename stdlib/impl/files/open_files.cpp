#include "stdlib/impl/files/open_files.h"

#include "runtime/debug/state_keepers.h"
#include "stdlib/impl/support/fail.h"
#include "stdlib/impl/time/calendar.h"

#include "stdlib_constants.h"

#include <fmt/format.h>

#include <poll.h>

namespace rt::lib {
namespace {

/// Nobody waits longer for a device that is a file of a volume: nothing but the program itself could add to it in virtual time.
constexpr Time kLongestWait = 8 * (3600 * kSecond);
constexpr Time kPollPeriod = kSecond / 10;

Status fileError(TaskCore* task, const OpenFile& file, std::string_view problem) {
    return fail(task, err::ERR_FILEACC, fmt::format("{}: {}", file.name(), problem));
}

} // namespace

OpenFiles& OpenFiles::of(Controller& controller) {
    return controller.service<OpenFiles>();
}

void OpenFiles::flushAll(Controller& controller) {
    for (auto& [handle, entry] : files_)
        if (entry.file->wasWritten()) entry.file->flush(calendarNow(controller)); // told when it is closed
}

void OpenFiles::closeOf(Controller& controller, Task* owner) {
    constexpr std::size_t kShown = 5;
    const auto concerns = [owner](std::size_t index) { return owner == nullptr || owner->index() == index; };
    std::vector<Handle> closed;
    std::string names;
    for (auto& [handle, entry] : files_) {
        if (!concerns(entry.owner)) continue;
        if (closed.size() < kShown) names += (closed.empty() ? "" : ", ") + entry.file->name();
        closed.push_back(handle);
        if (const std::string problem = entry.file->flush(calendarNow(controller)); !problem.empty())
            controller.log().write(EventId::FileDataLost, owner, {entry.file->name(), problem});
    }
    for (const Handle handle : closed)
        files_.erase(handle);
    if (closed.size() > kShown) names += fmt::format(" and {} more", closed.size() - kShown);
    if (!closed.empty()) controller.log().write(EventId::FilesClosed, owner, {names});
    closed.clear();
    for (const auto& [handle, directory] : directories_)
        if (concerns(directory.owner)) closed.push_back(handle);
    for (const Handle handle : closed)
        directories_.erase(handle);
}

void keepFiles(Controller& controller, StateKeepers& kept) {
    controller.onProgramReset(
        [&controller](Task& task) { OpenFiles::of(controller).closeOf(controller, &task); });
    controller.onShutDown([&controller] { OpenFiles::of(controller).closeOf(controller, nullptr); });
    controller.onSleep([&controller] { OpenFiles::of(controller).flushAll(controller); });
    for (const char* type : {"iodev", "dir"})
        kept.handles[type] = {[](Handle) { return std::string(); },
                              [](const std::string&) { return Handle{0}; }};
}

std::shared_ptr<OpenFile> fileOf(TaskCore* task, Handle handle, Status& status) {
    const OpenFiles::Entry* entry = OpenFiles::of(taskOf(task).controller()).files().find(handle);
    if (entry != nullptr) return entry->file;
    status = fail(task, err::ERR_FILEACC, "the variable names no open file or device: use Open first");
    return nullptr;
}

std::shared_ptr<OpenFile> fileToRead(TaskCore* task, Handle handle, Status& status) {
    std::shared_ptr<OpenFile> file = fileOf(task, handle, status);
    if (file == nullptr || file->mode().reads) return file;
    status =
        fileError(task, *file, "it is open for writing only; open it with \\Read, or with \\Bin for both");
    return nullptr;
}

std::shared_ptr<OpenFile> fileToWrite(TaskCore* task, Handle handle, Status& status) {
    std::shared_ptr<OpenFile> file = fileOf(task, handle, status);
    if (file == nullptr || file->mode().writes) return file;
    status = fileError(task, *file, "it is open for reading only; open it with \\Write or \\Append");
    return nullptr;
}

Status writeTo(TaskCore* task, Handle handle, std::string_view bytes) {
    Status status = kOk;
    const std::shared_ptr<OpenFile> file = fileToWrite(task, handle, status);
    if (file == nullptr) return status;
    const std::string problem = file->write(bytes);
    return problem.empty() ? kOk : fileError(task, *file, problem);
}

Reading::Reading(TaskCore* task, Handle handle, const float* time) : task_(task) {
    const double seconds = time != nullptr ? static_cast<double>(*time) : kUsualReadTime;
    if (!(seconds >= 0)) {
        status_ = fail(task, err::ERR_ARGVALERR, "\\Time must not be negative");
        return;
    }
    file_ = fileToRead(task, handle, status_);
    if (file_ == nullptr) return;
    const bool forEver = seconds >= static_cast<double>(k::WAIT_MAX);
    deadline_ = forEver ? kNever : addTime(taskOf(task).now(), fromSeconds(seconds));
}

Status Reading::more() {
    Controller& controller = taskOf(task_).controller();
    OpenFiles::of(controller).flushAll(controller); // another variable may have written to this file
    std::string problem;
    switch (file_->fill(problem)) {
    case OpenFile::Fill::More: return kOk;
    case OpenFile::Fill::End: atEnd_ = true; return kOk;
    case OpenFile::Fill::Later: return await();
    case OpenFile::Fill::Failed: break;
    }
    return fileError(task_, *file_, problem);
}

Status Reading::await() {
    Task& owner = taskOf(task_);
    WaitResult result = WaitResult::Done;
    Status status = kOk;
    if (file_->canPoll()) {
        status = owner.waitExternal(file_->input(), POLLIN, deadline_, result);
    } else {
        const Time deadline = std::min(deadline_, addTime(owner.now(), kLongestWait));
        bool came = false; // fill() below finds it again: the condition only looks for growth
        const std::size_t before = file_->buffered().size();
        const auto grown = [this, before, &came] {
            std::string ignored;
            OpenFiles::of(taskOf(task_).controller()).flushAll(taskOf(task_).controller());
            came = came || file_->fill(ignored) == OpenFile::Fill::More || file_->buffered().size() > before;
            return came;
        };
        status = owner.waitFor({{}, grown, deadline, kPollPeriod}, result);
    }
    if (status != kOk || result == WaitResult::Done) return status;
    return fail(task_, err::ERR_DEV_MAXTIME,
                fmt::format("{}: nothing was received in the time that \\Time allows", file_->name()));
}

} // namespace rt::lib
