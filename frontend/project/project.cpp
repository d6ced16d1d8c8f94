#include "frontend/project/project.h"

#include "frontend/project/program_file.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <set>
#include <sys/stat.h>

namespace rapid::project {

namespace fs = std::filesystem;
using diag::Code;

namespace {

std::string extensionOf(const fs::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

bool isModule(const fs::path& path) {
    const std::string e = extensionOf(path);
    return e == ".mod" || e == ".modx" || e == ".sys" || e == ".sysx" || e == ".prg";
}

bool sameName(const std::string& a, const std::string& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

/// Entries of a folder, sorted by name; empty if it cannot be read.
std::vector<fs::path> entries(const fs::path& folder) {
    std::vector<fs::path> found;
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
        found.push_back(it->path());
    std::sort(found.begin(), found.end());
    return found;
}

bool isFolder(const fs::path& path) {
    std::error_code error;
    return fs::is_directory(path, error);
}

/// The entry of `folder` called `name` in any case: Windows made many of these folders.
fs::path findEntry(const fs::path& folder, const std::string& name) {
    std::error_code error;
    if (fs::exists(folder / name, error)) return folder / name;
    for (const fs::path& path : entries(folder))
        if (sameName(path.filename().string(), name)) return path;
    return {};
}

class Loader {
  public:
    Loader(ProjectInput& out, diag::Sink& sink) : out_(out), sink_(sink) {}

    /// Adds what `input` names to `task`. A backup adds tasks of its own and leaves `task` alone.
    void add(const std::string& input, sema::TaskInput& task, bool allowBackup) {
        const fs::path path(input);
        std::error_code error;
        if (!fs::exists(path, error)) {
            report(Code::FileNotFound, {input});
        } else if (isFolder(path)) {
            if (allowBackup && isFolder(findEntry(path, "RAPID")))
                addBackup(path);
            else
                addFolder(path, task);
        } else if (isModule(path)) {
            addModule(path, task);
        } else if (extensionOf(path) == ".pgf") {
            addProgram(path, task);
        } else if (extensionOf(path) == ".cfg") {
            out_.configFiles.push_back(input);
        } else {
            report(Code::NotAModule, {input});
        }
    }

    void report(Code code, std::initializer_list<std::string> args) { sink_.report(code, nullptr, {}, args); }
    std::vector<sema::TaskInput> takeBackupTasks() { return std::move(backupTasks_); }

  private:
    bool read(const fs::path& path, std::string& bytes) {
        errno = 0;
        std::FILE* file = std::fopen(path.c_str(), "rb");
        bool good = file != nullptr;
        if (file) {
            std::error_code unknown;
            const auto size = fs::file_size(path, unknown);
            constexpr size_t kStep = size_t{1} << 16;
            size_t length = 0;
            do { // one byte more than expected shows the end; a growing file is read to its end all the same
                bytes.resize(length + (length == 0 && !unknown ? static_cast<size_t>(size) + 1 : kStep));
                length += std::fread(bytes.data() + length, 1, bytes.size() - length, file);
            } while (length == bytes.size());
            bytes.resize(length);
            good = std::ferror(file) == 0;
            std::fclose(file);
        }
        if (!good)
            report(Code::FileUnreadable, {path.string(), errno ? std::strerror(errno) : "reading failed"});
        return good;
    }

    /// Whether the file, under whatever name, belongs to the task already.
    bool isKnown(const fs::path& path, const sema::TaskInput& task) {
        if (task.files.empty()) identities_.clear(); // a new task
        struct stat status{};
        return ::stat(path.c_str(), &status) == 0 &&
               !identities_.insert({status.st_dev, status.st_ino}).second;
    }

    void addModule(const fs::path& path, sema::TaskInput& task) {
        if (isKnown(path, task)) {
            report(Code::SameFileTwice, {path.string()});
            return;
        }
        std::string bytes;
        if (read(path, bytes))
            task.files.push_back(std::make_shared<const SourceFile>(path.string(), std::move(bytes)));
    }

    size_t addFiles(const fs::path& folder, sema::TaskInput& task) {
        size_t modules = 0;
        for (const fs::path& path : entries(folder)) {
            if (isFolder(path)) continue;
            if (isModule(path)) {
                addModule(path, task);
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
            for (const fs::path& path : entries(folder))
                if (isFolder(path) && !sameName(path.filename().string(), "SYSPAR"))
                    modules += addFiles(path, task);
        if (modules == 0) report(Code::FolderWithoutModules, {folder.string()});
    }

    void addParameters(const fs::path& folder) {
        for (const fs::path& path : entries(findEntry(folder, "SYSPAR")))
            if (extensionOf(path) == ".cfg") out_.configFiles.push_back(path.string());
    }

    void addProgram(const fs::path& path, sema::TaskInput& task) {
        std::string text;
        if (!read(path, text)) return;
        std::vector<std::string> modules;
        if (!readProgramFile(text, modules)) {
            report(Code::BadProgramFile,
                   {path.string(), "it is not an XML program description of a controller"});
            return;
        }
        if (modules.empty()) report(Code::BadProgramFile, {path.string(), "it names no modules"});
        for (const std::string& name : modules) {
            const fs::path module = path.parent_path() / name;
            const fs::path found = findEntry(module.parent_path().empty() ? "." : module.parent_path(),
                                             module.filename().string());
            if (found.empty())
                report(Code::ProgramModuleMissing, {path.string(), name});
            else
                addModule(module.parent_path().empty() ? found.filename() : found, task);
        }
        addParameters(path.parent_path().empty() ? "." : path.parent_path());
    }

    // RAPID/TASKn/{PROGMOD,SYSMOD}, named by BACKINFO/backinfo.txt, typed by CAB_TASKS in SYSPAR/SYS.cfg.
    void addBackup(const fs::path& folder) {
        std::vector<BackupTask> names;
        std::vector<ConfiguredTask> configured;
        std::string text;
        if (const fs::path info = findEntry(findEntry(folder, "BACKINFO"), "backinfo.txt"); !info.empty())
            if (read(info, text)) names = readBackupTasks(text);
        if (const fs::path sys = findEntry(findEntry(folder, "SYSPAR"), "SYS.cfg"); !sys.empty())
            if (read(sys, text)) configured = readConfiguredTasks(text);
        addParameters(folder);
        size_t modules = 0;
        for (const fs::path& path : entries(findEntry(folder, "RAPID"))) {
            const std::string name = path.filename().string();
            if (!isFolder(path) || !sameName(name.substr(0, 4), "TASK") || sameName(name, "TASK0")) continue;
            sema::TaskInput task;
            task.name = name;
            for (const BackupTask& listed : names)
                if (sameName(listed.folder, name)) task.name = listed.name;
            for (const ConfiguredTask& one : configured) {
                if (!sameName(one.name, task.name)) continue;
                task.type = one.type;
                task.entry = one.entry;
            }
            for (const char* part : {"PROGMOD", "SYSMOD"})
                addFiles(findEntry(path, part), task);
            leaveOutEncrypted(task);
            modules += task.files.size();
            if (!task.files.empty()) backupTasks_.push_back(std::move(task));
        }
        if (modules == 0) report(Code::FolderWithoutModules, {folder.string()});
    }

    // Production backups often hold encrypted system modules: nobody but the controller can read them.
    void leaveOutEncrypted(sema::TaskInput& task) {
        std::erase_if(task.files, [&](const std::shared_ptr<const SourceFile>& file) {
            if (!file->isBinary()) return false;
            report(Code::EncryptedModule, {file->path()});
            task.incomplete = true;
            return true;
        });
    }

    ProjectInput& out_;
    diag::Sink& sink_;
    std::vector<sema::TaskInput> backupTasks_;
    std::set<std::pair<dev_t, ino_t>> identities_; ///< files of the task that is being filled
};

} // namespace

bool loadProject(const std::vector<std::string>& inputs, const std::vector<TaskSpec>& extraTasks,
                 ProjectInput& out, diag::Sink& sink) {
    const size_t errorsBefore = sink.errorCount();
    Loader loader(out, sink);
    sema::TaskInput main;
    for (const std::string& input : inputs)
        loader.add(input, main, true);
    std::vector<sema::TaskInput> tasks = loader.takeBackupTasks();
    if (!main.files.empty() || tasks.empty()) tasks.insert(tasks.begin(), std::move(main));
    for (const TaskSpec& spec : extraTasks) {
        sema::TaskInput task;
        task.name = spec.name;
        task.type = spec.type;
        loader.add(spec.input, task, false);
        tasks.push_back(std::move(task));
    }
    const bool failed = sink.errorCount() > errorsBefore;
    if (!failed && tasks.front().files.empty()) loader.report(Code::NoInput, {});
    std::erase_if(tasks, [](const sema::TaskInput& task) { return task.files.empty(); });
    for (sema::TaskInput& task : tasks)
        out.tasks.push_back(std::move(task));
    return sink.errorCount() == errorsBefore;
}

} // namespace rapid::project
