#include "frontend/project/backup.h"

#include "config/cfg_parser.h"
#include "config/read_file.h"
#include "config/text_util.h"
#include "frontend/diag/messages/projects.h"
#include "frontend/project/backinfo.h"
#include "frontend/project/system_parameters.h"
#include "frontend/syntax/ast.h"
#include "frontend/syntax/parser.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>

namespace rapid::project {

namespace fs = std::filesystem;
using config::sameName;
namespace say = diag::say;

namespace {

/// n of "TASKn"; -1 for other names.
int taskNumber(std::string_view name) {
    constexpr std::string_view kWord = "TASK";
    if (name.size() <= kWord.size() || !sameName(name.substr(0, kWord.size()), kWord)) return -1;
    name.remove_prefix(kWord.size());
    int number = -1;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
    return error == std::errc() && end == name.data() + name.size() ? number : -1;
}

std::string plural(size_t n, std::string_view word) {
    return fmt::format("{} {}{}", n, word, n == 1 ? "" : "s");
}

/// A file of the backup that describes it, as a place for diagnostics.
struct Description {
    static constexpr size_t kMostSearches = 2000; ///< they take time, and more mistakes are not shown
    std::shared_ptr<const SourceFile> file;
    mutable size_t searches = 0;

    std::string_view text() const { return file ? file->text() : std::string_view(); }
    /// The place of `what` after the first `after`; the beginning of the file if it is not there.
    SourceRange find(std::string_view what, std::string_view after = {}) const {
        if (++searches > kMostSearches) return {};
        const size_t from = text().find(after);
        const size_t at = from == std::string_view::npos ? from : text().find(what, from + after.size());
        if (at == std::string_view::npos) return {};
        return {static_cast<uint32_t>(at), static_cast<uint32_t>(at + what.size())};
    }
};

bool hasTaskFolders(const fs::path& folder) {
    for (const fs::path& path : entries(folder))
        if (isFolder(path) && taskNumber(path.filename().string()) >= 0 &&
            (!findEntry(path, "PROGMOD").empty() || !findEntry(path, "SYSMOD").empty()))
            return true;
    return false;
}

/// The folder of the tasks' folders: RAPID, or the folder itself when only the program was kept.
fs::path rapidIn(const fs::path& folder) {
    const fs::path rapid = findEntry(folder, "RAPID");
    return rapid.empty() && hasTaskFolders(folder) ? folder : rapid;
}

/// One task while it is put together.
struct TaskParts {
    sema::TaskInput input;
    fs::path folder; ///< RAPID/TASKn; empty if the backup has none
    const ListedTask* listed = nullptr;
    const ConfiguredTask* configured = nullptr;
    std::vector<std::string> encrypted;
    std::vector<std::string> notSaved;
};

class BackupLoader {
  public:
    BackupLoader(const fs::path& folder, FileReader& files, diag::Sink& sink, ProjectInput& out)
        : folder_(folder), rapid_(rapidIn(folder)), files_(files), sink_(sink), out_(out) {}

    void load() {
        readDescriptions();
        findTasks();
        for (TaskParts& task : tasks_)
            readModules(task);
        addConfiguredModules();
        reportMissingTasks();
        reportOverview();
        for (const TaskParts& task : tasks_)
            reportTask(task);
        handOver();
    }

  private:
    Description readDescription(const fs::path& path) {
        std::string bytes;
        if (path.empty() || !files_.read(path, bytes)) return {};
        return {std::make_shared<const SourceFile>(path.string(), std::move(bytes))};
    }

    template <size_t N>
    void report(diag::Message<N> message, const Description& where, SourceRange range,
                diag::MessageArgs<N> args) {
        sink_.report(message, where.file, range, args);
    }

    void readDescriptions() {
        infoFile_ = readDescription(findEntry(findEntry(folder_, "BACKINFO"), "backinfo.txt"));
        info_ = readBackupInfo(infoFile_.text());
        const fs::path parameters = findEntry(folder_, "SYSPAR");
        for (const fs::path& path : files_.list(parameters)) {
            if (extensionOf(path) != ".cfg") continue;
            out_.configFiles.push_back(path.string());
            const std::string stem = path.stem().string();
            if (sameName(stem, "SYS")) sysFile_ = readDescription(path);
            if (sameName(stem, "EIO")) readSignals(readDescription(path));
            if (sameName(stem, "MOC")) readRobot(readDescription(path));
        }
        parameters_ = readTaskParameters(sysFile_.text());
        home_ = findEntry(folder_, "HOME");
    }

