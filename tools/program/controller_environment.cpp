#include "tools/program/controller_environment.h"

#include "runtime/host/conveyors.h"
#include "runtime/io/cfg_parser.h"
#include "runtime/io/io_system.h"
#include "runtime/robot/kinematics.h"
#include "runtime/robot/robot_model.h"
#include "runtime/sched/scheduler.h"
#include "stdlib/native_table.h"
#include "stdlib/stdlib_text.h"

#include <fmt/format.h>

namespace rapidc {

namespace {

using rapid::workspace::ConveyorNames;

class ControllerEnvironment final : public rapid::workspace::Environment {
  public:
    std::vector<rapid::sema::LibraryText> library(bool documented) const override {
        std::vector<rapid::sema::LibraryText> texts;
        for (const rapid::stdlib::StdlibSource& source : rapid::stdlib::sources())
            texts.push_back({source.name, documented ? source.text : source.declarations});
        return texts;
    }

    std::vector<std::string_view> declaredOnly() const override {
        std::vector<std::string_view> names;
        for (const rt::NativeEntry& entry : rt::nativeTable())
            if (!entry.isImplemented()) names.emplace_back(entry.name);
        return names;
    }

    std::string robotProblem(const std::string& model) const override {
        const auto loaded = robot::loadRobotModel(model);
        return loaded ? std::string() : loaded.error().message;
    }

    std::string reach(const std::string& model,
                      const rapid::workspace::TargetNumbers& target) const override {
        const auto loaded = robot::loadRobotModel(model);
        if (!loaded) return {};
        const robot::Kinematics arm(*loaded);
        const auto& p = target.position;
        const auto& r = target.rotation;
        const auto& c = target.configuration;
        const bool armAngle = arm.hasArmAngle() && target.eaxA < 9e8;
        const auto joints = arm.inverse({{p[0], p[1], p[2]}, {r[0], r[1], r[2], r[3]}},
                                        {c[0], c[1], c[2], c[3]}, robot::Joints::zeros(arm.jointCount()),
                                        armAngle ? target.eaxA : robot::kSeedArmAngle);
        if (!joints) return fmt::format("{} (tool0, wobj0): {}", loaded->name, joints.error().message());
        std::string text = fmt::format("{} (tool0, wobj0) reaches it with", loaded->name);
        for (size_t i = 0; i < arm.jointCount(); ++i)
            text += fmt::format("{} axis {} at {:.1f}", i == 0 ? "" : ",", arm.axisNumber(i), (*joints)[i]);
        return text;
    }

    void judgeSignals(std::vector<rapid::config::CfgProblem>& problems, const std::vector<std::string>& names,
                      const std::vector<std::string>& texts) const override {
        rt::Scheduler scheduler{rt::SchedulerOptions{}};
        rt::IoSystem io(scheduler);
        std::vector<rapid::config::CfgProblem> known;
        for (size_t i = 0; i < texts.size(); ++i)
            io.configure(rt::parseCfg(texts[i], names[i], known), problems);
        io.finishConfiguration(problems);
    }

    bool isConveyor(std::string_view unit) const override { return rt::isConveyorName(unit); }

    ConveyorNames conveyor(const std::string& text) const override {
        rt::ConveyorSettings settings;
        ConveyorNames names;
        names.problem = rt::readConveyorOption(text, settings);
        if (!names.problem.empty()) return names;
        names.unit = settings.name;
        for (const auto& [name, type] : rt::conveyorSignals(settings))
            names.signals.push_back({name, type});
        return names;
    }
};

} // namespace

const rapid::workspace::Environment& controllerEnvironment() {
    static const ControllerEnvironment environment;
    return environment;
}

} // namespace rapidc
