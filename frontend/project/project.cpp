#include "frontend/project/project.h"

#include "config/text_util.h"
#include "frontend/diag/messages/projects.h"
#include "frontend/project/backup.h"
#include "frontend/project/configured_folder.h"
#include "frontend/project/files.h"
#include "frontend/project/program_file.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <set>

namespace rapid::project {

namespace fs = std::filesystem;
namespace say = diag::say;

namespace {

class Loader {
  public:
    /// `elsewhere`: the tasks whose modules the command line names.
    Loader(ProjectInput& out, diag::Sink& sink, std::set<std::string> elsewhere, const OpenTexts* texts)
        : out_(out), sink_(sink), texts_(texts), files_(sink, texts), elsewhere_(std::move(elsewhere)) {}

    /// Adds what `input` names to `task`. A backup adds tasks of its own and leaves `task` alone.
    void add(const std::string& input, sema::TaskInput& task, bool allowBackup) {
        const fs::path path(input);
        std::error_code error;
        if (!fs::exists(path, error) && !(texts_ && texts_->find(input))) {
            report(say::FileNotFound, {input});
        } else if (isFolder(path)) {
            const fs::path backup = allowBackup ? backupIn(path) : fs::path();
            if (!backup.empty())
                addBackup(backup);
            else if (!allowBackup || !loadConfiguredFolder(path, elsewhere_, files_, sink_, out_))
                addFolder(path, task);
        } else if (isModule(path)) {
            files_.addModule(path, task);
        } else if (extensionOf(path) == ".pgf") {
            addProgram(path, task);
        } else if (extensionOf(path) == ".cfg") {
            out_.configFiles.push_back(input);
        } else {
            report(say::NotAModule, {input});
        }
    }

    template <size_t N> void report(diag::Message<N> message, diag::MessageArgs<N> args) {
        files_.report(message, args);
    }
    void report(diag::Message<0> message) { files_.report(message); }
    const std::vector<std::string>& filesRead() const { return files_.filesRead(); }

  private:
    /// The folder itself, the backup whose RAPID it is, or the only folder in it that is a backup while nothing else
    /// there is RAPID.
    static fs::path backupIn(const fs::path& given) {
        fs::path folder = given.has_filename() ? given : given.parent_path(); // "RAPID/"
        std::error_code unreadable; // then it is not a folder, which is reported elsewhere
        const fs::path whole = fs::canonical(folder, unreadable); // "." has a name, too
        fs::path parent = folder / "..";
        if (folder.filename() == whole.filename())
            parent = folder.has_parent_path() ? folder.parent_path() : fs::path(".");
        if (config::sameName(whole.filename().string(), "RAPID") && isBackup(parent)) return parent;
        if (isBackup(folder)) return folder;
        fs::path found;
        for (const fs::path& path : entries(folder)) {
            if (isModule(path)) return {};
            if (!isFolder(path) || !isBackup(path)) continue;
            if (!found.empty()) return {};
            found = path;
        }
        return found;
    }

    void addBackup(const fs::path& folder) {
        const size_t before = out_.tasks.size();
        loadBackup(folder, files_, sink_, out_);
        if (out_.tasks.size() == before) report(say::FolderWithoutModules, {folder.string(), ""});
    }

    /// The folders below a folder that have modules: "; there are some in ...: name one of these".
    static std::string elsewhere(const fs::path& folder) {
        constexpr int kMostEntries = 5000, kMostNamed = 3;
        std::set<std::string> found;
        std::error_code error;
        int seen = 0;
        for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end;
             it.increment(error)) {
            if (++seen > kMostEntries || it.depth() > 8) break;
            if (isModule(it->path()) && !isFolder(it->path())) found.insert(placeOf(it->path()).string());
        }
        if (found.empty()) return {};
        std::vector<std::string> named(found.begin(), found.end());
        const bool more = named.size() > kMostNamed;
        if (more) named.resize(kMostNamed);
        return fmt::format("; there are some in '{}'{}: name {}", fmt::join(named, "', '"),
                           more ? " and more" : "", found.size() == 1 ? "that" : "one of these");
    }

    /// The backup that a module belongs to, or its folder.
    static fs::path placeOf(const fs::path& module) {
        for (fs::path above = module.parent_path(); above.has_filename(); above = above.parent_path())
            if (isBackup(above)) return isBackup(above.parent_path()) ? above.parent_path() : above; // RAPID
        return module.parent_path();
    }

    size_t addFiles(const fs::path& folder, sema::TaskInput& task) {
        size_t modules = 0;
        for (const fs::path& path : files_.list(folder)) {
            if (isFolder(path)) continue;
            if (isModule(path)) {
                files_.addModule(path, task);
                ++modules;
            } else if (extensionOf(path) == ".cfg") {
                out_.configFiles.push_back(path.string());
            }
        }
        return modules;
    }

