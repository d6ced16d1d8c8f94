#pragma once
// The files, devices and directories that the programs of a controller have open (manual 1.10, 1.16).

#include "runtime/host/controller.h"
#include "stdlib/impl/files/open_file.h"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace rt {
struct StateKeepers;
}

namespace rt::lib {

/// How long ReadStr and its like wait when \Time is left out.
inline constexpr double kUsualReadTime = 60; // s

class OpenFiles {
  public:
    static constexpr std::size_t kMostOpen = 128;

    /// The service of this controller.
    static OpenFiles& of(Controller& controller);

    struct Directory {
        std::vector<std::string> names; ///< in order
        std::size_t next = 0;
        std::size_t owner = 0; ///< number of the task
    };
    struct Entry {
        std::shared_ptr<OpenFile> file; ///< shared with instructions that wait for input meanwhile
        std::size_t owner = 0;
    };
    HandleTable<Entry>& files() { return files_; }
    HandleTable<Directory>& directories() { return directories_; }

    /// Hands over everything written to the host, so that it is seen by whoever looks at the files now.
    void flushAll(Controller& controller);
    /// Closes what a task has opened, with one event; null: all tasks.
    void closeOf(Controller& controller, Task* owner);

  private:
    HandleTable<Entry> files_;
    HandleTable<Directory> directories_;
};

/// Files are closed when a program begins again, at a power failure and at the end; variables name none after a restart (--state).
void keepFiles(Controller& controller, StateKeepers& kept);

/// The open file that a variable names. Null and ERR_FILEACC raised when there is none.
std::shared_ptr<OpenFile> fileOf(TaskCore* task, Handle handle, Status& status);
/// The same, opened for reading or for writing.
std::shared_ptr<OpenFile> fileToRead(TaskCore* task, Handle handle, Status& status);
std::shared_ptr<OpenFile> fileToWrite(TaskCore* task, Handle handle, Status& status);

/// Writes; ERR_FILEACC when that is not possible.
Status writeTo(TaskCore* task, Handle handle, std::string_view bytes);

/// Reading waits for as long as \Time says (null: 60 s), then raises ERR_DEV_MAXTIME.
class Reading {
  public:
    Reading(TaskCore* task, Handle handle, const float* time);
    /// The error of the file or \Time; kOk: it can be read.
    Status status() const { return status_; }
    OpenFile& file() { return *file_; }
    /// Bytes that can be read now.
    std::string_view buffered() const { return file_->buffered(); }
    /// The end of the file was reached: no bytes follow the buffered ones.
    bool atEnd() const { return atEnd_; }

    /// Gets bytes until `enough` says that there are enough, or the file ends.
    template <class Enough> Status until(Enough enough) {
        while (!enough(file_->buffered()) && !atEnd_)
            if (const rt::Status status = more()) return status;
        return kOk;
    }
    Status untilSize(std::size_t bytes) {
        return until([bytes](std::string_view buffered) { return buffered.size() >= bytes; });
    }

  private:
    Status more();
    Status await();

    TaskCore* task_;
    std::shared_ptr<OpenFile> file_;
    Time deadline_ = 0;
    Status status_ = kOk;
    bool atEnd_ = false;
};

} // namespace rt::lib
