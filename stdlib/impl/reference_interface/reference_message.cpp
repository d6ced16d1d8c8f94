#include "stdlib/impl/reference_interface/reference_message.h"

#include "runtime/base/text_util.h"
#include "runtime/value/value_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <numbers>
#include <vector>

namespace rt::lib {
namespace {

constexpr std::size_t kLargestMessage = 8192; // bytes

/// A value without parts: a component, or an element of one.
struct Leaf {
    void* data;
    const TypeDesc* type;
};

void addLeaves(void* data, const TypeDesc& type, std::vector<Leaf>& leaves) {
    auto* const bytes = static_cast<char*>(data);
    if (type.kind == DescKind::Record)
        for (uint32_t i = 0; i < type.count; ++i)
            addLeaves(bytes + type.offsets[i], *type.fields[i], leaves);
    else if (type.kind == DescKind::Array)
        for (uint32_t i = 0; i < type.count; ++i)
            addLeaves(bytes + std::size_t{i} * type.fields[0]->size, *type.fields[0], leaves);
    else
        leaves.push_back({data, &type});
}

/// The n-th component of a record; data of other types are a single component.
std::vector<Leaf> component(void* data, const TypeDesc& type, uint32_t n) {
    std::vector<Leaf> leaves;
    if (type.kind != DescKind::Record) {
        if (n == 0) addLeaves(data, type, leaves);
    } else if (n < type.count) {
        addLeaves(static_cast<char*>(data) + type.offsets[n], *type.fields[n], leaves);
    }
    return leaves;
}

std::string textOf(const Leaf& leaf) {
    if (leaf.type->kind == DescKind::String)
        return std::string(static_cast<const String*>(leaf.data)->view());
    return valueToText(leaf.data, *leaf.type);
}

std::string attributes(const char* const* names, const double* values, int count, int decimals) {
    std::string out;
    for (int i = 0; i < count; ++i)
        out += fmt::format(" {}=\"{:.{}f}\"", names[i], values[i], decimals);
    return out;
}

std::string poseElement(const ReferenceField& field, const motion::Pose& pose) {
    static constexpr const char* kPlace[] = {"X", "Y", "Z"};
    static constexpr const char* kQuaternion[] = {"Q1", "Q2", "Q3", "Q4"};
    static constexpr const char* kAngles[] = {"Rx", "Ry", "Rz"};
    const double place[] = {pose.pos.x, pose.pos.y, pose.pos.z};
    std::string out = "<" + field.tag + attributes(kPlace, place, 3, 3);
    if (sameName(field.type, "Frame")) {
        const double rotation[] = {pose.rot.w, pose.rot.x, pose.rot.y, pose.rot.z};
        out += attributes(kQuaternion, rotation, 4, 6);
    } else {
        const robot::Vec3 deg = robot::eulerZyx(pose.rot);
        const double radians = std::numbers::pi / 180;
        const double angles[] = {deg.x * radians, deg.y * radians, deg.z * radians};
        out += attributes(kAngles, angles, 3, 6);
    }
    return out + "/>";
}

std::string jointElement(const ReferenceField& field, const motion::JointTarget& joints) {
    static constexpr const char* kAxes[] = {"J1", "J2", "J3", "J4", "J5", "J6"};
    double angles[6];
    for (std::size_t i = 0; i < 6; ++i)
        angles[i] = joints.robax[i] * std::numbers::pi / 180;
    return "<" + field.tag + attributes(kAxes, angles, 6, 6) + "/>";
}

std::string internElement(const ReferenceField& field, const InternState& state) {
    const auto simple = [&](const std::string& text) {
        return fmt::format("<{0}>{1}</{0}>", field.tag, text);
    };
    if (sameName(field.source, "OperationMode")) return simple(escapedXml(state.operationMode));
    if (sameName(field.source, "FeedbackTime") || sameName(field.source, "PredictedTime"))
        return simple(fmt::format("{:.3f}", state.seconds));
    if (!state.hasArm) return {};
    if (sameName(field.source, "FeedbackPose")) return poseElement(field, state.actualPose);
    if (sameName(field.source, "PlannedPose")) return poseElement(field, state.plannedPose);
    if (sameName(field.source, "FeedbackJoints")) return jointElement(field, state.actualJoints);
    if (sameName(field.source, "PlannedJoints")) return jointElement(field, state.plannedJoints);
    return {};
}

std::string dataElement(const ReferenceField& field, const std::vector<Leaf>& leaves) {
    if (leaves.size() == 1) return fmt::format("<{0}>{1}</{0}>", field.tag, escapedXml(textOf(leaves[0])));
    std::string out = "<" + field.tag;
    for (std::size_t i = 0; i < leaves.size(); ++i)
        out += fmt::format(" X{}=\"{}\"", i + 1, escapedXml(textOf(leaves[i])));
    return out + "/>";
}

/// A value that fits the type of the leaf, as its bytes.
bool convert(const std::string& text, const TypeDesc& type, std::string& bytes) {
    bytes.assign(type.size, '\0');
    if (type.kind == DescKind::String) {
        if (text.size() > kStringCapacity) return false;
        String value;
        value.assign(text);
        std::memcpy(bytes.data(), &value, sizeof value);
        return true;
    }
    return textToValue(type.kind == DescKind::Bool ? upperCase(text) : text, bytes.data(), type);
}

/// Up to the first element; a declaration (<?xml ...?>) that has not come whole stays.
void skipDeclarations(std::string& stream) {
    std::size_t at = 0;
    while ((at = stream.find('<', at)) != std::string::npos && stream.compare(at, 2, "<?") == 0) {
        const std::size_t end = stream.find("?>", at);
        if (end == std::string::npos) break;
        at = end + 2;
    }
    stream.erase(0, std::min(at, stream.size()));
}

/// The texts of an element: its attributes, or its contents.
std::vector<std::string> textsOf(const XmlElement& element) {
    std::vector<std::string> texts;
    for (const auto& [name, value] : element.attributes)
        texts.push_back(value);
    if (texts.empty()) texts.push_back(element.text);
    return texts;
}

} // namespace

std::string composeMessage(const ReferenceProperty& property, uint32_t id, const InternState& state,
                           const void* data, const TypeDesc& type) {
    std::string out = fmt::format("<{} Id=\"{}\" Ts=\"{:.3f}\">", property.tag, id, state.seconds);
    uint32_t next = 0;
    for (const ReferenceField& field : property.fields)
        out += field.isIntern ? internElement(field, state)
                              : dataElement(field, component(const_cast<void*>(data), type, next++));
    return out + fmt::format("</{}>\n", property.tag);
}

std::string takeMessage(const ReferenceProperty& property, const XmlElement& message, void* data,
                        const TypeDesc& type) {
    std::vector<std::pair<Leaf, std::string>> values;
    uint32_t next = 0;
    for (const ReferenceField& field : property.fields) {
        if (field.isIntern) continue;
        const std::vector<Leaf> leaves = component(data, type, next++);
        const XmlElement* element = message.find(field.tag);
        if (element == nullptr) continue; // keeps its value
        const std::vector<std::string> texts = textsOf(*element);
        if (texts.size() > leaves.size())
            return fmt::format("<{}> has {} values, the data have {}", field.tag, texts.size(),
                               leaves.size());
        for (std::size_t i = 0; i < texts.size(); ++i) {
            std::string bytes;
            if (!convert(texts[i], *leaves[i].type, bytes))
                return fmt::format("\"{}\" in <{}> is not a value of type {}", texts[i].substr(0, 20),
                                   field.tag, leaves[i].type->name);
            values.emplace_back(leaves[i], std::move(bytes));
        }
    }
    for (const auto& [leaf, bytes] : values)
        std::memcpy(leaf.data, bytes.data(), bytes.size());
    return {};
}

bool nextMessage(std::string& stream, std::string& message, std::string& problem) {
    skipDeclarations(stream);
    if (stream.empty() || stream.starts_with("<?")) return false;
    const std::size_t nameEnd = stream.find_first_of(" \t\r\n/>", 1);
    const std::string closing =
        nameEnd == std::string::npos ? std::string() : "</" + stream.substr(1, nameEnd - 1) + ">";
    std::size_t end = closing.empty() ? std::string::npos : stream.find(closing);
    if (end != std::string::npos) end += closing.size();
    const std::size_t firstEnd = stream.find('>');
    if (firstEnd != std::string::npos && firstEnd > 0 && stream[firstEnd - 1] == '/') end = firstEnd + 1;
    if (end == std::string::npos || end > kLargestMessage) {
        if (stream.size() <= kLargestMessage) return false;
        problem = fmt::format("a message has more than {} bytes", kLargestMessage);
        stream.clear();
        return false;
    }
    message = stream.substr(0, end);
    stream.erase(0, end);
    return true;
}

} // namespace rt::lib