    // The modules of a folder; if it has none itself, those of its subfolders (PROGMOD, SYSMOD).
    void addFolder(const fs::path& folder, sema::TaskInput& task) {
        size_t modules = addFiles(folder, task);
        addParameters(folder);
        if (modules == 0)
            for (const fs::path& path : files_.list(folder))
                if (isFolder(path) && !config::sameName(path.filename().string(), "SYSPAR"))
                    modules += addFiles(path, task);
        if (modules == 0 && !files_.isUnreadable(folder))
            report(say::FolderWithoutModules, {folder.string(), elsewhere(folder)});
    }

    void addParameters(const fs::path& folder) {
        for (const fs::path& path : files_.list(findEntry(folder, "SYSPAR")))
            if (extensionOf(path) == ".cfg") out_.configFiles.push_back(path.string());
    }

    /// A module that a program file names. An absolute path is one of another machine: its module may lie beside.
    static fs::path findModule(const fs::path& folder, const std::string& name) {
        fs::path found = findPath(folder, name);
        const bool isAbsolute = name.starts_with('/') || name.find(':') != std::string::npos;
        if (!found.empty() || !isAbsolute) return found;
        return findPath(folder, std::string_view(name).substr(name.find_last_of("/\\:") + 1));
    }

    /// The place of a module's name in a program file, or its beginning.
    static SourceRange placeIn(const SourceFile& file, const std::string& name) {
        const std::string_view text = file.text();
        std::string other = name; // as it may be written
        std::replace(other.begin(), other.end(), '/', '\\');
        for (const std::string& form : {name, other})
            if (const size_t at = text.find(form); at != std::string_view::npos)
                return {static_cast<uint32_t>(at), static_cast<uint32_t>(at + form.size())};
        return {};
    }

    void addProgram(const fs::path& path, sema::TaskInput& task) {
        std::string text;
        if (!files_.read(path, text)) return;
        std::vector<std::string> modules;
        const bool readable = readProgramFile(text, modules);
        const auto file = std::make_shared<const SourceFile>(path.string(), std::move(text));
        if (!readable) {
            sink_.report(
                say::BadProgramFile, file, {},
                {path.string(),
                 "expected the XML program description of a controller, from <Program> to </Program>"});
            return;
        }
        if (modules.empty())
            sink_.report(say::BadProgramFile, file, {}, {path.string(), "it names no modules"});
        task.incomplete = true; // system modules, which it never lists, may declare more
        const fs::path folder = path.parent_path().empty() ? fs::path(".") : path.parent_path();
        for (const std::string& name : modules) {
            const fs::path found = findModule(folder, name);
            if (found.empty())
                sink_.report(say::ProgramModuleMissing, file, placeIn(*file, name), {path.string(), name});
            else
                files_.addModule(path.parent_path().empty() ? found.lexically_relative(".") : found, task);
        }
        addParameters(folder);
    }

    ProjectInput& out_;
    diag::Sink& sink_;
    const OpenTexts* texts_;
    FileReader files_;
    std::set<std::string> elsewhere_;
};

/// Files that are named beside a folder with tasks of its own join the task that moves the robot.
void joinFirst(ProjectInput& out, sema::TaskInput& main) {
    if (out.isBackup || out.tasks.empty()) return;
    sema::TaskInput& first = out.tasks.front();
    first.files.insert(first.files.end(), main.files.begin(), main.files.end());
    first.missingModules.insert(first.missingModules.end(), main.missingModules.begin(),
                                main.missingModules.end());
    first.incomplete |= main.incomplete;
    main = {};
}

void reportNoModule(const ProjectInput& out, Loader& loader) {
    const std::string& bare = out.folderWithoutModules;
    loader.report(say::NoInput, {bare.empty() ? "name a file or a folder"
                                              : "none of those that SYS.cfg names exists; copy them into '" +
                                                    (fs::path(bare) / "HOME").string() + "'"});
}

} // namespace

bool loadProject(const std::vector<std::string>& inputs, const std::vector<TaskSpec>& extraTasks,
                 ProjectInput& out, diag::Sink& sink, const OpenTexts* texts) {
    const size_t errorsBefore = sink.errorCount();
    std::set<std::string> elsewhere;
    for (const TaskSpec& spec : extraTasks)
        elsewhere.insert(config::upperCase(spec.name));
    Loader loader(out, sink, std::move(elsewhere), texts);
    sema::TaskInput main;
    for (const std::string& input : inputs)
        loader.add(input, main, true);
    joinFirst(out, main);
    if (!main.files.empty() || !main.missingModules.empty() || out.tasks.empty())
        out.tasks.insert(out.tasks.begin(), std::move(main));
    for (const TaskSpec& spec : extraTasks) {
        sema::TaskInput task;
        task.name = spec.name;
        task.type = spec.type;
        for (const std::string& input : spec.inputs)
            loader.add(input, task, false);
        out.tasks.push_back(std::move(task));
    }
    out.filesRead = loader.filesRead();
    const auto isEmpty = [](const sema::TaskInput& task) {
        return task.files.empty() && task.missingModules.empty();
    };
    std::erase_if(out.tasks, isEmpty);
    if (sink.errorCount() == errorsBefore && out.tasks.empty()) reportNoModule(out, loader);
    return sink.errorCount() == errorsBefore;
}

} // namespace rapid::project
