#include "frontend/project/configured_folder.h"

#include "config/text_util.h"
#include "frontend/diag/messages/projects.h"
#include "frontend/project/system_parameters.h"

#include <fmt/format.h>

#include <algorithm>

namespace rapid::project {

namespace fs = std::filesystem;
using config::sameName;
namespace say = diag::say;

namespace {

/// "HOME:/lib/x.sys" -> "lib/x.sys"
std::string_view withoutVolume(std::string_view file) {
    const size_t colon = file.find(':');
    return colon == std::string_view::npos ? file : file.substr(colon + 1);
}

class FolderLoader {
  public:
    FolderLoader(const fs::path& folder, const std::set<std::string>& elsewhere, FileReader& files,
                 diag::Sink& sink, ProjectInput& out)
        : folder_(folder), elsewhere_(elsewhere), files_(files), sink_(sink), out_(out) {}

    bool load() {
        if (!readParameters()) return false;
        makeTasks();
        if (tasks_.empty()) return false;
        for (const ConfiguredModule& module : parameters_.modules)
            addConfigured(module);
        for (Task& task : tasks_)
            addOwnFolder(task);
        addOthers();
        handOver();
        return true;
    }

  private:
    struct Task {
        sema::TaskInput input;
        bool motion = false;
        bool elsewhere = false; ///< its modules come from the command line
        bool own = false;       ///< it has a module that is not for all tasks
    };

    bool readParameters() {
        fs::path file = findEntry(folder_, "SYS.cfg");
        if (file.empty()) file = findEntry(findEntry(folder_, "SYSPAR"), "SYS.cfg");
        std::string bytes;
        if (file.empty() || isFolder(file) || !files_.read(file, bytes)) return false;
        sysFile_ = std::make_shared<const SourceFile>(file.string(), std::move(bytes));
        parameters_ = readTaskParameters(sysFile_->text());
        return !parameters_.tasks.empty() || !parameters_.modules.empty();
    }

    void makeTasks() {
        for (const ConfiguredTask& configured : parameters_.tasks) {
            Task& task = tasks_.emplace_back();
            task.input.name = configured.name;
            task.input.type = configured.type;
            task.input.entry = configured.entry;
            task.motion = configured.motion;
            task.elsewhere = elsewhere_.contains(config::upperCase(configured.name));
        }
        if (tasks_.empty()) tasks_.emplace_back().motion = true; // T_ROB1
        const auto motion =
            std::find_if(tasks_.begin(), tasks_.end(), [](const Task& task) { return task.motion; });
        if (motion != tasks_.end()) std::rotate(tasks_.begin(), motion, motion + 1);
    }

    /// The place of a text in SYS.cfg.
    SourceRange find(const std::string& what, std::string_view section) const {
        const std::string_view text = sysFile_->text();
        const size_t from = text.find(section);
        const size_t at = from == std::string_view::npos ? from : text.find(what, from);
        if (at == std::string_view::npos) return {};
        return {static_cast<uint32_t>(at), static_cast<uint32_t>(at + what.size())};
    }

    static bool concerns(const ConfiguredModule& module, const Task& task) {
        return module.allTasks || (module.allMotionTasks && task.motion) ||
               sameName(module.task, task.input.name);
    }

    /// The file with this path; its ending may have changed, as RobotWare 7 makes .modx of .mod.
    static fs::path moduleAt(const fs::path& folder, std::string_view relative) {
        if (folder.empty()) return {};
        fs::path path = findPath(folder, relative);
        if (!path.empty()) return isFolder(path) || !isModule(path) ? fs::path() : path;
        const size_t slash = relative.find_last_of("/\\") + 1; // 0 when there is none
        const fs::path within = findPath(folder, relative.substr(0, slash));
        const std::string stem = fs::path(relative.substr(slash)).stem().string();
        for (const fs::path& other : within.empty() ? std::vector<fs::path>() : entries(within))
            if (isModule(other) && !isFolder(other) && sameName(other.stem().string(), stem)) return other;
        return {};
    }

    /// "HOME:/lib/x.sys" lies in lib of the chosen $HOME, in HOME/lib of the folder, in lib, or in the folder itself.
    fs::path locate(const std::string& file) const {
        const size_t colon = file.find(':');
        const std::string_view inside = withoutVolume(file);
        const std::string_view name = inside.substr(inside.find_last_of("/\\") + 1);
        const fs::path volume =
            colon == std::string::npos ? fs::path() : findEntry(folder_, file.substr(0, colon));
        const bool isInHome = colon != std::string::npos && sameName(file.substr(0, colon), "HOME");
        const fs::path chosen = isInHome ? fs::path(out_.chosenHome) : fs::path();
        for (const fs::path& found :
             {moduleAt(chosen, inside), moduleAt(volume, inside), moduleAt(folder_, inside),
              moduleAt(folder_, name), moduleAt(volume, name), moduleAt(findEntry(folder_, "HOME"), name)})
            if (!found.empty()) return found;
        return {};
    }

