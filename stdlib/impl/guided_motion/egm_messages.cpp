#include "stdlib/impl/guided_motion/egm_messages.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

namespace rt::lib {
namespace {

enum WireType : uint32_t { kVarint = 0, kFixed64 = 1, kBytes = 2, kFixed32 = 5 };
enum MessageType : uint64_t { kData = 2, kCorrection = 3, kPathCorrection = 4 };

constexpr double kUnitTolerance = 0.01; // of quaternions that were rounded on their way
constexpr std::size_t kRobotAxes = 6;   // of a message

class Writer {
  public:
    void number(uint32_t field, uint64_t value) {
        varint(field << 3U | kVarint);
        varint(value);
    }
    void real(uint32_t field, double value) {
        varint(field << 3U | kFixed64);
        const auto bits = std::bit_cast<uint64_t>(value);
        for (unsigned i = 0; i < 8; ++i)
            bytes_.push_back(static_cast<char>(bits >> (8 * i) & 0xFFU));
    }
    void message(uint32_t field, const Writer& inner) {
        varint(field << 3U | kBytes);
        varint(inner.bytes_.size());
        bytes_ += inner.bytes_;
    }
    std::string take() { return std::move(bytes_); }

  private:
    void varint(uint64_t value) {
        for (; value >= 0x80; value >>= 7U)
            bytes_.push_back(static_cast<char>(value | 0x80U));
        bytes_.push_back(static_cast<char>(value));
    }
    std::string bytes_;
};

struct Field {
    uint32_t number = 0, type = 0;
    uint64_t value = 0;     ///< Varint, Fixed64 (as bits), Fixed32
    std::string_view bytes; ///< Bytes
    double real() const { return std::bit_cast<double>(value); }
};

/// Field by field; isBroken() afterwards when the bytes are not a message.
class Reader {
  public:
    explicit Reader(std::string_view bytes) : rest_(bytes) {}
    bool next(Field& field) {
        uint64_t tag = 0;
        if (rest_.empty() || broken_ || !varint(tag)) return false;
        field = {static_cast<uint32_t>(tag >> 3U), static_cast<uint32_t>(tag & 7U), 0, {}};
        if (field.number == 0) return fault();
        switch (field.type) {
        case kVarint: return varint(field.value);
        case kFixed64: return fixed(8, field.value);
        case kFixed32: return fixed(4, field.value);
        case kBytes: break;
        default: return fault();
        }
        uint64_t length = 0;
        if (!varint(length) || length > rest_.size()) return fault();
        field.bytes = rest_.substr(0, length);
        rest_.remove_prefix(length);
        return true;
    }
    bool isBroken() const { return broken_; }