    /// The consequences of missing system parameters; nothing for a program that was saved without its controller.
    std::string describeMissingParameters() const {
        if (!infoFile_.file) return {};
        const fs::path parameters = findEntry(folder_, "SYSPAR");
        std::string text;
        if (findEntry(parameters, "SYS.cfg").empty())
            text += "; no SYSPAR/SYS.cfg: type, entry and start-up modules of the tasks are not known";
        if (findEntry(parameters, "EIO.cfg").empty())
            text += "; no SYSPAR/EIO.cfg: its signals are not known";
        return text;
    }

    void readSignals(const Description& file) {
        std::vector<config::CfgProblem> ignored;
        const config::CfgFile parsed = config::parseCfg(file.text(), "EIO.cfg", ignored);
        for (const config::CfgSection* section : parsed.find("EIO_SIGNAL"))
            signals_ += section->instances.size();
    }

    void readRobot(const Description& file) {
        std::vector<config::CfgProblem> ignored;
        const config::CfgFile parsed = config::parseCfg(file.text(), "MOC.cfg", ignored);
        for (const config::CfgSection* section : parsed.find("ROBOT"))
            for (const config::CfgInstance& robot : section->instances)
                if (const std::string type = robot.text("use_robot_type"); !type.empty())
                    robots_.push_back(type);
    }

    // ---- Tasks -----------------------------------------------------------------------------------------------------

    const ConfiguredTask* configured(const std::string& name) const {
        for (const ConfiguredTask& task : parameters_.tasks)
            if (sameName(task.name, name)) return &task;
        return nullptr;
    }

    bool hasTask(const ConfiguredTask& configured) const {
        return std::any_of(tasks_.begin(), tasks_.end(),
                           [&](const TaskParts& task) { return task.configured == &configured; });
    }

    /// A task that RAPID has no folder of, but HOME a module that is meant for it alone.
    bool isLoadedFromHome(const ConfiguredTask& task) const {
        return std::any_of(parameters_.modules.begin(), parameters_.modules.end(),
                           [&](const ConfiguredModule& module) {
                               return sameName(module.task, task.name) && !inHome(module.file).empty();
                           });
    }

    TaskParts& addTask(const std::string& name) {
        TaskParts& task = tasks_.emplace_back();
        task.input.name = name;
        task.configured = configured(name);
        if (task.configured) {
            task.input.type = task.configured->type;
            task.input.entry = task.configured->entry;
        } else if (!parameters_.tasks.empty()) {
            task.input.type = "SEMISTATIC"; // made by an option: its parameters are not in SYS.cfg
            task.input.optional = true;
        }
        return task;
    }

    /// backinfo.txt lists the tasks; without it the folders represent the tasks of CAB_TASKS in their order.
    void findTasks() {
        std::vector<fs::path> folders;
        for (const fs::path& path : files_.list(rapid_)) {
            const int number = taskNumber(path.filename().string());
            if (!isFolder(path)) continue;
            if (number == 0) sharedFolder_ = path;
            if (number > 0) folders.push_back(path);
        }
        const auto numberOf = [](const fs::path& path) { return taskNumber(path.filename().string()); };
        std::sort(folders.begin(), folders.end(), [&](const fs::path& a, const fs::path& b) {
            return std::make_pair(numberOf(a), a) < std::make_pair(numberOf(b), b);
        });
        for (const ListedTask& listed : info_.tasks) {
            if (taskNumber(listed.folder) == 0) continue;
            TaskParts& task = addTask(listed.name);
            task.listed = &listed;
            const auto found = std::find_if(folders.begin(), folders.end(), [&](const fs::path& path) {
                return sameName(path.filename().string(), listed.folder);
            });
            if (found == folders.end()) continue;
            task.folder = *found;
            folders.erase(found);
        }
        if (info_.tasks.empty()) sink_.report(say::BackupWithoutList, nullptr, {}, {folder_.string()});
        for (const fs::path& folder : folders)
            addTask(nameFor(folder)).folder = folder;
        for (const ConfiguredTask& task : parameters_.tasks)
            if (!hasTask(task) && isLoadedFromHome(task)) addTask(task.name);
        if (tasks_.empty() &&
            !rapid_.empty()) { // RAPID/PROGMOD and RAPID/SYSMOD: one task without a folder of its own
            addTask(parameters_.tasks.empty() ? "T_ROB1" : parameters_.tasks.front().name).folder = rapid_;
        }
    }