    void addConfigured(const ConfiguredModule& module) {
        const fs::path path = locate(module.file);
        std::vector<std::string> lacking;
        if (!path.empty()) named_.insert(path);
        for (Task& task : tasks_) {
            if (task.elsewhere || !concerns(module, task)) continue;
            task.own |= !path.empty() && !module.allTasks && !module.allMotionTasks;
            if (!path.empty()) {
                files_.addModule(path, task.input);
                continue;
            }
            task.input.missingModules.push_back(module.name);
            task.input.incomplete = true;
            lacking.push_back("'" + task.input.name + "'");
        }
        if (lacking.empty()) return;
        const bool own = sameName(module.file.substr(0, module.file.find(':')), "RELEASE");
        sink_.report(own ? say::SystemModuleNotSaved : say::ModuleNotSaved, sysFile_,
                     find(module.file, "CAB_TASK_MODULES"),
                     {module.name,
                      fmt::format("{} {}", lacking.size() == 1 ? "task" : "tasks", fmt::join(lacking, ", ")),
                      module.file});
    }

    /// Modules of a folder and of its PROGMOD and SYSMOD.
    std::vector<fs::path> modulesIn(const fs::path& folder) {
        std::vector<fs::path> found;
        for (const fs::path& part : {folder, findEntry(folder, "PROGMOD"), findEntry(folder, "SYSMOD")}) {
            if (part.empty()) continue;
            for (const fs::path& path : files_.list(part))
                if (isModule(path) && !isFolder(path)) found.push_back(path);
        }
        return found;
    }

    /// A subfolder with the name of a task holds modules of that task.
    void addOwnFolder(Task& task) {
        const fs::path own = findEntry(folder_, task.input.name);
        if (task.elsewhere || own.empty() || !isFolder(own)) return;
        for (const fs::path& path : modulesIn(own))
            if (named_.insert(path).second) addOwn(path, task);
    }

    /// Modules that SYS.cfg does not name belong to the first task, which moves the robot.
    void addOthers() {
        Task& task = tasks_.front();
        if (task.elsewhere) return;
        std::vector<fs::path> found = modulesIn(folder_);
        const auto isNamed = [&](const fs::path& path) { return named_.contains(path); };
        if (found.empty()) { // those of its subfolders, as in any folder
            for (const fs::path& path : files_.list(folder_)) {
                const std::string name = path.filename().string();
                if (!isFolder(path) || sameName(name, "SYSPAR") || sameName(name, "HOME") || isTask(name))
                    continue;
                const std::vector<fs::path> inside = modulesIn(path);
                found.insert(found.end(), inside.begin(), inside.end());
            }
        }
        std::erase_if(found, isNamed);
        for (const fs::path& path : found)
            addOwn(path, task);
    }

    void addOwn(const fs::path& path, Task& task) {
        files_.addModule(path, task.input);
        task.own = true;
    }

    bool isTask(const std::string& name) const {
        return std::any_of(tasks_.begin(), tasks_.end(),
                           [&](const Task& task) { return sameName(task.input.name, name); });
    }

    void handOver() {
        for (const fs::path& parameters : {folder_, findEntry(folder_, "SYSPAR")})
            for (const fs::path& path :
                 parameters.empty() ? std::vector<fs::path>() : files_.list(parameters))
                if (extensionOf(path) == ".cfg" && !isFolder(path)) out_.configFiles.push_back(path.string());
        const auto isBare = [](const Task& task) { return task.elsewhere || task.input.files.empty(); };
        const auto lacks = [](const Task& task) { return !task.input.missingModules.empty(); };
        if (std::all_of(tasks_.begin(), tasks_.end(), isBare) &&
            std::any_of(tasks_.begin(), tasks_.end(), lacks))
            out_.folderWithoutModules = folder_.string();
        for (Task& task : tasks_) {
            if (task.elsewhere) continue;
            const bool onlyForAll = !task.own && !task.motion && tasks_.size() > 1;
            if (task.input.files.empty() || onlyForAll) {
                if (!parameters_.tasks.empty())
                    sink_.report(say::TaskWithoutFolder, sysFile_,
                                 find('"' + task.input.name + '"', "CAB_TASKS"), {task.input.name, "folder"});
                continue;
            }
            if (task.input.incomplete && !task.motion && tasks_.size() > 1) task.input.optional = true;
            out_.tasks.push_back(std::move(task.input));
        }
        const fs::path home = findEntry(folder_, "HOME");
        if (!home.empty() && isFolder(home)) out_.homeFolder = home.string();
    }

    fs::path folder_;
    const std::set<std::string>& elsewhere_;
    FileReader& files_;
    diag::Sink& sink_;
    ProjectInput& out_;
    std::shared_ptr<const SourceFile> sysFile_;
    TaskParameters parameters_;
    std::vector<Task> tasks_;
    std::set<fs::path> named_; ///< files that have found their task
};

} // namespace

bool loadConfiguredFolder(const fs::path& folder, const std::set<std::string>& elsewhere, FileReader& files,
                          diag::Sink& sink, ProjectInput& out) {
    return FolderLoader(folder, elsewhere, files, sink, out).load();
}

} // namespace rapid::project
