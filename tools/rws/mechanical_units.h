#pragma once
// MechanicalUnits: /rw/motionsystem and its mechunits: positions, frames, choices, kinematics, jogging.

#include "tools/rws/access.h"
#include "tools/rws/router.h"
#include "tools/rws/subscribable.h"
#include "tools/service/manual_motion.h"

#include <array>
#include <optional>
#include <string>

namespace rapidc::rws {

class MechanicalUnits {
  public:
    /// All of them must outlive the routes.
    MechanicalUnits(service::VirtualController& controller, service::ManualMotion& manual,
                    const Access& access)
        : controller_(controller), manual_(manual), access_(access) {}
    void addTo(Router& router, Subscribables& subscribables);

  private:
    using Unit = rt::MechanicalUnit;
    const Unit* unitOf(const Request& request) const;
    static Reply noUnit(const Request& request);
    /// A handler for the unit that the request names: 404 or 400 when there is none.
    Handler forUnit(Reply (MechanicalUnits::*handler)(const Request&, const Unit&) const) const;
    Handler forUnit(Reply (MechanicalUnits::*handler)(const Request&, const Unit&));
    Handler changing(Reply (MechanicalUnits::*handler)(const Request&, const Unit&));
    void addMotionSystem(Router& router);
    void addUnits(Router& router);
    void addChanges(Router& router);

    // Questions.
    Reply motionSystem(const Request& request) const;
    Reply changeCount(const Request& request) const;
    Reply list(const Request& request) const;
    Reply unit(const Request& request, const Unit& unit) const;
    Reply jointTarget(const Request& request, const Unit& unit) const;
    Reply robTarget(const Request& request, const Unit& unit) const;
    Reply cartesian(const Request& request, const Unit& unit) const;
    Reply baseFrame(const Request& request, const Unit& unit) const;
    Reply axes(const Request& request, const Unit& unit) const;
    Reply axis(const Request& request, const Unit& unit) const;
    Reply axisPose(const Request& request, const Unit& unit) const;
    /// The axis in the path, from 1; none: the unit does not have it.
    static std::optional<std::size_t> axisOf(const Request& request, const Unit& unit);
    Reply motionSupervision(const Request& request, const Unit& unit) const;
    Reply pathSupervision(const Request& request, const Unit& unit) const;
    Reply leadThrough(const Request& request, const Unit& unit) const;
    Reply taskMotion(const Request& request) const;
    Reply externalJoints(const Unit& unit) const;
    void describeStatic(const Unit& unit, Entry& entry) const;
    void describeDynamic(const Unit& unit, Entry& entry) const;
    /// The pose that the query's tool, wobj and coordinate ask for.
    std::optional<Failure> poseFor(const Request& request, const Unit& unit, motion::RobTarget& target) const;

    // Changes.
    Reply choose(const Request& request, const Unit& unit);
    Reply setMotionSupervision(const Request& request, const Unit& unit);
    Reply setPathSupervision(const Request& request, const Unit& unit);
    Reply setLeadThrough(const Request& request, const Unit& unit);
    Reply teleport(const Request& request, const Unit& unit);
    Reply jog(const Request& request, const Unit& unit);
    std::optional<Reply> readJog(const Request& request, const Unit& unit, rt::JogOrder& order) const;
    void direct(const Unit& unit, const std::string& mode, const std::array<double, 7>& axes,
                rt::JogOrder& order) const;
    Reply setJogUnit(const Request& request);
    Reply setJogTarget(const Request& request);
    Handler onlyOff(const char* why);

    service::VirtualController& controller_;
    service::ManualMotion& manual_;
    const Access& access_;
    std::string jogUnit_; ///< "" = the first robot
    std::optional<motion::RobTarget> jogTarget_;
};

} // namespace rapidc::rws
