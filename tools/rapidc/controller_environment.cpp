#include "tools/rapidc/controller_environment.h"

#include "runtime/host/conveyors.h"
#include "runtime/io/cfg_parser.h"
#include "runtime/io/io_system.h"
#include "runtime/robot/robot_model.h"
#include "runtime/sched/scheduler.h"
#include "stdlib/native_table.h"
#include "stdlib/stdlib_text.h"

namespace rapidc {

namespace {

using rapid::workspace::ConveyorNames;

class ControllerEnvironment final : public rapid::workspace::Environment {
  public:
    std::vector<rapid::sema::LibraryText> library() const override {
        std::vector<rapid::sema::LibraryText> texts;
        for (const rapid::stdlib::StdlibSource& source : rapid::stdlib::sources())
            texts.push_back({source.name, source.text});
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
