#pragma once
// The call chain of a task with all of its data, as it is kept between two processes (--state; manual 1.2.2, column
// "Power on"): taken from a halted task, and built up again by Reentry.

#include "runtime/sched/task.h"

#include <cstdint>
#include <string>
#include <vector>

namespace rt {

struct StateKeepers;

/// One parameter or variable of a routine in progress.
struct SavedLocal {
    enum class Kind : uint8_t {
        Value,  ///< `value`
        Absent, ///< optional parameter that is not given
        Object, ///< a parameter that refers to a part of `object`, a named data object
        Copy, ///< a parameter that refers to something without a name: an expression, an array of its own; `value`
        Fresh ///< a file, a socket ...: made again
    };
    Kind kind = Kind::Value;
    std::string type; ///< with all components and dimensions
    std::string value;
    std::string object;  ///< key of module data, or "3:1": local 1 of the routine at depth 3
    uint64_t offset = 0; ///< bytes into it
};

struct SavedFrame {
    std::string module, routine;
    uint32_t textHash = 0;
    int32_t statement = -1;
    int32_t failed = -1; ///< in its error handler: the statement that failed
    std::vector<SavedLocal> locals;
};

struct CallChain {
    std::vector<SavedFrame> frames; ///< main first. None: before the first statement of main
    bool afterStop = false;
    ErrorMemory errors;
};

/// Finds module data by address. Keys tell data of all tasks apart.
class DataIndex {
  public:
    void add(const GlobalDesc& data, std::string key);
    void sort();
    /// Null: no module data lies there.
    const std::string* find(const void* address, uint64_t& offset) const;

  private:
    struct Row {
        const char* begin;
        uint64_t size;
        std::string key;
    };
    std::vector<Row> rows_;
};

/// A task, and the tables of the names and keepers of its data.
struct TaskData {
    const Task& task;
    const DataIndex& index;
    const StateKeepers& keepers;
};

/// "" or why a later process cannot continue at the place of the task. The task must not execute.
std::string takeChain(const TaskData& data, CallChain& chain);

/// The present value of a local of a frame.
SavedLocal takeLocal(const SteppingFrame& frame, uint32_t index, const std::vector<Frame*>& frames,
                     const TaskData& data);

/// Any value as text: as in a declaration, its bytes ("#...") where it has no literal, or what its handles name ("@[...]").
/// False for types without values whose objects are not kept.
bool valueToImage(const void* data, const TypeDesc& type, uint64_t count, const StateKeepers& keepers,
                  std::string& text);
/// The reverse; all or nothing.
bool imageToValue(const std::string& text, void* data, const TypeDesc& type, uint64_t count,
                  const StateKeepers& keepers);

} // namespace rt
