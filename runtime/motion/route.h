#pragma once
// Route: the way from one stop point to the next: moves as legs, rounded corners between them, orientation and external axes
// blended over zones of their own. Places on it are mm of path from its start; on stretches where the TCP hardly moves
// turning counts as well. The geometry does not depend on speed (manual 2.2).

#include "runtime/motion/corner.h"
#include "runtime/motion/move_limits.h"
#include "runtime/motion/path.h"
#include "runtime/motion/queue.h"

#include <functional>
#include <memory>
#include <optional>
#include <span>

namespace motion {

/// One move of a route.
struct Leg {
    std::shared_ptr<const MotionPath> path;
    ZoneData zone; ///< of its end point
    MoveLimits limits;
    MoveLimits programmed;           ///< before the speed limits that a system input puts into force
    double duration = 0;             ///< s, RAPID's \T; 0 = not given
    LengthMap lengths;               ///< mm of path to the path's own parameter
    double perMm = 1;                ///< mm of route for a mm of TCP path
    double perMmLeft = 1;            ///< mm of route that count as a mm left when its stop point is reached
    bool isTurning = false;          ///< the TCP hardly moves; the zone is measured in degrees
    double begin = 0;                ///< place where the part outside corners begins
    double cutStart = 0, cutEnd = 0; ///< mm taken by the corners at both ends
    double pathBegin() const { return begin - cutStart; } ///< place the uncut leg would begin at
    double length() const { return lengths.length(); }
    double end() const { return begin + length() - cutStart - cutEnd; }
};

/// All axes at one place of a route.
struct RoutePoint {
    Joints joints{};
    ExternalAxes extax = kNoExternalAxes;
    bool isSolved = true; ///< false: the inverse failed and the joints are those of a neighbour
};

/// A short stretch of a route with what planning needs to know in its middle.
struct RouteStretch {
    double begin = 0, end = 0;
    std::size_t leg = 0; ///< number of the leg whose limits hold
    RoutePoint middle;
    Joints first{}, second{}; ///< derivatives of the axes by the place, deg/mm, deg/mm^2
    ExternalAxes externalFirst{}, externalSecond{};
    double tcpRate = 1;        ///< mm of TCP path a mm of route
    double turnRate = 0;       ///< degrees of orientation a mm of route
    double armRate = 0;        ///< degrees of the arm angle a mm of route, on lines and circles
    double curvature = 0;      ///< of the TCP path, 1/mm
    double zoneLength = 0;     ///< mm, of the corner it lies in; 0 = outside
    bool isAxesCorner = false; ///< that corner is a curve of the axes
    bool isReversal = false;   ///< the path turns back on itself in that corner
};

class Route {
  public:
    /// `isSmooth`: corners bend at their ends as the legs do, for axes that keep a limit of jerk; else as recordings show.
    explicit Route(bool isSmooth) : isSmooth_(isSmooth) {}
    Route() = default;

    /// Appends a leg that begins where the last one ends, with a corner between the two. `fixedUpTo`: the part of the route
    /// up to there can no longer change. Returns the place from which on the route has changed; nothing when no corner
    /// can be made any more: the route is unchanged then, and its end is a stop point.
    std::optional<double> append(Leg leg, double fixedUpTo);

    /// How many stretches the last append() has left as they were.
    std::size_t keptStretches() const { return keptStretches_; }
    /// Takes back the last append(); its end is a stop point again.
    void undoAppend();

    std::size_t firstLeg() const { return firstLeg_; } ///< the oldest one that is kept
    std::size_t legCount() const { return firstLeg_ + legs_.size(); }
    const Leg& leg(std::size_t number) const { return legs_[number - firstLeg_]; }
    Leg& leg(std::size_t number) { return legs_[number - firstLeg_]; }
    double length() const { return legs_.empty() ? 0 : legs_.back().end(); }
    /// Whether the point at the end of a leg is passed by on a curve.
    bool isRounded(std::size_t number) const;

    /// Places of the programmed points at both ends of a leg: in the middle of a corner's curve.
    double legStart(std::size_t number) const;
    double legEnd(std::size_t number) const;
    /// Place where the largest zone at the end of a leg begins.
    double zoneEntry(std::size_t number) const;
    /// Place where the largest zone ends; the point itself where it is not passed by on a curve.
    double zoneExit(std::size_t number) const;
    /// Place on a leg, mm of TCP path as programmed after its start point. Inside a corner it lies on the curve.
    double placeAfterStart(std::size_t number, double mm) const;
    double placeBeforeEnd(std::size_t number, double mm) const;
    /// Number of the leg whose programmed points enclose the place.
    std::size_t legAt(double place) const;

