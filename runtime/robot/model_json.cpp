// Reads the JSON data file of one robot model and checks it; the only place that knows its field names.

#include "runtime/robot/robot_model.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <optional>

namespace robot {

namespace {

using Json = nlohmann::json;

constexpr std::string_view kKnownFields[] = {"format",
                                             "name",
                                             "kinematics",
                                             "payload_kg",
                                             "reach_m",
                                             "geometry_mm",
                                             "wrist_offset_mm",
                                             "joint_signs",
                                             "joint_limits_deg",
                                             "max_speed_deg_s",
                                             "provisional",
                                             "joint_offsets_deg",
                                             "base_frame",
                                             "external_axes",
                                             "max_acceleration_deg_s2",
                                             "max_jerk_deg_s3",
                                             "dynamics",
                                             "sources",
                                             "max_tcp_speed_mm_s",
                                             "note",
                                             "axis_numbers",
                                             "flange_rot",
                                             "arm_angle_reference",
                                             "elbow_limits_deg",
                                             "home_deg"};

/// Walks through the fields of one object and remembers the first thing wrong.
class Reader {
  public:
    Reader(const Json& root, std::string_view origin) : root_(root), origin_(origin) {}

    bool failed() const { return !problem_.empty(); }
    ModelError error() const { return {fmt::format("robot model {}: {}", origin_, problem_)}; }
    void fail(std::string text) {
        if (problem_.empty()) problem_ = std::move(text);
    }

    const Json* find(const Json& object, std::string_view field, bool required) {
        const auto found = object.find(field);
        if (found != object.end()) return &*found;
        if (required) fail(fmt::format("field '{}' is missing; add it", field));
        return nullptr;
    }

    std::string text(std::string_view field) {
        const Json* value = find(root_, field, true);
        if (value == nullptr) return {};
        if (!value->is_string() || value->get_ref<const std::string&>().empty()) {
            fail(fmt::format("field '{}' must be a text that is not empty", field));
            return {};
        }
        return value->get<std::string>();
    }

    double number(const Json& object, std::string_view field, std::optional<double> fallback = {}) {
        const Json* value = find(object, field, !fallback);
        return value == nullptr ? fallback.value_or(0) : toNumber(*value, field);
    }

    /// Array of `count` numbers into `out`.
    void numbers(const Json& object, std::string_view field, double* out, std::size_t count,
                 bool required = true) {
        const Json* value = find(object, field, required);
        if (value == nullptr) return;
        if (!value->is_array() || value->size() != count) {
            fail(fmt::format("field '{}' must be an array of {} numbers", field, count));
            return;
        }
        for (std::size_t i = 0; i < count; ++i)
            out[i] = toNumber((*value)[i], field);
    }

    void positive(std::string_view field, const Joints& values) {
        for (double value : values) {
            if (!(value > 0))
                fail(fmt::format("field '{}' must hold positive numbers only, found {}", field, value));
        }
    }

    double toNumber(const Json& value, std::string_view field) {
        if (!value.is_number() || !std::isfinite(value.get<double>())) {
            fail(fmt::format("field '{}' must hold finite numbers, found {}", field, value.dump()));
            return 0;
        }
        return value.get<double>();
    }

    const Json& root() const { return root_; }

