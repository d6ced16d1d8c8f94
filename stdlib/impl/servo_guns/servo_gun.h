#pragma once
// ServoGun: a gun whose tips an external axis moves: 0 mm is closed, positive open. Simulated: it meets the sheet that the
// stimulus puts between the tips, and builds force there. Positions in mm, forces in N.

#include "stdlib/impl/servo_guns/gun_setup.h"

#include <nlohmann/json_fwd.hpp>

#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace rt {
struct StateKeepers;
}

namespace rt::lib {

class ServoGun {
  public:
    ServoGun(Controller& controller, MechanicalUnit& unit, GunSetup setup);
    ServoGun(const ServoGun&) = delete;
    ServoGun& operator=(const ServoGun&) = delete;

    enum class Phase : uint8_t { Open, Closing, Building, Closed, Opening, Calibrating };

    const MechanicalUnit& unit() const { return unit_; }
    const GunSetup& setup() const { return setup_; }
    Phase phase() const { return phase_; }
    bool isInitialized() const { return isInitialized_; }
    bool isSynchronized() const { return isSynchronized_; }
    bool isIndependent() const;
    double thickness() const { return thickness_; }   ///< measured when the gun was closed last
    double tipWear() const { return tipWear_; }       ///< found by calibration, since the tips were changed
    double adjustment() const { return adjustment_; } ///< of the position, by the last calibration
    void tuneRamp(double percent) { rampPercent_ = percent; }

    /// Closes to the sheet, or to `expected` when the stimulus gives none, and builds force. `conc`: returns when the gun
    /// begins to move. The error of a movement that the motors' end interrupted comes here.
    Status close(TaskCore* task, double expected, bool conc);
    /// Opens to where it was closed from.
    Status open(TaskCore* task, bool conc);
    enum class Calibration : uint8_t { ToolChange, TipChange, TipWear };
    /// Closes slowly, from `prePos` on when it is not negative, and opens again.
    Status calibrate(TaskCore* task, Calibration kind, double prePos, bool conc);
    /// Independent of the robot's movements from now on, and moves.
    Status moveAlone(TaskCore* task, double position);
    void endIndependence();
    /// The part that another process needs to continue (--state).
    nlohmann::json state() const;
    /// Takes that over. A movement in progress was ended by the power failure: the instruction that waited for it raises
    /// ERR_SGUN_MOTOFF when it is executed again. Throws what the JSON library throws.
    void restore(const nlohmann::json& state);
    /// The program begins again: a movement in progress is forgotten.
    void reset();

  private:
    Status order(TaskCore* task, double position, double speed, bool conc, std::function<void()> atEnd);
    class Awaited;
    Status begin(TaskCore* task, Phase phase);
    Status waitPhase(TaskCore* task, Phase phase);
    void take(ArmChange news);
    void met();
    void enter(Phase phase);
    double wear() const;

    Controller& controller_;
    MechanicalUnit& unit_;
    GunSetup setup_;
    MotionDriver& motion_;
    Phase phase_ = Phase::Open;
    bool isInitialized_ = true, isSynchronized_ = true;
    double openAt_ = 0, thickness_ = 0;
    double wearBase_ = 0, wearKnown_ = 0, tipWear_ = 0, adjustment_ = 0;
    double rampPercent_ = 100;
    bool isAwaited_ = false;   ///< an instruction is in progress that ends with its movement
    bool wasCutOff_ = false;   ///< by the end of an earlier process
    Status interrupted_ = kOk; ///< ERR_SGUN_ESTOP or ERR_SGUN_MOTOFF during the movement
    EventToken ready_ = 0;
    WaitQueue changed_;
};

/// All guns of a controller.
class ServoGuns {
  public:
    /// Null when the unit is not there or not a gun.
    ServoGun* find(Controller& controller, std::string_view unit);
    /// The program of a task begins again.
    void reset();
    const std::map<const MechanicalUnit*, std::unique_ptr<ServoGun>>& known() const { return guns_; }

  private:
    std::map<const MechanicalUnit*, std::unique_ptr<ServoGun>> guns_; ///< null: not a gun
};

/// Servo guns between two processes (--state).
void keepServoGuns(Controller& controller, StateKeepers& kept);

} // namespace rt::lib
