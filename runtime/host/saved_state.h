#pragma once
// SavedState: what a controller keeps when it is switched off (manual 1.2.2, column "Power on"), in a folder of the host
// (--state=DIR), so that it survives the end of the process. Read once at the start, written at the end, when the
// program stops, and every second meanwhile; the file is replaced in one step.

#include "runtime/debug/call_chain.h"
#include "runtime/debug/reentry.h"
#include "runtime/host/motion_driver.h"
#include "runtime/log/event_log.h"

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rt {

class Controller;
class Task;
struct GlobalDesc;

/// The content of a state file.
struct StateImage {
    /// The place of the program pointer of a task.
    enum class Pointer : uint8_t {
        Main,   ///< at main, variables to be initialised
        Ended,  ///< main returned: the next start is one after a cycle
        Inside, ///< in the program
        Exited  ///< EXIT: the next start is from main, but not in the run that continues
    };
    struct Interrupt {
        SavedInterrupt what;
        std::string module, routine; ///< of its trap; "" = none is connected
    };
    struct TaskImage {
        Pointer pointer = Pointer::Main;
        std::string place;              ///< "Main:12"
        uint64_t cycles = 0;            ///< how often main has returned
        std::optional<CallChain> chain; ///< Inside: how to continue there; none:
        std::string refusal;            ///< why that is not possible
        std::vector<Interrupt> interrupts;
        std::vector<int> queuedInterrupts; ///< those that a stop leaves in the queue
        bool interruptsEnabled = true;
    };
    struct Datum {
        std::string type;    ///< with all components, as describeType
        std::string initial; ///< what its declaration said
        std::string value;
    };
    std::map<std::string, TaskImage> tasks;
    std::map<std::string, Datum> persistents; ///< by keyOf
    std::map<std::string, Datum> variables;
    std::map<std::string, Datum>
        interruptNumbers; ///< intnum variables: of use to a task that continues alone
    /// Of each motion group.
    struct Group {
        std::string robot;        ///< model
        std::vector<double> axes; ///< robot, then external axes; degrees, mm
        MotionDriver::EarlierPath path;
    };
    std::vector<Group> groups;
    /// Tasks between SyncMoveOn and SyncMoveOff, those that move together in one list; the first one leads.
    std::vector<std::vector<std::string>> synchronised;
    std::map<std::string, std::string> kept; ///< of StateKeepers, JSON
    std::map<std::string, double> signals;   ///< those that keep their value over a power failure (Store)
    std::vector<Event> events;
};

/// Reads and writes the text of a state file. The reader never throws: "" or what is wrong. `units`: those that move work
/// objects.
std::string readImage(const std::string& text, StateImage& image, const robot::UnitLookup& units = {});
std::string writeImage(const StateImage& image);

class SavedState {
  public:
    explicit SavedState(Controller& controller) : controller_(controller) {}
    ~SavedState();
    SavedState(const SavedState&) = delete;
    SavedState& operator=(const SavedState&) = delete;

    /// Takes the folder, which is made when it does not exist. False with a message when that is not possible or when
    /// another process uses it.
    bool open(const std::string& folder, std::string& error);
    /// Called before each writing: what the state remembers as done (a line of a file) must be on disk before the state is.
    void setBeforeWriting(std::function<void()> action) { beforeWriting_ = std::move(action); }
    /// Takes over what an earlier run left; once tasks and signals exist and before anything runs. A file that cannot be
    /// understood is put aside, with an event; false with a message when one is there and cannot be read.
    bool restore(std::string& error);
    /// The same from text() of another controller of this process, with or without a folder.
    void continueFrom(const std::string& text);
    /// Notes the initial values, before the tasks run.
    void remember();
    /// The state as it is now. Every task must be between two instructions.
    std::string text() const { return writeImage(present()); }
    /// Writes the state as it is now; false when it is not on disk. Every task must stand between two instructions.
    bool write();
    /// To be called often between slices: writes when the last time was a second ago. While a task is where no later
    /// process could continue, it waits for a better moment, for a further second at most.
    void keepFresh();

  private:
    using Rows = std::vector<std::pair<const GlobalDesc*, std::string>>; ///< data with their initial values
    std::string path() const;
    void putAside(const std::string& why);
    std::string restoreText(const std::string& text);
    StateImage present() const;
    StateImage::TaskImage presentTask(Task& task) const;
    void write(const StateImage& image);
    void restore(StateImage& image);
    void restoreTasks(const StateImage& image);
    void restorePaths(StateImage& image);
    void restoreTogether(const StateImage& image, const std::vector<std::string>& names);
    const RoutineEntry* trapAt(EntryFunction function) const;
    void restoreKept(const StateImage& image);
    void restoreInterrupts(Task& task, const StateImage::TaskImage& image);
    bool restorePointer(Task& task, const StateImage::TaskImage& image);
    void restoreData(const Rows& rows, const std::map<std::string, StateImage::Datum>& data);
    void restoreSurroundings(const StateImage& image);
    std::string keyOf(const GlobalDesc& data) const;
    const Task* ownerOf(const GlobalDesc& data) const;

    Controller& controller_;
    std::string folder_;
    std::function<void()> beforeWriting_;
    int lock_ = -1;
    bool remembered_ = false;
    bool failed_ = false; // writing failed, which was reported
    Rows persistents_, variables_, interruptNumbers_;
    DataIndex data_;
    std::vector<std::unique_ptr<Reentry>> reentries_;
    std::map<const Task*, StateImage::TaskImage> earlier_; ///< of tasks that have not got back there yet
    std::chrono::steady_clock::time_point written_{}, tried_{};
};

} // namespace rt