  private:
    const Json& root_;
    std::string_view origin_;
    std::string problem_;
};

struct KindName {
    std::string_view name;
    KinematicsKind kind;
    std::size_t axes;
};
constexpr KindName kKinds[] = {{"spherical-wrist", KinematicsKind::SphericalWrist, 6},
                               {"offset-wrist", KinematicsKind::OffsetWrist, 6},
                               {"seven-axes", KinematicsKind::SevenAxes, 7},
                               {"parallel-rods", KinematicsKind::ParallelRods, 4},
                               {"scara", KinematicsKind::Scara, 4},
                               {"delta", KinematicsKind::Delta, 4}};

/// Sets the number of axes, too: everything per axis is read after this.
void readKinematicsKind(Reader& in, RobotModel& model) {
    const std::string name = in.text("kinematics");
    const KindName* found = nullptr;
    std::string known;
    for (const KindName& kind : kKinds) {
        if (kind.name == name) found = &kind;
        known += fmt::format("{}\"{}\"", known.empty() ? "" : ", ", kind.name);
    }
    if (found == nullptr) return in.fail(fmt::format("field 'kinematics' must be one of {}", known));
    model.kinematics = found->kind;
    const Joints zeros = Joints::zeros(found->axes);
    model.lowerDeg = model.upperDeg = model.maxSpeed = model.maxAcceleration = model.maxJerk = zeros;
    model.geometry.offsetsDeg = model.geometry.signs = zeros;
    model.geometry.signs.fill(1);
    model.wristOffset = in.number(in.root(), "wrist_offset_mm", 0.0);
    if ((model.wristOffset != 0) != (model.kinematics == KinematicsKind::OffsetWrist)) {
        in.fail("field 'wrist_offset_mm' belongs to \"offset-wrist\" and only there");
    }
}

void readOpw(Reader& in, const Json& geometry, OpwParameters& g) {
    g.a1 = in.number(geometry, "a1");
    g.a2 = in.number(geometry, "a2");
    g.b = in.number(geometry, "b", 0.0);
    g.c1 = in.number(geometry, "c1");
    g.c2 = in.number(geometry, "c2");
    g.c3 = in.number(geometry, "c3");
    g.c4 = in.number(geometry, "c4");
    if (in.failed()) return;
    if (!(g.c2 > 0) || !(std::hypot(g.a2, g.c3) > 0)) in.fail("the links c2 and (a2, c3) must have a length");
}

void readSevenAxes(Reader& in, const Json& geometry, SevenAxisGeometry& g) {
    g.base = in.number(geometry, "base");
    g.shoulder = in.number(geometry, "shoulder");
    g.upperArm = in.number(geometry, "upper_arm");
    g.elbowOut = in.number(geometry, "elbow_out");
    g.elbowUp = in.number(geometry, "elbow_up");
    g.forearm = in.number(geometry, "forearm");
    g.wrist = in.number(geometry, "wrist");
    g.flange = in.number(geometry, "flange");
    double reference[3] = {0, 0, 1};
    in.numbers(in.root(), "arm_angle_reference", reference, 3, false);
    g.armAngleReference = {reference[0], reference[1], reference[2]};
    if (in.failed()) return;
    if (!(g.upperArm > 0) || !(g.forearm > 0)) in.fail("the links upper_arm and forearm must have a length");
    if (std::abs(norm(g.armAngleReference) - 1) > 1e-6)
        in.fail("field 'arm_angle_reference' must be a vector of length 1");
}

void readFourAxes(Reader& in, const Json& geometry, RobotModel& model) {
    if (model.kinematics == KinematicsKind::ParallelRods) {
        ParallelRodGeometry& g = model.parallelRods;
        g.a1 = in.number(geometry, "a1");
        g.c1 = in.number(geometry, "c1");
        g.c2 = in.number(geometry, "c2");
        g.c3 = in.number(geometry, "c3");
        g.out = in.number(geometry, "out");
        g.down = in.number(geometry, "down");
        if (!in.failed() && !(g.c2 > 0 && g.c3 > 0)) in.fail("the links c2 and c3 must have a length");
        double elbow[2] = {g.leastElbowDeg, g.mostElbowDeg};
        in.numbers(in.root(), "elbow_limits_deg", elbow, 2, false);
        if (!(elbow[0] < elbow[1]))
            in.fail("field 'elbow_limits_deg' must hold [lower, upper] with lower < upper");
        g.leastElbowDeg = elbow[0];
        g.mostElbowDeg = elbow[1];
    } else if (model.kinematics == KinematicsKind::Scara) {
        ScaraGeometry& g = model.scara;
        g.height = in.number(geometry, "height");
        g.upperArm = in.number(geometry, "upper_arm");
        g.forearm = in.number(geometry, "forearm");
        if (!in.failed() && !(g.upperArm > 0 && g.forearm > 0))
            in.fail("the links upper_arm and forearm must have a length");
    } else {
        DeltaGeometry& g = model.delta;
        g.baseRadius = in.number(geometry, "base_radius");
        g.upperArm = in.number(geometry, "upper_arm");
        g.rod = in.number(geometry, "rod");
        g.platformRadius = in.number(geometry, "platform_radius");
        g.flangeDown = in.number(geometry, "flange_down");
        if (!in.failed() && !(g.upperArm > 0 && g.rod > 0))
            in.fail("the links upper_arm and rod must have a length");
    }
    double rot[4] = {0, 0, 1, 0};
    in.numbers(in.root(), "flange_rot", rot, 4, false);
    const Quat q = normalized({rot[0], rot[1], rot[2], rot[3]});
    if (!in.failed() && std::hypot(q.w, q.z) > 1e-6)
        in.fail("field 'flange_rot' must be a quaternion [w, x, y, z] whose z axis points down");
    model.flangeRot = q;
}

void readGeometry(Reader& in, RobotModel& model) {
    const Json* geometry = in.find(in.root(), "geometry_mm", true);
    if (geometry == nullptr || in.failed()) return;
    if (!geometry->is_object()) return in.fail("field 'geometry_mm' must be an object with the lengths");
    const bool isOpw =
        model.kinematics == KinematicsKind::SphericalWrist || model.kinematics == KinematicsKind::OffsetWrist;
    if (isOpw)
        readOpw(in, *geometry, model.geometry);
    else if (model.kinematics == KinematicsKind::SevenAxes)
        readSevenAxes(in, *geometry, model.sevenAxes);
    else
        readFourAxes(in, *geometry, model);
    Joints& signs = model.geometry.signs;
    in.numbers(in.root(), "joint_offsets_deg", model.geometry.offsetsDeg.begin(), signs.size(), isOpw);
    in.numbers(in.root(), "joint_signs", signs.begin(), signs.size(), isOpw);
    for (double sign : signs) {
        if (sign != 1 && sign != -1) in.fail("field 'joint_signs' may hold 1 and -1 only");
    }
}

void readAxisNumbers(Reader& in, RobotModel& model) {
    double numbers[kMostJoints] = {1, 2, 3, 4, 5, 6, 7};
    const std::size_t count = model.lowerDeg.size();
    in.numbers(in.root(), "axis_numbers", numbers, count, false);
    for (std::size_t i = 0; i < count; ++i) {
        const bool isGood = numbers[i] == std::floor(numbers[i]) && numbers[i] <= 7 &&
                            numbers[i] > (i == 0 ? 0 : numbers[i - 1]);
        if (!isGood) return in.fail("field 'axis_numbers' must hold rising whole numbers from 1 to 7");
        model.axisNumbers[i] = static_cast<int>(numbers[i]);
    }
}

void readLimits(Reader& in, RobotModel& model) {
    const Json* limits = in.find(in.root(), "joint_limits_deg", true);
    if (limits == nullptr) return;
    const std::size_t count = model.lowerDeg.size();
    bool isGood = limits->is_array() && limits->size() == count;
    for (std::size_t i = 0; isGood && i < count; ++i) {
        const Json& pair = (*limits)[i];
        isGood = pair.is_array() && pair.size() == 2;
        if (!isGood) break;
        model.lowerDeg[i] = in.toNumber(pair[0], "joint_limits_deg");
        model.upperDeg[i] = in.toNumber(pair[1], "joint_limits_deg");
        isGood = in.failed() || model.lowerDeg[i] < model.upperDeg[i];
    }
    if (!isGood)
        in.fail(fmt::format(
            "field 'joint_limits_deg' must be an array of {} pairs [lower, upper] with lower < upper",
            count));
}

void readHome(Reader& in, RobotModel& model) {
    if (in.find(in.root(), "home_deg", false) == nullptr) return;
    model.home = Joints::zeros(model.lowerDeg.size());
    in.numbers(in.root(), "home_deg", model.home.begin(), model.home.size());
    for (std::size_t i = 0; i < model.home.size(); ++i) {
        if (!(model.home[i] >= model.lowerDeg[i] && model.home[i] <= model.upperDeg[i]))
            return in.fail("field 'home_deg' must lie within joint_limits_deg");
    }
}

void readBaseFrame(Reader& in, RobotModel& model) {
    const Json* frame = in.find(in.root(), "base_frame", false);
    if (frame == nullptr) return;
    if (!frame->is_object()) return in.fail("field 'base_frame' must be an object with pos_mm and rot");
    double pos[3] = {};
    double rot[4] = {};
    in.numbers(*frame, "pos_mm", pos, 3);
    in.numbers(*frame, "rot", rot, 4);
    if (in.failed()) return;
    const Quat q{rot[0], rot[1], rot[2], rot[3]};
    if (std::abs(norm(q) - 1) > 1e-3) return in.fail("field 'rot' must be a unit quaternion [w, x, y, z]");
    model.baseFrame = {{pos[0], pos[1], pos[2]}, normalized(q)};
}

void readDynamics(Reader& in, RobotModel& model) {
    const Json* given = in.find(in.root(), "dynamics", false);
    if (given == nullptr) {
        model.dynamics = estimatedDynamics(model);
        return;
    }
    if (!given->is_object())
        return in.fail("field 'dynamics' must be an object with acceleration_rad_s2 and smoothing_s");
    double windows[2] = {};
    in.numbers(*given, "smoothing_s", windows, 2);
    if (!(windows[0] > 0 && windows[1] > 0)) in.fail("field 'smoothing_s' must hold two positive times");
    model.dynamics.longWindow = windows[0];
    model.dynamics.shortWindow = windows[1];
    model.dynamics.load = in.number(*given, "load_kg", 0.0);
    if (!(model.dynamics.load >= 0)) in.fail("field 'load_kg' must not be negative");
    in.numbers(*given, "motor_deflection_mrad", model.dynamics.motorDeflection.data(), model.maxSpeed.size(),
               false);
    const Json* axes = in.find(*given, "acceleration_rad_s2", true);
    if (axes == nullptr) return;
    if (!axes->is_array() || axes->size() != model.maxSpeed.size())
        return in.fail("field 'acceleration_rad_s2' must be an array with an object for each axis");
    for (std::size_t i = 0; i < axes->size(); ++i) {
        const Json& axis = (*axes)[i];
        if (!axis.is_object()) return in.fail("field 'acceleration_rad_s2' must be an array of objects");
        AccelerationLimit& limit = model.dynamics.axes[i];
        limit.scale = in.number(axis, "scale", 1.0);
        limit.cap = in.number(axis, "most", 1e9);
        limit.base = in.number(axis, "base", 0.0);
        limit.elbow = in.number(axis, "elbow", 0.0);
        limit.wrist = in.number(axis, "wrist", 0.0);
        limit.reach = in.number(axis, "reach", 0.0);
        const bool isPositive = limit.scale > 0 && limit.cap > 0 && limit.base >= 0 && limit.elbow >= 0 &&
                                limit.wrist >= 0 && limit.reach >= 0;
        if (!isPositive) in.fail("field 'acceleration_rad_s2' must hold figures that are not negative");
    }
}

void readProvisional(Reader& in, RobotModel& model) {
    const Json* list = in.find(in.root(), "provisional", false);
    if (list == nullptr) return;
    if (!list->is_array()) return in.fail("field 'provisional' must be an array of field names");
    for (const Json& entry : *list) {
        if (!entry.is_string() || !in.root().contains(entry.get_ref<const std::string&>())) {
            return in.fail(
                fmt::format("field 'provisional' names {}, which is not a field of this file", entry.dump()));
        }
        model.provisional.push_back(entry.get<std::string>());
    }
}

void checkFieldNames(Reader& in) {
    for (const auto& item : in.root().items()) {
        bool isKnown = false;
        for (std::string_view known : kKnownFields)
            isKnown = isKnown || known == item.key();
        if (!isKnown) in.fail(fmt::format("field '{}' is not known; correct or remove it", item.key()));
    }
}

} // namespace

Expected<RobotModel, ModelError> parseRobotModel(std::string_view jsonText, std::string_view origin) {
    Json root;
    try {
        root = Json::parse(jsonText.begin(), jsonText.end());
    } catch (const Json::exception& problem) {
        return Unexpected{ModelError{fmt::format("robot model {}: not JSON: {}", origin, problem.what())}};
    }
    Reader in(root, origin);
    if (!root.is_object()) in.fail("the file must hold one object");
    if (in.failed()) return Unexpected{in.error()};

    RobotModel model;
    checkFieldNames(in);
    if (in.number(root, "format") != 1) in.fail("field 'format' must be 1");
    model.name = in.text("name");
    model.payloadKg = in.number(root, "payload_kg");
    model.reachM = in.number(root, "reach_m");
    readKinematicsKind(in, model);
    readGeometry(in, model);
    readAxisNumbers(in, model);
    readLimits(in, model);
    in.numbers(root, "max_speed_deg_s", model.maxSpeed.begin(), model.maxSpeed.size());
    in.numbers(root, "max_acceleration_deg_s2", model.maxAcceleration.begin(), model.maxAcceleration.size());
    in.numbers(root, "max_jerk_deg_s3", model.maxJerk.begin(), model.maxJerk.size());
    in.positive("max_speed_deg_s", model.maxSpeed);
    in.positive("max_acceleration_deg_s2", model.maxAcceleration);
    in.positive("max_jerk_deg_s3", model.maxJerk);
    model.maxTcpSpeed = in.number(root, "max_tcp_speed_mm_s", 5000.0);
    if (!(model.maxTcpSpeed > 0)) in.fail("field 'max_tcp_speed_mm_s' must be positive");
    const double external = in.number(root, "external_axes", 0.0);
    if (external < 0 || external > 6 || external != std::floor(external)) {
        in.fail("field 'external_axes' must be 0 to 6");
    }
    model.externalAxes = static_cast<int>(external);
    if (!in.failed()) readDynamics(in, model);
    if (!in.failed()) readHome(in, model);
    readBaseFrame(in, model);
    readProvisional(in, model);
    if (in.failed()) return Unexpected{in.error()};
    return model;
}

} // namespace robot
