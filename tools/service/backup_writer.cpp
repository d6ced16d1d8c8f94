#include "tools/service/backup_writer.h"

#include "config/atomic_file.h"
#include "config/cfg_writer.h"
#include "config/read_file.h"
#include "config/temporary.h"
#include "config/text_util.h"
#include "frontend/project/backinfo.h"
#include "frontend/project/files.h"
#include "frontend/project/system_parameters.h"
#include "frontend/syntax/parser.h"
#include "runtime/value/value_text.h"
#include "tools/program/program_sources.h"
#include "tools/service/event_journal.h"
#include "tools/service/folder_work.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <set>

namespace rapidc::service {

namespace {

namespace fs = std::filesystem;
namespace project = rapid::project;
using rapid::SourceFile;
using rapid::config::sameName;

/// The present values of the persistents that the modules of a file declare.
std::vector<rapid::edit::DataValue> valuesOf(const rt::ProgramTables& tables, int32_t task,
                                             const std::vector<std::string>& modules) {
    std::vector<rapid::edit::DataValue> values;
    for (const rt::GlobalDesc* data : tables.globals()) {
        const bool isWanted = data->kind == rt::kGlobalPersistent && tables.isDeclaredIn(*data, task) &&
                              std::any_of(modules.begin(), modules.end(), [&](const std::string& name) {
                                  return sameName(name, data->module);
                              });
        std::string text;
        if (isWanted && rt::valueToSource(data->address, *data->type, text))
            values.push_back({data->module, data->name, std::move(text)});
    }
    return values;
}

/// The tasks that the backup lists from which the controller was started, each with its modules on the host.
struct EarlierTask {
    project::ListedTask listed;
    std::vector<std::string> files;
};
std::vector<EarlierTask> earlierTasks(const VirtualController& controller) {
    std::vector<EarlierTask> tasks;
    for (const std::string& input : controller.settings().inputs.paths) {
        std::string bytes;
        const fs::path info =
            project::isFolder(input) ? project::findPath(input, "BACKINFO/backinfo.txt") : fs::path();
        if (info.empty() || !rapid::config::readFile(info.string(), bytes).empty()) continue;
        for (project::ListedTask& listed : project::readBackupInfo(bytes).tasks) {
            EarlierTask& task = tasks.emplace_back(EarlierTask{std::move(listed), {}});
            for (const char* part : {"PROGMOD", "SYSMOD"})
                for (const fs::path& path :
                     project::entries(project::findPath(input, "RAPID/" + task.listed.folder + "/" + part)))
                    if (project::isModule(path) && !project::isFolder(path))
                        task.files.push_back(path.string());
        }
    }
    return tasks;
}

bool isEncrypted(const std::string& path) {
    std::string bytes;
    return rapid::config::readFile(path, bytes).empty() && SourceFile(path, bytes).isEncrypted();
}

/// Encrypted modules are kept as they are, and so are tasks that the controller could not take.
void keepEarlier(const VirtualController& controller, BackupContent& content) {
    for (const EarlierTask& earlier : earlierTasks(controller)) {
        const auto same =
            std::find_if(content.tasks.begin(), content.tasks.end(), [&](const BackupContent::Task& task) {
                return sameName(task.name, earlier.listed.name);
            });
        if (same != content.tasks.end()) {
            same->program = earlier.listed.program;
            std::copy_if(earlier.files.begin(), earlier.files.end(), std::back_inserter(same->opaqueFiles),
                         isEncrypted);
        } else if (earlier.listed.folder != "TASK0") {
            BackupContent::Task& kept = content.tasks.emplace_back();
            kept.name = earlier.listed.name;
            kept.program = earlier.listed.program;
            kept.isConfigured = true; // as far as it was
            kept.opaqueFiles = earlier.files;
        }
    }
}

class Taker {
  public:
    Taker(VirtualController& controller, BackupContent& out) : controller_(controller), out_(out) {}

    void takeTask(std::size_t index) {
        const rt::Task& task = *controller_.core().tasks()[index];
        BackupContent::Task& taken = out_.tasks.emplace_back();
        taken.name = task.name();
        const rt::ProgramDesc& program = controller_.core().program();
        taken.type = index < program.taskCount ? program.tasks[index].type : "NORMAL";
        taken.isMotionTask = task.isMotionTask();
        takeCompiled(index, taken);
        takeLoaded(index, taken);
    }

