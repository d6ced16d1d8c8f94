#pragma once
// World zones (manual 2.9): volumes in which the robot sets an output or before which it is stopped. The TCP of the active
// tool is looked at in world coordinates, or all axes. While the arm moves it is looked at every millisecond, and the moment
// of a change in between is searched; nothing happens while it is at rest.

#include "stdlib/impl/motion/zone_shapes.h"

#include <optional>

namespace rt {
struct StateKeepers;
}

namespace rt::lib {

struct WorldZone {
    enum class Action : uint8_t {
        Stop, ///< WZLimSup: the program stops with event 50920 so that the arm comes to rest at the border
        OutputInside, ///< WZDOSet \Inside: `output` is `value` while the TCP is inside
        OutputBefore  ///< WZDOSet \Before: already where the arm could just be stopped at the border
    };
    int number = 0; ///< identity, from 1; never given twice
    bool stationary = false;
    bool enabled = true;
    Action action = Action::Stop;
    ZoneShape shape;
    Handle output = 0;
    bool value = true;          ///< inside; outside it is the opposite
    std::optional<bool> inside; ///< as it was acted upon last
    Time stopAt = kNever;       ///< the last moment to stop an arm that would enter
};

class WorldZones {
  public:
    static constexpr std::size_t kMost = 20; ///< at the same time

    /// Once, before anything else.
    void connect(Controller& controller, MotionDriver& motion) {
        controller_ = &controller;
        motion_ = &motion;
    }
    /// Gives the zone its number and acts on where the arm is; 0 when there are kMost already.
    int add(const WorldZone& zone);
    /// Null when there is no such zone.
    WorldZone* find(int number);
    void enable(WorldZone& zone);
    /// Its output keeps its value.
    void disable(WorldZone& zone) { zone.enabled = false; }
    void erase(int number);
    void eraseTemporary();
    /// The arm may have begun to move without a movement on its path.
    void noteMotion();
    const std::vector<WorldZone>& all() const { return zones_; }
    /// Temporary zones of an earlier process, in place of all there are.
    void restore(std::vector<WorldZone> zones, int lastNumber);
    int lastNumber() const { return lastNumber_; }

  private:
    void listen();
    void take(ArmChange news);
    void lookAt(Time time);
    void look();
    void act(WorldZone& zone, bool inside);

    Controller* controller_ = nullptr;
    MotionDriver* motion_ = nullptr;
    std::vector<WorldZone> zones_;
    int lastNumber_ = 0;
    EventToken tick_ = 0;
    bool listening_ = false;
    bool motorsOff_ = false;
};

/// The zones of a motion group: they supervise its robot.
WorldZones& zonesOf(Controller& controller, MotionDriver& motion);
/// The program begins again: temporary zones are erased.
void endTemporaryZones(Task& task);
/// Temporary zones and shapedata variables between two processes (--state).
void keepWorldZones(Controller& controller, StateKeepers& kept);

} // namespace rt::lib
