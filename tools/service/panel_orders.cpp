#include "tools/service/panel_orders.h"

#include "config/read_file.h"
#include "frontend/project/program_file.h"
#include "tools/service/virtual_controller.h"

#include <filesystem>
#include <fmt/format.h>
#include <vector>

namespace rapidc::service {

namespace {

namespace fs = std::filesystem;

rt::Task* normalTask(rt::Controller& controller, const std::string& name) {
    if (!name.empty()) return controller.findTask(name);
    for (const auto& task : controller.tasks())
        if (task->kind() == rt::TaskKind::Normal) return task.get();
    return nullptr;
}

} // namespace

std::string PanelOrders::motors(bool on) {
    return controller_.setMotors(on);
}

std::string PanelOrders::resetEmergencyStop() {
    return controller_.confirmEmergencyStop();
}

/// After an order to load a program, of the controller that comes next.
std::string PanelOrders::start(bool once) {
    if (controller_.isBeingReplaced()) {
        controller_.post([this, once] { (void)start(once); });
        return {};
    }
    if (Refusal refusal = controller_.setRunOnce(once); !refusal.empty()) return refusal;
    return controller_.start(ExecutionMode::Continue);
}

std::string PanelOrders::stop(Stop kind) {
    switch (kind) {
    case Stop::Normal: return controller_.stop(StopMode::Stop);
    case Stop::Quick: return controller_.stop(StopMode::Quick);
    case Stop::Cycle: return controller_.stop(StopMode::Cycle);
    case Stop::Instruction: return controller_.stop(StopMode::Instruction);
    }
    return {};
}

std::string PanelOrders::pointersToMain() {
    return controller_.resetPointers();
}

/// The modules that a program file lists lie beside it.
std::string PanelOrders::loadProgram(const std::string& task, const std::string& file) {
    rt::Task* target = normalTask(controller_.core(), task);
    if (target == nullptr) return fmt::format("there is no task {}", task);
    std::string path, text;
    if (!controller_.core().volumes().resolve(file, path) || !rapid::config::readFile(path, text).empty())
        return fmt::format("{} cannot be read", file);
    std::vector<std::string> names, files;
    if (!rapid::project::readProgramFile(text, names)) names = {fs::path(path).filename().string()};
    const std::string folder = file.substr(0, file.find_last_of("/:") + 1);
    for (const std::string& name : names) {
        std::string module;
        std::error_code code;
        if (!controller_.core().volumes().resolve(folder + name, module) ||
            !fs::is_regular_file(module, code))
            return fmt::format("there is no file {} beside {}", name, file);
        files.push_back(module);
    }
    return controller_.loadProgram(*target, files, true);
}

std::string PanelOrders::backup(const std::string& folder) {
    return backup_ ? backup_(folder) : std::string("this controller writes no backups");
}

std::string PanelOrders::restart() {
    return controller_.restart(RestartMode::Warm);
}

} // namespace rapidc::service