    /// The name of a task folder that backinfo.txt does not tell: the n-th task of CAB_TASKS, else that of the folder.
    std::string nameFor(const fs::path& folder) const {
        const std::string own = folder.filename().string();
        const auto number = static_cast<size_t>(taskNumber(own));
        if (!info_.tasks.empty() || number > parameters_.tasks.size())
            return number == 1 && info_.tasks.empty() ? "T_ROB1" : own;
        return parameters_.tasks[number - 1].name;
    }

    // ---- Modules ---------------------------------------------------------------------------------------------------

    void addModule(const fs::path& path, TaskParts& task) {
        const size_t before = task.input.missingModules.size();
        files_.addModule(path, task.input);
        if (task.input.missingModules.size() > before) task.encrypted.push_back(path.filename().string());
        loaded_.push_back({&task - tasks_.data(), path.stem().string()});
    }

    bool has(const TaskParts& task, const std::string& module) const {
        return std::any_of(loaded_.begin(), loaded_.end(), [&](const auto& one) {
            return one.first == &task - tasks_.data() && sameName(one.second, module);
        });
    }

    void addMissing(TaskParts& task, const std::string& name) {
        task.notSaved.push_back(name);
        task.input.missingModules.push_back(name);
        task.input.incomplete = true;
    }

    /// The file of a listed module; its ending may have changed since: RobotWare 7.1 made .modx of .mod.
    static fs::path findListed(const TaskParts& task, const ListedModule& listed) {
        fs::path path = findPath(task.folder, listed.folder + "/" + listed.file);
        if (!path.empty()) return path;
        for (const fs::path& other : entries(findPath(task.folder, listed.folder)))
            if (isModule(other) && !isFolder(other) && sameName(other.stem().string(), stemOf(listed.file)))
                return other;
        return {};
    }

    void reportUnsaved(const TaskParts& task, const ListedModule& listed) {
        const std::string name = listed.folder + "/" + listed.file;
        const SourceRange place = infoFile_.find(listed.file, ">>" + task.listed->folder);
        if (listed.hidden)
            report(say::SystemModuleNotSaved, infoFile_, place,
                   {stemOf(listed.file), "task '" + task.input.name + "'", name + ", hidden"});
        else if (!task.folder.empty() || task.configured) // else the task is left out, which is reported
            report(say::ListedModuleMissing, infoFile_, place,
                   {name, task.input.name, (fs::path("RAPID") / task.listed->folder).string()});
    }

    void readModules(TaskParts& task) {
        std::set<fs::path> done;
        const std::vector<ListedModule> none;
        for (const ListedModule& listed : task.listed ? task.listed->modules : none) {
            const fs::path path = findListed(task, listed);
            if (path.empty()) {
                reportUnsaved(task, listed);
                addMissing(task, listed.file);
            } else if (done.insert(path).second) {
                addModule(path, task);
            }
        }
        for (const char* part : {"PROGMOD", "SYSMOD"}) {
            for (const fs::path& path : files_.list(findEntry(task.folder, part))) {
                if (!isModule(path) || isFolder(path) || done.contains(path)) continue;
                if (!task.listed || task.listed->modules.empty() || isReadUnlisted(path, task))
                    addModule(path, task);
            }
        }
        for (const fs::path& path : sharedModules())
            addModule(path, task);
    }

    /// A file that backinfo.txt does not list is new, or another version of a listed module: that one counts.
    bool isReadUnlisted(const fs::path& path, const TaskParts& task) {
        std::string outcome = "it is read, but a controller would not restore it";
        const std::string known = listedModuleIn(path, task);
        if (!known.empty())
            outcome = fmt::format("it is left out, as a listed file has its module '{}'", known);
        report(say::UnlistedModule, infoFile_, infoFile_.find(">>" + task.listed->folder),
               {path.string(), task.input.name, outcome});
        return known.empty();
    }

    /// The first module of a file that has the name of a listed file, as controllers name files by their modules.
    std::string listedModuleIn(const fs::path& path, const TaskParts& task) {
        std::string bytes;
        if (!config::readFile(path.string(), bytes).empty()) return {};
        const auto source = std::make_shared<const SourceFile>(path.string(), std::move(bytes));
        diag::Sink ignored;
        const auto tree = source->isEncrypted() ? nullptr : syntax::parse(source, ignored);
        if (!tree) return {};
        for (const syntax::ModuleDecl* module : tree->modules) {
            const std::string name(tree->text(module->name));
            const auto& listed = task.listed->modules;
            if (std::any_of(listed.begin(), listed.end(),
                            [&](const ListedModule& one) { return sameName(stemOf(one.file), name); }))
                return name;
        }
        return {};
    }