  private:
    bool isInMemory(std::size_t task, const std::vector<std::string>& modules) const {
        return std::any_of(modules.begin(), modules.end(), [&](const std::string& name) {
            return controller_.core().tables().findModule(static_cast<int32_t>(task), name) != nullptr;
        });
    }

    void takeCompiled(std::size_t index, BackupContent::Task& taken) {
        const auto& sources = controller_.program().sources().tasks;
        if (index >= sources.size()) return;
        taken.entry = sources[index].input.entry;
        const std::vector<std::string>& sharedFiles = controller_.program().compilation().sharedFiles;
        for (std::size_t i = 0; i < sources[index].modules.size(); ++i) {
            const std::vector<std::string>& names = sources[index].modules[i];
            const std::shared_ptr<const SourceFile>& source = sources[index].input.files[i];
            if (names.empty() || !isInMemory(index, names)) continue;
            BackupContent::Module module{
                source, valuesOf(controller_.core().tables(), static_cast<int32_t>(index), names),
                names.front()};
            const bool isShared =
                std::find(sharedFiles.begin(), sharedFiles.end(), source->path()) != sharedFiles.end();
            if (!isShared)
                taken.modules.push_back(std::move(module));
            else if (shared_.insert(source->path()).second)
                out_.shared.push_back(std::move(module));
        }
    }

    /// Modules that were loaded while the program runs.
    void takeLoaded(std::size_t index, BackupContent::Task& taken) {
        const rt::Task& task = *controller_.core().tasks()[index];
        for (const rt::LoadedModule& module : controller_.core().tables().modules()) {
            std::string text;
            if (module.unit == nullptr || module.task != static_cast<int32_t>(index) ||
                !controller_.moduleText(task, module.name, text))
                continue;
            const std::string ending = fs::path(module.file).extension().string();
            const auto source = std::make_shared<const SourceFile>(
                module.name + (ending.empty() ? ".modx" : ending), std::move(text));
            taken.modules.push_back(
                {source, valuesOf(controller_.core().tables(), module.task, {module.name}), module.name});
        }
    }

    VirtualController& controller_;
    BackupContent& out_;
    std::set<std::string> shared_;
};

// ---- Writing -------------------------------------------------------------------------------------------------------

class Writer {
  public:
    Writer(const BackupContent& content, fs::path folder) : content_(content), folder_(std::move(folder)) {}

    std::string write() {
        for (const char* part : {"BACKINFO", "HOME", "RAPID", "SYSPAR"})
            makeFolder(part);
        writeParameters();
        writeTasks();
        writeDescriptions();
        if (problem_.empty() && !content_.homeFolder.empty()) copyHome();
        return problem_;
    }

  private:
    void makeFolder(const fs::path& relative) {
        std::error_code code;
        fs::create_directories(folder_ / relative, code);
        if (code && problem_.empty()) problem_ = fmt::format("{}: {}", relative.string(), code.message());
    }

    void put(const fs::path& relative, std::string_view bytes) {
        if (!problem_.empty()) return;
        problem_ = rapid::config::replaceFile((folder_ / relative).string(), bytes);
    }

    void writeParameters() {
        std::vector<std::pair<std::string, std::string>> files = content_.parameters;
        addTasks(files);
        for (const auto& [name, bytes] : files) {
            put(fs::path("SYSPAR") / name, bytes);
            parameterNames_.push_back(name);
        }
    }

    /// Tasks that only the command line knew become part of SYS.cfg.
    void addTasks(std::vector<std::pair<std::string, std::string>>& files) const {
        rapid::config::CfgSection section;
        section.type = "CAB_TASKS";
        for (const BackupContent::Task& task : content_.tasks) {
            if (task.isConfigured) continue;
            rapid::config::CfgInstance& instance = section.instances.emplace_back();
            instance.attributes.push_back({"Name", {task.name}, true, 0});
            if (!sameName(task.type, "SEMISTATIC"))
                instance.attributes.push_back({"Type", {task.type}, true, 0});
            if (!task.entry.empty() && !sameName(task.entry, "main"))
                instance.attributes.push_back({"Entry", {task.entry}, true, 0});
            if (task.isMotionTask) instance.attributes.push_back({"MotionTask", {}, false, 0});
        }
        if (section.instances.empty()) return;
        rapid::config::CfgFile added{
            {}, "SYS", fmt::format("CFG_1.0:{}:0::", content_.robotWare.major == 6 ? 6 : 7), {section}};
        const auto sys = std::find_if(files.begin(), files.end(), [](const auto& file) {
            return sameName(fs::path(file.first).stem().string(), "SYS");
        });
        if (sys == files.end()) {
            files.emplace_back("SYS.cfg", rapid::config::writeCfg(added));
            return;
        }
        std::vector<rapid::config::CfgProblem> ignored;
        rapid::config::CfgFile whole = rapid::config::parseCfg(sys->second, "SYS.cfg", ignored);
        whole.sections.push_back(section);
        sys->second = rapid::config::toLatin1(rapid::config::writeCfg(whole));
    }