    /// `near`: the joints at a place close by, if they are known.
    RoutePoint at(double place, const Joints* near = nullptr) const;
    /// The same at several places near each other.
    void at(std::span<const double> places, std::span<RoutePoint> points) const;
    /// The user frame of the leg at a place, where the robot that carries it really is; without this it is where the legs as
    /// programmed bring it.
    void setCarrier(std::function<Pose(double)> carrier) { carrier_ = std::move(carrier); }
    /// TCP in the object frame for a point at that place.
    Pose tcpOf(const FrameSetup& frames, const RoutePoint& point, double place) const;
    /// mm of TCP path for a mm of route, where the curve is one of the TCP; nothing where axes are interpolated.
    std::optional<double> curveRateAt(double place) const;
    const Queue<RouteStretch>& stretches() const { return stretches_; }
    /// Index of the stretch that contains the place.
    std::size_t stretchAt(double place) const;
    /// Forgets stretches and legs that end before this place; how many stretches.
    std::size_t forgetBefore(double place);

  private:
    /// Points on the legs as programmed, without corners; distances in mm of path from the start of the leg.
    static Pose poseOn(const Leg& leg, double distance);
    static Pose poseIn(const Leg& from, const Leg& frames, double distance);
    static AxisVector axesOn(const Leg& leg, double distance);
    static double armAngleOn(const Leg& leg, double distance);

    const Corner& corner(std::size_t number) const { return corners_[number - firstLeg_]; }
    /// The leg on which the place lies, or at the end of which it lies in a corner.
    std::size_t ownLeg(double place) const;
    /// legAt() of a place whose ownLeg() is known.
    std::size_t legBy(std::size_t own, double place) const;
    std::optional<double> curveRate(std::size_t own, bool inCorner) const;
    /// The joints in the middle of the stretch at a place.
    const Joints& jointsNear(double place) const;
    /// `near`: the joints at a place close by; null: those of the stretch there.
    RoutePoint pointAt(double place, const Joints* near) const;
    /// A point whose joints may still be sought.
    struct Sought {
        RoutePoint point;
        /// The TCP there in the frames of the leg, of the later one in a corner, when it is known without the angles.
        std::optional<Pose> tcp;
        bool isTask = false;       ///< its joints are those of the task
        bool isAsMeasured = false; ///< without a solution they are those of the leg's node nearby
    };
    /// The same where ownLeg() is known, up to the inverse, which becomes the task.
    void seekPoint(std::size_t own, double place, const Joints* near, Sought& sought,
                   robot::InverseTask& task) const;
    void seekOnLeg(std::size_t number, double place, const Joints* near, Sought& sought,
                   robot::InverseTask& task) const;
    void seekInCorner(std::size_t number, double place, const Joints* near, Sought& sought,
                      robot::InverseTask& task) const;
    /// Solves the tasks of as many points.
    void find(std::span<Sought> points, std::span<robot::InverseTask> tasks) const;

    void makeCorner(CornerKind kind, double before, double after, double fixedUpTo);
    static void curveInSpace(Corner& corner, const Leg& a, const Leg& b);
    static void curveOfAxes(Corner& corner, const Leg& a, const Leg& b);
    static void measureAxesCurve(Corner& corner, const Leg& a, const Leg& b);
    static void blendTurn(Corner& corner, const Leg& a, const Leg& b, double before, double after);
    static void blendExternal(Corner& corner, const Leg& a, const Leg& b, double before, double after);
    void placeLastCorner();
    void dropLastLeg();
    void restoreStretches();
    bool layStretches(double from);
    void addBends(const Corner& corner, double from, double to, std::vector<double>& places) const;
    void addTurns(const Corner& corner, double from, double distance, double to,
                  std::vector<double>& places) const;
    std::vector<double> bordersFrom(double from) const;
    bool measure(RouteStretch& stretch, std::size_t own, const Joints& seed) const;
    bool joins(const RouteStretch& before, const RouteStretch& after, std::optional<int>& branch) const;
    bool passesSmoothly(const RouteStretch& before, const RouteStretch& after, int branch) const;
    bool isShaped(std::size_t own, double place) const;
    std::optional<Pose> userFrameAt(double place) const;
    Pose flangeFor(const MotionPath& path, const Pose& target, const ExternalAxes& axes, double place) const;

    bool isSmooth_ = false;
    std::function<Pose(double)> carrier_;
    std::size_t firstLeg_ = 0;
    Queue<Leg> legs_;
    Queue<Corner> corners_; // at the end of each leg
    Queue<RouteStretch> stretches_;
    std::size_t keptStretches_ = 0;               // at the last append()
    std::vector<RouteStretch> replacedStretches_; // by it
};

} // namespace motion
