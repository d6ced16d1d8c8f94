#pragma once
// Supervision of sensor synchronisation: the sensor must be where the robot, by its place on the path, expects it.

#include "runtime/host/conveyors.h"
#include "runtime/motion/path_modifier.h"

#include <functional>

namespace rt::lib {

/// The movement begins and ends with the sensor at these positions.
struct SensorSpan : motion::Modification {
    double from = 0, to = 0;
};

/// Looks on while the robot moves; it displaces nothing.
class SensorSupervision final : public motion::PathModifier {
  public:
    struct Limits {
        const Conveyor* sensor = nullptr; ///< null: off
        double from = 0, to = 0;          ///< where the sensor is supervised, mm
        double allowed = 0;               ///< mm between the sensor and where it is expected
        double delay = 0;                 ///< s that it may be farther away
    };
    /// `report`: called once, with the sensor's position and the expected one.
    explicit SensorSupervision(std::function<void(double, double)> report) : report_(std::move(report)) {}

    void set(const Limits& limits);
    bool isActive() const override { return limits_.sensor != nullptr; }
    void advance(const motion::PlannedMoment& planned) override;
    motion::Pose displaced(const motion::PlannedMoment&, const motion::Pose& tcp) const override {
        return tcp;
    }

  private:
    std::function<void(double, double)> report_;
    Limits limits_;
    uint64_t tag_ = 0;
    double length_ = 0; ///< of the movement, from where it was seen first
    double beyond_ = 0; ///< s for which the sensor has been too far away
};

} // namespace rt::lib