    /// The module with the present values; the folder it belongs to, and its file in that.
    void writeModule(const std::string& taskFolder, const BackupContent::Module& module) {
        rapid::diag::Sink ignored;
        const auto tree = rapid::syntax::parse(module.source, ignored);
        const bool isSystem = !tree->modules.empty() &&
                              (tree->modules.front()->attributes & rapid::syntax::kAttrSysmodule) != 0;
        rapid::edit::SavedModule saved = rapid::edit::saveValues(*tree, module.values);
        const std::string bytes = saved.ok() ? std::move(saved.bytes) : module.source->bytes();
        std::string ending = fs::path(module.source->path()).extension().string();
        if (ending.empty()) ending = isSystem ? ".sysx" : ".modx";
        std::string name = module.name + ending;
        const std::string part = isSystem ? "SYSMOD" : "PROGMOD";
        for (int i = 2; !names_.insert(rapid::config::upperCase(taskFolder + part + name)).second; ++i)
            name = fmt::format("{}_{}{}", module.name, i, ending);
        makeFolder(fs::path("RAPID") / taskFolder / part);
        put(fs::path("RAPID") / taskFolder / part / name, bytes);
        listed_.push_back(fmt::format("{}/{}", part, name));
    }

    void writeTasks() {
        if (!content_.shared.empty()) {
            for (const BackupContent::Module& module : content_.shared)
                writeModule("TASK0", module);
            list("TASK0", "SHARED", "");
        }
        for (std::size_t i = 0; i < content_.tasks.size(); ++i) {
            const BackupContent::Task& task = content_.tasks[i];
            const std::string folder = fmt::format("TASK{}", i + 1);
            for (const char* part : {"PROGMOD", "SYSMOD"})
                makeFolder(fs::path("RAPID") / folder / part);
            for (const BackupContent::Module& module : task.modules)
                writeModule(folder, module);
            for (const std::string& path : task.opaqueFiles) {
                std::string bytes;
                if (!rapid::config::readFile(path, bytes).empty()) continue;
                const fs::path relative = fs::path(path).parent_path().filename() / fs::path(path).filename();
                put(fs::path("RAPID") / folder / relative, bytes);
                listed_.push_back(relative.generic_string());
            }
            list(folder, task.name, task.program);
        }
    }

    void list(const std::string& folder, const std::string& task, const std::string& program) {
        taskLists_ += fmt::format(">>{}: ({},{},)\n", folder, task, program);
        for (const std::string& module : listed_)
            taskLists_ += fmt::format("{} @ \n", module);
        taskLists_ += '\n';
        listed_.clear();
    }

