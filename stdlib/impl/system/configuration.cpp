#include "stdlib/impl/system/configuration.h"

#include "runtime/base/text_util.h"

#include <fmt/format.h>

#include <numbers>

namespace rt::lib {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

bool isWord(const CfgAttribute& attribute, std::initializer_list<const char*> words) {
    for (const char* word : words)
        if (sameName(attribute.text(), word)) return true;
    return false;
}

void addText(CfgInstance& instance, const char* name, std::string value) {
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

/// Base frame of the robot with that name; that of world when there is none.
robot::Pose baseOf(Controller& controller, std::string_view robot) {
    for (const auto& motion : controller.motions())
        if (sameName(motion->unitName(), robot)) return motion->model().baseFrame;
    return {};
}

/// Axes of the robot with that number, from 1: "rob2_3".
void addArms(const robot::RobotModel& model, int number, CfgSection& arms, CfgSection& calibration) {
    for (std::size_t i = 0; i < 6 && i < model.upperDeg.size() && model.upperDeg[i] != model.lowerDeg[i];
         ++i) {
        CfgInstance arm, motor;
        for (CfgInstance* instance : {&arm, &motor})
            addText(*instance, "name", fmt::format("rob{}_{}", number, i + 1));
        addNumber(arm, "upper_joint_bound", model.upperDeg[i] * kRadians);
        addNumber(arm, "lower_joint_bound", model.lowerDeg[i] * kRadians);
        addNumber(arm, "cal_position", 0);
        addNumber(motor, "cal_offset", 0);
        motor.attributes.push_back({"valid_cal_offset", {}, false, 0});
        arms.instances.push_back(std::move(arm));
        calibration.instances.push_back(std::move(motor));
    }
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
}

/// MOC parameters that the files leave out because they are those of the models.
void Configuration::addRobots(Controller& controller) {
    bool hasRobot = false, hasArms = false, hasCalibration = false;
    for (CfgFile& file : files_) {
        if (file.domain != "MOC") continue;
        hasArms = hasArms || !file.find("ARM").empty();
        hasCalibration = hasCalibration || !file.find("MOTOR_CALIB").empty();
        for (CfgSection& section : file.sections) {
            if (!sameName(section.type, "ROBOT")) continue;
            hasRobot = true;
            for (CfgInstance& instance : section.instances)
                addBaseFrame(instance, baseOf(controller, instance.text("name")));
        }
    }
    CfgSection robots{"ROBOT", {}, {}, 0}, arms{"ARM", {}, {}, 0}, calibration{"MOTOR_CALIB", {}, {}, 0};
    int number = 0;
    for (const auto& motion : controller.motions()) {
        if (motion->unitName().empty()) continue; // external units alone
        CfgInstance instance;
        addText(instance, "name", motion->unitName());
        addText(instance, "use_robot_type", motion->model().name);
        addBaseFrame(instance, motion->model().baseFrame);
        robots.instances.push_back(std::move(instance));
        addArms(motion->model(), ++number, arms, calibration);
    }
    CfgFile file{"robot", "MOC", "CFG_1.0:6:0::", {}};
    if (!hasRobot) file.sections.push_back(std::move(robots));
    if (!hasArms) file.sections.push_back(std::move(arms));
    if (!hasCalibration) file.sections.push_back(std::move(calibration));
    files_.push_back(std::move(file));
}

bool Configuration::Path::read(std::string_view text) {
    std::vector<std::string> parts;
    if (text.empty() || text[0] != '/') return false;
    for (std::size_t begin = 1; begin <= text.size();) {
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
    std::vector<CfgInstance*> found;
    for (CfgFile& file : files_) {
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
    return found;
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
