#include "stdlib/impl/system/configuration.h"

#include "runtime/base/text_util.h"
#include "runtime/robot/angles.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

namespace rt::lib {
namespace {

bool isWord(const CfgAttribute& attribute, std::initializer_list<const char*> words) {
    for (const char* word : words)
        if (sameName(attribute.text(), word)) return true;
    return false;
}

void addText(CfgInstance& instance, const std::string& name, std::string value) {
    instance.attributes.push_back({name, {std::move(value)}, true, 0});
}
void addNumber(CfgInstance& instance, const std::string& name, double value) {
    instance.attributes.push_back({name, {shortestNumber(value)}, false, 0});
}

void addBaseFrame(CfgInstance& instance, const robot::Pose& base) {
    const double position[] = {base.pos.x, base.pos.y, base.pos.z};
    const double rotation[] = {base.rot.w, base.rot.x, base.rot.y, base.rot.z};
    for (int i = 0; i < 3; ++i) {
        const std::string name = fmt::format("base_frame_pos_{}", "xyz"[i]);
        if (instance.find(name) == nullptr) addNumber(instance, name, position[i] / 1000);
    }
    for (int i = 0; i < 4; ++i) {
        const std::string name = fmt::format("base_frame_orient_u{}", i);
        if (instance.find(name) == nullptr) addNumber(instance, name, rotation[i]);
    }
}

/// Axes of a robot: rax_1 to rax_6, and the seventh of arms that have it. Those that cannot move are not axes.
constexpr std::size_t kRobotAxes = 7;

bool hasAxis(const robot::RobotModel& model, std::size_t axis) {
    return axis < model.upperDeg.size() && model.upperDeg[axis] != model.lowerDeg[axis];
}

void ensureText(CfgInstance& instance, const std::string& name, const std::string& value) {
    if (instance.find(name) == nullptr) addText(instance, name, value);
}

/// Those of the files that the path names, in order.
void collect(std::vector<CfgFile>& files, const Configuration::Path& path, std::vector<CfgInstance*>& found) {
    for (CfgFile& file : files) {
        if (!sameName(file.domain, path.domain)) continue;
        for (CfgSection& section : file.sections) {
            if (!sameName(section.type, path.type) && !sameName(section.baseType, path.type)) continue;
            for (CfgInstance& instance : section.instances) {
                const CfgAttribute* attribute = instance.find(path.attribute);
                if (attribute != nullptr && sameName(attribute->text(), path.value))
                    found.push_back(&instance);
            }
        }
    }
}

void ensureNumber(CfgInstance& instance, const std::string& name, double value) {
    if (instance.find(name) == nullptr) addNumber(instance, name, value);
}

void writeInstance(std::string& out, const CfgInstance& instance) {
    constexpr std::size_t kColumns = 78;
    std::string line = "     ";
    for (const CfgAttribute& attribute : instance.attributes) {
        std::string text = " -" + attribute.name;
        for (std::size_t i = 0; i < attribute.values.size(); ++i) {
            text += i == 0 ? " " : ",";
            text += attribute.quoted ? '"' + attribute.values[i] + '"' : attribute.values[i];
        }
        if (line.size() > 6 && line.size() + text.size() > kColumns) {
            out += line + "\\\n";
            line = "     ";
        }
        line += text;
    }
    out += line + "\n";
}

} // namespace

CfgKind kindOf(const CfgAttribute& attribute) {
    double number = 0;
    if (attribute.quoted || attribute.values.size() > 1) return CfgKind::Text;
    if (attribute.values.empty() || isWord(attribute, {"TRUE", "FALSE", "YES", "NO"})) return CfgKind::Bool;
    return parseNumber(attribute.text(), number) ? CfgKind::Number : CfgKind::Text;
}

bool isTrue(const CfgAttribute& attribute) {
    return attribute.values.empty() || isWord(attribute, {"TRUE", "YES"});
}

Configuration& Configuration::of(Controller& controller) {
    auto& configuration = controller.service<Configuration>();
    if (!configuration.loaded_) configuration.load(controller);
    return configuration;
}

void Configuration::load(Controller& controller) {
    loaded_ = true;
    files_ = controller.configuration();
    addRobots(controller);
    addImplied(controller);
}

void Configuration::addImplied(const Controller& controller) {
    for (const char* domain : {"EIO", "SYS", "MOC"}) {
        CfgFile& file = implied_.emplace_back(CfgFile{"controller", domain, "CFG_1.0:6:0::", {}});
        for (const std::string& type : cfgTypesOf(domain)) {
            std::vector<CfgInstance> instances = impliedInstances(controller, domain, type);
            if (!instances.empty()) file.sections.push_back({type, {}, std::move(instances), 0});
        }
    }
}

/// The instance of topic Motion with that type and name: that of the files, else a new one.
CfgInstance& Configuration::motionInstance(const std::string& type, const std::string& name) {
    for (CfgInstance* found : find({"MOC", type, "Name", name}))
        return *found;
    std::vector<CfgSection>& sections = files_.back().sections;
    auto section = std::find_if(sections.begin(), sections.end(),
                                [&](const CfgSection& other) { return other.type == type; });
    if (section == sections.end()) section = sections.insert(section, {type, {}, {}, 0});
    addText(section->instances.emplace_back(), "name", name);
    return section->instances.back();
}

/// The axis with that name and place in the model.
void Configuration::addAxis(const robot::RobotModel& model, std::size_t axis, const std::string& name) {
    CfgInstance& arm = motionInstance("ARM", name);
    ensureNumber(arm, "upper_joint_bound", model.upperDeg[axis] * robot::kDeg);
    ensureNumber(arm, "lower_joint_bound", model.lowerDeg[axis] * robot::kDeg);
    ensureNumber(arm, "cal_position", 0);
    CfgInstance& motor = motionInstance("MOTOR_CALIB", name);
    ensureNumber(motor, "cal_offset", 0);
    if (motor.find("valid_cal_offset") == nullptr)
        motor.attributes.push_back({"valid_cal_offset", {}, false, 0});
}

/// MOC parameters that the files leave out because they are those of the models: robots, their axes ("rob2_3" unless the files
/// give names) and base frames.
void Configuration::addRobots(Controller& controller) {
    files_.push_back({"robot", "MOC", "CFG_1.0:6:0::", {}});
    int number = 0;
    for (const auto& motion : controller.motions()) {
        const std::string& unit = motion->unitName();
        if (unit.empty()) continue; // external units alone
        const robot::RobotModel& model = motion->model();
        ++number;
        for (std::size_t axis = 0; axis < kRobotAxes; ++axis) {
            if (!hasAxis(model, axis)) continue;
            // The seventh axis of an arm is a single unit of its own.
            const bool isSingle = axis + 1 == kRobotAxes;
            CfgInstance& owner = isSingle ? motionInstance("SINGLE", fmt::format("{}_{}", unit, kRobotAxes))
                                          : motionInstance("ROBOT", unit);
            const std::string attribute = isSingle ? "use_joint" : fmt::format("use_joint_{}", axis);
            if (!isSingle)
                ensureText(owner, "use_robot_type",
                           robotTypeName(model.name, static_cast<std::size_t>(number - 1)));
            ensureText(owner, attribute, robotAxisName(unit, static_cast<std::size_t>(number - 1), axis + 1));
            addAxis(model, axis, owner.text(attribute));
        }
        addBaseFrame(motionInstance("ROBOT", unit), model.baseFrame);
    }
}

bool Configuration::Path::read(std::string_view text) {
    std::vector<std::string> parts;
    if (text.starts_with('/')) text.remove_prefix(1); // programs that run on controllers leave it out
    for (std::size_t begin = 0; begin <= text.size();) {
        // The value of an attribute may contain slashes.
        const std::size_t end =
            parts.size() == 3 ? text.size() : std::min(text.find('/', begin), text.size());
        parts.emplace_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    if (parts.size() < 3 || parts.size() > 4) return false;
    domain = parts[0];
    type = parts[1];
    attribute = parts.size() == 4 ? parts[2] : "Name";
    value = parts.back();
    return true;
}

std::vector<CfgInstance*> Configuration::find(const Path& path) {
    std::vector<CfgInstance*> found, implied;
    collect(files_, path, found);
    collect(implied_, path, implied);
    for (CfgInstance* instance : implied) {
        std::vector<CfgInstance*> same;
        collect(files_, {path.domain, path.type, "Name", instance->text("Name")}, same);
        if (same.empty()) found.push_back(instance);
    }
    return found;
}

const CfgAttribute* Configuration::attribute(const Path& path, const CfgInstance& instance,
                                             std::string_view name) {
    if (const CfgAttribute* found = instance.find(name)) return found;
    const std::string own = instance.text("Name");
    if (own.empty()) return nullptr;
    std::vector<CfgInstance*> implied;
    collect(implied_, {path.domain, path.type, "Name", own}, implied);
    return implied.empty() ? nullptr : implied.front()->find(name);
}

CfgInstance& Configuration::kept(CfgInstance& instance) {
    changed_ = true;
    for (CfgFile& file : implied_) {
        for (CfgSection& section : file.sections) {
            std::vector<CfgInstance>& all = section.instances;
            const auto own = std::find_if(all.begin(), all.end(),
                                          [&](const CfgInstance& each) { return &each == &instance; });
            if (own == all.end()) continue;
            CfgFile& kept = files_.emplace_back(CfgFile{file.name, file.domain, file.version, {}});
            kept.sections.push_back({section.type, {}, {*own}, 0});
            return kept.sections.back().instances.back();
        }
    }
    return instance;
}

const CfgAttribute* Configuration::anyOf(const Path& path, std::string_view attribute) const {
    for (const CfgFile& file : files_) {
        if (!sameName(file.domain, path.domain)) continue;
        for (const CfgSection* section : file.find(path.type))
            for (const CfgInstance& instance : section->instances)
                if (const CfgAttribute* found = instance.find(attribute)) return found;
    }
    return nullptr;
}

std::string Configuration::text(std::string_view domain) const {
    std::string out;
    for (const CfgFile& file : files_) {
        if (!sameName(file.domain, domain)) continue;
        if (out.empty()) out = file.domain + ":" + file.version + "\n";
        for (const CfgSection& section : file.sections) {
            out += "#\n" + section.type + (section.baseType.empty() ? "" : "=" + section.baseType) + ":\n";
            for (const CfgInstance& instance : section.instances) {
                out += "\n";
                writeInstance(out, instance);
            }
        }
    }
    return out;
}

} // namespace rt::lib