    void writeDescriptions() {
        const std::string time = calendarText(content_.calendarSeconds);
        std::string info = fmt::format(
            "#\n# Generated backup file, do not edit.\n#\n# {}\n#\n>>SYSTEM_ID:\n{}\n\n>>PRODUCTS_ID:\n",
            time, content_.system.name);
        info += fmt::format("RobotWare Version: {}\n", content_.robotWare.name);
        for (const std::string& addIn : content_.system.addIns)
            if (const std::size_t blank = addIn.rfind(' '); blank != std::string::npos)
                info += fmt::format("{} Version: {}\n", addIn.substr(0, blank), addIn.substr(blank + 1));
        info += '\n';
        for (const std::string& option : content_.system.options)
            info += fmt::format("  {}\n", option);
        const bool isListed = std::find(content_.system.options.begin(), content_.system.options.end(),
                                        content_.system.robotType) != content_.system.options.end();
        if (!content_.namesRobot && !isListed) info += fmt::format("  {}\n", content_.system.robotType);
        info += "\n>>HOME:\nAll public files and directories\n\n>>SYSPAR:\n";
        for (const std::string& name : parameterNames_)
            info += name + "\n";
        info += "\n\n" + taskLists_ + ">>EOF:\n";
        put("BACKINFO/backinfo.txt", info);
        put("BACKINFO/version.xml",
            fmt::format("<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<Version>\n  <Major>{}</Major>\n  "
                        "<Minor>{}</Minor>\n"
                        "  <Build>{}</Build>\n  <Revision>{}</Revision>\n  <Name>{}</Name>\n</Version>\n",
                        content_.robotWare.major, content_.robotWare.minor, content_.robotWare.build,
                        content_.robotWare.revision, content_.robotWare.name));
        put("BACKINFO/system.guid", content_.system.id + "\n");
        put("BACKINFO/template.guid", content_.system.id + "\n");
        put("BACKINFO/program.id", "rapidc\n");
        put("system.xml",
            fmt::format(
                "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<System>\n  <Name>{}</Name>\n  <Id>{}</Id>\n"
                "  <RobotWare>{}</RobotWare>\n</System>\n",
                escaped(content_.system.name), content_.system.id, content_.robotWare.name));
    }

    static std::string escaped(const std::string& text) {
        std::string out;
        for (const char c : text)
            out += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
        return out;
    }

    void copyHome() {
        const rt::Descriptor from(::open(content_.homeFolder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
        const rt::Descriptor to(::open((folder_ / "HOME").c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
        if (!from.isOpen() || !to.isOpen()) {
            problem_ = fmt::format("HOME: {}", std::strerror(errno));
            return;
        }
        if (const int error = copyAll(from.number(), to.number(), folder_.string()); error != 0)
            problem_ = fmt::format("HOME: {}", std::strerror(error));
    }

    const BackupContent& content_;
    fs::path folder_;
    std::string problem_, taskLists_;
    std::vector<std::string> parameterNames_, listed_;
    std::set<std::string> names_;
};

} // namespace

BackupContent takeBackup(VirtualController& controller, const ConfigurationStore& configuration) {
    BackupContent content;
    content.system = systemFacts(controller);
    content.robotWare = robotWareVersion(controller.settings().robotWare);
    content.parameters = configuration.files();
    content.homeFolder = controller.folderOf("HOME");
    content.calendarSeconds = controller.core().calendarSeconds();
    content.namesRobot = false;
    std::set<std::string> configured;
    for (const auto& [name, bytes] : content.parameters) {
        std::vector<rapid::config::CfgProblem> ignored;
        const rapid::config::CfgFile file = rapid::config::parseCfg(bytes, name, ignored);
        for (const rapid::config::CfgSection* section : file.find("ROBOT"))
            for (const rapid::config::CfgInstance& robot : section->instances)
                content.namesRobot = content.namesRobot || !robot.text("use_robot_type").empty();
        for (const rapid::config::CfgSection* section : file.find("CAB_TASKS"))
            for (const rapid::config::CfgInstance& task : section->instances)
                configured.insert(rapid::config::upperCase(task.text("Name")));
    }
    Taker taker(controller, content);
    for (std::size_t i = 0; i < controller.core().tasks().size(); ++i) {
        taker.takeTask(i);
        content.tasks.back().isConfigured =
            configured.contains(rapid::config::upperCase(content.tasks.back().name));
    }
    keepEarlier(controller, content);
    return content;
}

std::string writeBackup(const BackupContent& content, const std::string& folder) {
    std::error_code code;
    const fs::path target = fs::absolute(folder).lexically_normal();
    if (fs::exists(fs::symlink_status(target, code)))
        return fmt::format("{} exists already", target.filename().string());
    rapid::config::TemporaryFolder temporary;
    if (const int error = temporary.makeBeside(target.parent_path(), target.filename().string()); error != 0)
        return std::strerror(error);
    const fs::path whole = fs::path(temporary.path()) / "backup";
    fs::create_directory(whole, code);
    if (code) return code.message();
    if (std::string problem = Writer(content, whole).write(); !problem.empty()) return problem;
    if (::renameat2(AT_FDCWD, whole.c_str(), AT_FDCWD, target.c_str(), RENAME_NOREPLACE) != 0)
        return std::strerror(errno);
    return {};
}

} // namespace rapidc::service