    /// Modules that are installed once for all tasks.
    std::vector<fs::path> sharedModules() {
        std::vector<fs::path> found;
        for (const char* part : {"PROGMOD", "SYSMOD"})
            for (const fs::path& path : files_.list(findEntry(sharedFolder_, part)))
                if (isModule(path) && !isFolder(path)) found.push_back(path);
        return found;
    }

    static bool concerns(const ConfiguredModule& module, const TaskParts& task) {
        if (module.allTasks) return true;
        if (module.allMotionTasks && task.configured && task.configured->motion) return true;
        return sameName(module.task, task.input.name);
    }

    /// CAB_TASK_MODULES names what is loaded at start-up: usually it was saved in SYSMOD, it may lie in HOME, and
    /// modules of add-ins and of RobotWare are not part of a backup.
    void addConfiguredModules() {
        for (const ConfiguredModule& module : parameters_.modules) {
            std::vector<std::string> lacking;
            for (TaskParts& task : tasks_) {
                if (!concerns(module, task) || has(task, module.name) || has(task, stemOf(module.file)))
                    continue;
                const fs::path path = inHome(module.file);
                if (!path.empty()) {
                    addModule(path, task);
                    continue;
                }
                if (isLeftOut(task) || isKnownMissing(task, module)) continue; // already reported
                addMissing(task, module.name);
                lacking.push_back("'" + task.input.name + "'");
            }
            if (lacking.empty()) continue;
            const bool own = sameName(module.file.substr(0, module.file.find(':')), "RELEASE");
            report(own ? say::SystemModuleNotSaved : say::ModuleNotSaved, sysFile_,
                   sysFile_.find(module.file, "CAB_TASK_MODULES"),
                   {module.name,
                    fmt::format("{} {}", lacking.size() == 1 ? "task" : "tasks", fmt::join(lacking, ", ")),
                    module.file});
        }
    }

    static bool isKnownMissing(const TaskParts& task, const ConfiguredModule& module) {
        return std::any_of(task.notSaved.begin(), task.notSaved.end(), [&](const std::string& file) {
            return sameName(stemOf(file), module.name) || sameName(stemOf(file), stemOf(module.file));
        });
    }

    static std::string stemOf(const std::string& file) {
        const size_t slash = file.find_last_of("/\\:");
        return fs::path(slash == std::string::npos ? file : file.substr(slash + 1)).stem().string();
    }

    fs::path inHome(std::string_view file) const {
        const size_t colon = file.find(':');
        if (colon == std::string_view::npos || !sameName(file.substr(0, colon), "HOME")) return {};
        for (const fs::path& home : {fs::path(out_.chosenHome), home_}) {
            if (home.empty()) continue;
            fs::path path = findPath(home, file.substr(colon + 1));
            if (!path.empty() && !isFolder(path) && isModule(path)) return path;
        }
        return {};
    }

    // ---- Report ----------------------------------------------------------------------------------------------------

    void reportMissingTasks() {
        for (const ConfiguredTask& configured : parameters_.tasks) {
            if (hasTask(configured)) continue;
            SourceRange place = sysFile_.find("-Name \"" + configured.name + '"', "CAB_TASKS:");
            if (place.end == 0) place = sysFile_.find('"' + configured.name + '"', "CAB_TASKS:");
            report(say::TaskWithoutFolder, sysFile_, place, {configured.name, "backup"});
        }
    }

    void reportOverview() {
        std::string text = info_.systemId.empty() ? "" : fmt::format(" of system '{}'", info_.systemId);
        if (!info_.robotWare.empty()) text += fmt::format(", RobotWare {}", info_.robotWare);
        text += fmt::format(": {}, {}", plural(tasks_.size(), "task"), plural(signals_, "signal"));
        for (const std::string& robot : robots_)
            text += fmt::format(", robot {}", robot);
        if (robots_.empty() && !robotOption().empty()) text += fmt::format(", robot {}", robotOption());
        for (const std::string& addIn : info_.addIns)
            text += fmt::format(", add-in {}", addIn);
        text += describeMissingParameters();
        report(say::BackupOverview, infoFile_, {}, {text});
    }

