#pragma once
// Path recorder (manual 1.8): the movements of the program since PathRecStart, and the way back along them.
//
// A position on the recorded path is a number of movements: 0 is where recording began, n the end of the n-th one. The arm
// may stand inside the last one. Movements of other path levels (StorePath) are not recorded, nor those of the recorder.

#include "runtime/host/controller.h"

#include <deque>
#include <optional>
#include <vector>

namespace rt::lib {

class PathRecorder {
  public:
    /// Movements that are kept; the oldest ones are forgotten.
    static constexpr std::size_t kMost = 10'000;

    /// Records from now on; `id` names the present position. An earlier one of the same name is forgotten.
    void start(TaskCore* task, Handle id);
    void stop() { recording_ = false; }
    void clear();
    bool isRecording() const { return recording_; }
    Handle newId() { return ++lastId_; }

    /// The position to go back to: that of `id`, for 0 the latest named one that is not where the arm is. Nothing when no
    /// way leads back to it.
    std::optional<std::size_t> goalBack(const motion::MotionSystem& arm, Handle id) const;
    /// The position to go forward to: that of `id`, for 0 where the way back began.
    std::optional<std::size_t> goalForward(Handle id) const;

    /// How the recorded movements are executed again.
    struct Manner {
        motion::Pose offset;                    ///< in the frame of the tool, mm
        std::optional<motion::SpeedData> speed; ///< in place of the recorded ones
    };
    /// Orders the movements and waits until the arm has arrived. The path of this level is finished.
    Status moveBack(Task& task, std::size_t goal, const Manner& manner);
    Status moveForward(Task& task, std::size_t goal, const Manner& manner);

  private:
    struct Recorded {
        motion::MoveId id = 0;
        motion::MoveCommand command;
        motion::JointTarget from, to;
        bool partial = false; ///< the arm has not come to its end
    };
    struct Named {
        Handle id = 0;
        std::size_t position = 0;
    };
    /// A way back that has not been gone forward again.
    struct Replay {
        std::vector<Recorded> way; ///< the recorded movements, the last one up to where the arm was
        std::size_t at = 0;        ///< the position of the arm now
    };

    void note(const MotionDriver::Ordered& order);
    void joinTo(const motion::JointTarget& from);
    void truncate(std::size_t position);
    void forgetOldest();
    std::vector<Recorded> wayToHere(const motion::MotionSystem& arm) const;
    Status order(Task& task, motion::MoveCommand command, motion::MoveId& id);

    TaskCore* task_ = nullptr;
    bool recording_ = false, replaying_ = false, listening_ = false;
    std::deque<Recorded> moves_;
    std::vector<Named> names_; // in the order of the positions
    std::optional<Replay> replay_;
    Handle lastId_ = 0;
};

/// The program begins again: nothing is recorded any more.
void endPathRecording(MotionDriver& motion);

} // namespace rt::lib