  private:
    bool fault() {
        broken_ = true;
        return false;
    }
    bool varint(uint64_t& value) {
        value = 0;
        for (unsigned shift = 0; shift < 64 && !rest_.empty(); shift += 7) {
            const auto byte = static_cast<unsigned char>(rest_.front());
            rest_.remove_prefix(1);
            value |= static_cast<uint64_t>(byte & 0x7FU) << shift;
            if (byte < 0x80U) return true;
        }
        return fault();
    }
    bool fixed(std::size_t size, uint64_t& value) {
        if (rest_.size() < size) return fault();
        value = 0;
        for (std::size_t i = 0; i < size; ++i)
            value |= static_cast<uint64_t>(static_cast<unsigned char>(rest_[i])) << (8 * i);
        rest_.remove_prefix(size);
        return true;
    }
    std::string_view rest_;
    bool broken_ = false;
};

// ---- EgmRobot ----------------------------------------------------------------------------------------------------

Writer header(uint32_t sequence, uint64_t type, int64_t nanoseconds) {
    Writer writer;
    writer.number(1, sequence);
    writer.number(2, static_cast<uint32_t>(nanoseconds / 1'000'000));
    writer.number(3, type);
    return writer;
}

Writer vector(const motion::Vec3& v) {
    Writer writer;
    writer.real(1, v.x);
    writer.real(2, v.y);
    writer.real(3, v.z);
    return writer;
}

Writer quaternion(const motion::Quat& q) {
    Writer writer;
    writer.real(1, q.w);
    writer.real(2, q.x);
    writer.real(3, q.y);
    writer.real(4, q.z);
    return writer;
}

Writer reals(const std::vector<double>& values) {
    Writer writer;
    for (const double value : values)
        writer.real(1, value);
    return writer;
}

/// EgmFeedBack and EgmPlanned, which are alike.
Writer place(const motion::JointTarget& joints, const motion::Pose& pose, const RobotData& data) {
    std::vector<double> robot(kRobotAxes), external;
    for (std::size_t i = 0; i < joints.robax.size(); ++i) {
        if (i < kRobotAxes)
            robot[i] = joints.robax[i];
        else
            external.push_back(joints.robax[i]);
    }
    for (const double axis : joints.extax)
        if (motion::isConnected(axis)) external.push_back(axis);
    Writer cartesian;
    cartesian.message(1, vector(pose.pos));
    cartesian.message(2, quaternion(pose.rot));
    cartesian.message(3, vector(robot::eulerZyx(pose.rot)));
    Writer time;
    time.number(1, static_cast<uint64_t>(data.calendar));
    time.number(2, static_cast<uint64_t>(data.nanoseconds % 1'000'000'000 / 1000));
    Writer writer;
    writer.message(1, reals(robot));
    writer.message(2, cartesian);
    writer.message(3, reals(external));
    writer.message(4, time);
    return writer;
}

/// A message whose only field is this state.
Writer state(uint64_t value) {
    Writer writer;
    writer.number(1, value);
    return writer;
}

// ---- EgmSensor ---------------------------------------------------------------------------------------------------

/// Repeated doubles, one by one or packed.
bool readReals(std::string_view bytes, std::vector<double>& values) {
    Reader reader(bytes);
    Field field;
    while (reader.next(field)) {
        if (field.number != 1) continue;
        if (field.type == kFixed64) values.push_back(field.real());
        if (field.type != kBytes) continue;
        for (; field.bytes.size() >= 8; field.bytes.remove_prefix(8)) {
            double value = 0;
            std::memcpy(&value, field.bytes.data(), sizeof value);
            values.push_back(value);
        }
    }
    return !reader.isBroken();
}

/// x, y, z or u0 to u3: `size` doubles that must all be there.
bool readRecord(std::string_view bytes, std::size_t size, std::array<double, 4>& values) {
    Reader reader(bytes);
    Field field;
    unsigned seen = 0;
    while (reader.next(field)) {
        if (field.type != kFixed64 || field.number > size) continue;
        values[field.number - 1] = field.real();
        seen |= 1U << (field.number - 1);
    }
    return !reader.isBroken() && seen == (1U << size) - 1;
}

bool readPose(std::string_view bytes, SensorData& data) {
    Reader reader(bytes);
    Field field;
    bool hasAngles = false;
    while (reader.next(field)) {
        std::array<double, 4> v{};
        if (field.type != kBytes || field.number > 3) continue;
        if (!readRecord(field.bytes, field.number == 2 ? 4 : 3, v)) return false;
        if (field.number == 2) {
            data.orientation = motion::Quat{v[0], v[1], v[2], v[3]};
            continue;
        }
        hasAngles = hasAngles || field.number == 3;
        for (std::size_t i = 0; i < 3; ++i)
            data.pose[(field.number == 3 ? 3U : 0U) + i] = v[i];
    }
    if (hasAngles) data.orientation.reset(); // of the two, the angles count
    return !reader.isBroken();
}

struct Planned {
    std::vector<double> joints, external;
};

bool readPlanned(std::string_view bytes, Planned& planned, SensorData& data) {
    Reader reader(bytes);
    Field field;
    while (reader.next(field)) {
        if (field.type != kBytes) continue;
        if (field.number == 1 && !readReals(field.bytes, planned.joints)) return false;
        if (field.number == 2 && !readPose(field.bytes, data)) return false;
        if (field.number == 3 && !readReals(field.bytes, planned.external)) return false;
    }
    return !reader.isBroken();
}

bool readSpeed(std::string_view bytes, SensorData& data) {
    Reader reader(bytes);
    Field field;
    while (reader.next(field)) {
        std::vector<double> values;
        if (field.type != kBytes || field.number != 1) continue;
        if (!readReals(field.bytes, values)) return false;
        for (std::size_t i = 0; i < std::min(values.size(), data.jointSpeed.size()); ++i)
            data.jointSpeed[i] = values[i];
    }
    return !reader.isBroken();
}

/// EgmPathCorr: a position and its age, which does not count.
bool readCorrection(std::string_view bytes, SensorData& data) {
    Reader reader(bytes);
    Field field;
    while (reader.next(field)) {
        std::array<double, 4> v{};
        if (field.type != kBytes || field.number != 1) continue;
        if (!readRecord(field.bytes, 3, v)) return false;
        for (std::size_t i = 0; i < 3; ++i)
            data.pose[i] = v[i];
    }
    return !reader.isBroken();
}

uint64_t typeOf(std::string_view headerBytes) {
    Reader reader(headerBytes);
    Field field;
    uint64_t type = 0;
    while (reader.next(field))
        if (field.number == 3 && field.type == kVarint) type = field.value;
    return reader.isBroken() ? 0 : type;
}

bool isFinite(const SensorData& data) {
    const auto finite = [](const std::optional<double>& v) { return !v || std::isfinite(*v); };
    for (const auto& v : data.joints)
        if (!finite(v)) return false;
    for (const auto& v : data.additional)
        if (!finite(v)) return false;
    for (const auto& v : data.pose)
        if (!finite(v)) return false;
    for (const double v : data.jointSpeed)
        if (!std::isfinite(v)) return false;
    return !data.orientation || std::isfinite(norm(*data.orientation));
}

std::string checkContents(const Planned& planned, GuidanceMode expected, SensorData& data) {
    if (expected == GuidanceMode::Joint && planned.joints.size() < kRobotAxes)
        return "a message of joint guidance needs six joints";
    for (std::size_t i = 0; i < std::min(planned.joints.size(), kRobotAxes); ++i)
        data.joints[i] = planned.joints[i];
    if (!planned.external.empty()) data.joints[kRobotAxes] = planned.external.front();
    for (std::size_t i = 0; i < std::min(planned.external.size(), data.additional.size()); ++i)
        data.additional[i] = planned.external[i];
    if (expected == GuidanceMode::PathCorrection && !data.pose[0])
        return "a message of path correction needs a position";
    if (expected == GuidanceMode::Pose && (!data.pose[0] || (!data.orientation && !data.pose[3])))
        return "a message of pose guidance needs a position and an orientation";
    if (!isFinite(data)) return "a message holds a number that is not finite";
    if (data.orientation && std::fabs(norm(*data.orientation) - 1) > kUnitTolerance)
        return "the quaternion of a message does not have the length 1";
    if (data.orientation) data.orientation = robot::normalized(*data.orientation);
    return {};
}

} // namespace

std::string encodeRobotMessage(const RobotData& data, uint32_t sequence) {
    Writer writer;
    writer.message(1, header(sequence, kData, data.nanoseconds));
    writer.message(2, place(data.feedback, data.feedbackPose, data));
    writer.message(3, place(data.planned, data.plannedPose, data));
    writer.message(4, state(data.motorsOn ? 1 : 2));
    writer.message(5, state(data.isGuided ? 3 : 2));
    writer.number(6, data.isConverged ? 1 : 0);
    writer.message(7, reals({0}));
    writer.message(8, state(data.programRuns ? 2 : 1));
    writer.message(9, reals({0, 0, 0, 0, 0, 0}));
    writer.real(10, data.utilization);
    writer.number(11, data.moveIndex);
    writer.message(12, state(0)); // no collision
    writer.message(13, state(0)); // no data from RAPID
    return writer.take();
}

std::string decodeSensorMessage(std::string_view bytes, GuidanceMode expected, SensorData& data) {
    const bool isCorrection = expected == GuidanceMode::PathCorrection;
    Reader reader(bytes);
    Field field;
    Planned planned;
    uint64_t type = 0;
    bool isWhole = true;
    while (isWhole && reader.next(field)) {
        if (field.type != kBytes) continue;
        if (field.number == 1) type = typeOf(field.bytes);
        if (isCorrection && field.number == 2) isWhole = readCorrection(field.bytes, data);
        if (isCorrection) continue;
        if (field.number == 2) isWhole = readPlanned(field.bytes, planned, data);
        if (field.number == 3) isWhole = readSpeed(field.bytes, data);
    }
    if (!isWhole || reader.isBroken()) return "a datagram is not a message of EGM";
    if (type != (isCorrection ? kPathCorrection : kCorrection))
        return isCorrection ? "a message is not of the type PATH_CORRECTION"
                            : "a message is not of the type CORRECTION";
    return checkContents(planned, expected, data);
}

} // namespace rt::lib