    /// "IRB 1660ID-4/1.55" among the options: the robot, if MOC.cfg does not tell it.
    std::string robotOption() const {
        for (const std::string& option : info_.options) {
            const bool isRobot = option.starts_with("IRB ") || option.starts_with("CRB ");
            if (isRobot && option.find('/') != std::string::npos) return option;
        }
        return {};
    }

    static bool isLeftOut(const TaskParts& task) {
        return !task.configured && task.input.files.empty() && task.encrypted.empty();
    }

    void reportTask(const TaskParts& task) {
        const SourceRange place = task.listed ? infoFile_.find(">>" + task.listed->folder) : SourceRange();
        const sema::TaskInput& input = task.input;
        if (isLeftOut(task)) {
            std::string reason = "the backup has no modules for it";
            if (task.listed && !parameters_.tasks.empty()) reason += ", an option of the controller makes it";
            report(say::TaskLeftOut, infoFile_, place, {input.name, reason});
            return;
        }
        if (!task.configured && !parameters_.tasks.empty())
            report(say::TaskNotConfigured, infoFile_, place, {input.name});
        std::string text = fmt::format("{}{}, entry '{}': {}", input.type,
                                       task.configured && task.configured->motion ? ", motion" : "",
                                       input.entry, plural(input.files.size(), "module"));
        if (!task.encrypted.empty())
            text +=
                fmt::format("; {} encrypted ({})", task.encrypted.size(), fmt::join(task.encrypted, ", "));
        if (!task.notSaved.empty())
            text += fmt::format("; {} not in the backup ({})", task.notSaved.size(),
                                fmt::join(task.notSaved, ", "));
        if (input.incomplete) text += "; names that no module declares may be declared there";
        report(say::TaskOverview, infoFile_, place, {input.name, text});
        if (input.files.empty())
            report(say::TaskLeftOut, infoFile_, place,
                   {input.name, task.encrypted.empty() ? "the backup has no modules for it"
                                                       : "all its modules are encrypted"});
    }

    void handOver() {
        // The first task moves the robot.
        const auto motionTask = std::find_if(tasks_.begin(), tasks_.end(), [](const TaskParts& task) {
            return task.configured && task.configured->motion;
        });
        if (motionTask != tasks_.end()) std::rotate(tasks_.begin(), motionTask, motionTask + 1);
        for (TaskParts& task : tasks_) {
            if (task.input.files.empty()) continue;
            // Its entry routine may be in a module that cannot be read.
            const bool motion = task.configured && task.configured->motion;
            if (task.input.incomplete && !motion && tasks_.size() > 1) task.input.optional = true;
            out_.tasks.push_back(std::move(task.input));
        }
        if (!infoFile_.text().empty()) out_.robotWareOptions = info_.options;
        if (robots_.empty()) out_.robot = robotOption();
        for (const fs::path& path : sharedModules())
            out_.sharedFiles.push_back(path.string());
        out_.homeFolder = home_.string();
        out_.isBackup = true;
    }

    fs::path folder_, rapid_, home_, sharedFolder_;
    FileReader& files_;
    diag::Sink& sink_;
    ProjectInput& out_;
    Description infoFile_, sysFile_;
    BackupInfo info_;
    TaskParameters parameters_;
    size_t signals_ = 0;
    std::vector<std::string> robots_;
    std::vector<TaskParts> tasks_;
    std::vector<std::pair<std::ptrdiff_t, std::string>>
        loaded_; ///< task and name of the file, without its ending
};

} // namespace

bool isBackup(const fs::path& folder) {
    const fs::path rapid = findEntry(folder, "RAPID");
    if (rapid.empty() || !isFolder(rapid)) // it may have been lost
        return !findEntry(findEntry(folder, "BACKINFO"), "backinfo.txt").empty() || hasTaskFolders(folder);
    if (!findEntry(folder, "BACKINFO").empty()) return true;
    for (const fs::path& path : entries(rapid)) {
        const std::string name = path.filename().string();
        if (isFolder(path) &&
            (taskNumber(name) >= 0 || sameName(name, "PROGMOD") || sameName(name, "SYSMOD")))
            return true;
    }
    return false;
}

void loadBackup(const fs::path& folder, FileReader& files, diag::Sink& sink, ProjectInput& out) {
    BackupLoader(folder, files, sink, out).load();
}

} // namespace rapid::project
