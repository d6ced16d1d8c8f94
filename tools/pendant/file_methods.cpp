// files.*, program.*, backup.*: what is in the volumes of the controller.

#include "config/atomic_file.h"
#include "config/json_text.h"
#include "config/letter_case.h"
#include "config/read_file.h"
#include "frontend/project/backup.h"
#include "frontend/project/program_file.h"
#include "tools/pendant/areas.h"
#include "tools/pendant/hub.h"
#include "tools/pendant/support.h"
#include "tools/rws/module_text.h"
#include "tools/rws/rapid_support.h"
#include "tools/service/backup_writer.h"
#include "tools/service/file_volumes.h"

#include <filesystem>
#include <fmt/format.h>

namespace rapidc::pendant {

namespace {

namespace fs = std::filesystem;
using service::FileProblem;

constexpr std::size_t kMostEntries = 5000; // of a folder

[[noreturn]] void fail(const service::FileResult& result) {
    switch (result.problem) {
    case FileProblem::NoPath: notFound(result.text);
    case FileProblem::Outside: badRequest(result.text);
    default: throw RequestError{code::kFailed, result.text};
    }
}

std::string programFile(const std::vector<std::string>& files) {
    std::string text = "<?xml version=\"1.0\" encoding=\"ISO-8859-1\" ?>\n<Program>\n";
    for (const std::string& file : files)
        text += "\t<Module>" + file + "</Module>\n";
    return text + "</Program>\n";
}

class FileArea final : public Area {
  public:
    explicit FileArea(const Context& context)
        : controller_(context.controller), configuration_(context.configuration), volumes_(context.volumes) {}

    void addTo(MethodTable& methods) override {
        methods.addOnDisk("files.list", [this](Client&, const Json& params) {
            return [this, folder = textOr(params, "folder", "")] { return list(folder); };
        });
        methods.add("program.save", [this](Client&, const Json& params) { return saveProgram(params); });
        methods.add("program.load", [this](Client&, const Json& params) { return loadProgram(params); });
        methods.addOnDisk("backup.create", [this](Client&, const Json& params) { return backup(params); });
        methods.add("backup.restore", [this](Client&, const Json& params) { return restore(params); });
    }

  private:
    Json list(const std::string& folder) const;
    Json saveProgram(const Json& params);
    Json loadProgram(const Json& params);
    DiskWork backup(const Json& params);
    Json restore(const Json& params);

    service::VirtualController& controller_;
    const service::ConfigurationStore& configuration_;
    const service::FileVolumes& volumes_;
};

/// On a worker thread.
Json FileArea::list(const std::string& folder) const {
    Json entries = Json::array();
    if (folder.empty()) {
        for (const std::string& name : volumes_.names())
            entries.push_back({{"name", name + ":"}, {"folder", true}, {"size", 0}, {"modified", 0}});
        return {{"entries", std::move(entries)}};
    }
    std::string path = folder; // "HOME:/part" as "HOME/part"
    if (const std::size_t colon = path.find(':'); colon != std::string::npos) path.erase(colon, 1);
    while (path.size() > 1 && path.ends_with('/'))
        path.pop_back();
    std::vector<service::FileEntry> found;
    if (const service::FileResult result = volumes_.list(path, found); !result.isDone()) fail(result);
    for (const service::FileEntry& entry : found) {
        if (entries.size() >= kMostEntries) break;
        entries.push_back({{"name", entry.name},
                           {"folder", entry.isFolder},
                           {"size", entry.size},
                           {"modified", entry.modified}});
    }
    return {{"entries", std::move(entries)}};
}

/// Into a folder, which may not exist yet: each program module, and NAME.pgf.
Json FileArea::saveProgram(const Json& params) {
    const rt::Task& task = taskOf(controller_, params);
    const HostFile folder = fileOf(controller_, params, "folder");
    std::error_code error;
    fs::create_directories(folder.host, error);
    if (!fs::is_directory(folder.host, error))
        throw RequestError{code::kFailed, fmt::format("{} is not a folder", folder.rapid)};
    std::vector<std::string> files;
    for (const rt::LoadedModule& module : controller_.core().tables().modules()) {
        std::string text;
        if (module.task != static_cast<int32_t>(task.index()) ||
            !controller_.moduleText(task, module.name, text))
            continue;
        if (rws::isSystemModule(text, module.name)) continue;
        files.push_back(module.name + ".modx");
        const std::string file = (fs::path(folder.host) / files.back()).string();
        if (const std::string problem = rws::saveModule(controller_.core(), task, module, text, file);
            !problem.empty())
            throw RequestError{code::kFailed, fmt::format("{} cannot be written: {}", files.back(), problem)};
    }
    const std::string name = textOr(params, "name", controller_.core().program().name);
    if (!service::isPlainFileName(name))
        badRequest(fmt::format("{} is not a name that a file may have", name));
    const std::string file = (fs::path(folder.host) / (name + ".pgf")).string();
    if (const std::string problem = rapid::config::replaceFile(file, programFile(files)); !problem.empty())
        throw RequestError{code::kFailed, fmt::format("{}.pgf cannot be written: {}", name, problem)};
    return {{"path", fmt::format("{}/{}.pgf", folder.rapid, name)}};
}

Json FileArea::loadProgram(const Json& params) {
    rt::Task& task = taskOf(controller_, params);
    const HostFile file = fileOf(controller_, params, "path");
    std::string text;
    std::vector<std::string> names, files;
    if (!rapid::config::readFile(file.host, text).empty())
        notFound(fmt::format("There is no file {}", file.rapid));
    if (!rapid::project::readProgramFile(text, names))
        badRequest(fmt::format("{} is not a program file", file.rapid), "Choose a file that ends in .pgf");
    const std::string folder = fs::path(file.rapid).parent_path().string();
    for (const std::string& name : names) {
        const auto module = rws::volumePath(controller_, folder + "/" + name);
        std::error_code error;
        if (!module || !fs::is_regular_file(module->host, error))
            notFound(fmt::format("There is no file {} beside the program", name));
        files.push_back(module->host);
    }
    const std::string refusal = controller_.loadProgram(task, files, true);
    if (refusal.find('\n') != std::string::npos) badRequest(refusal);
    refuseUnless(refusal);
    return {};
}

/// The content is taken now; a worker writes it, so that programs do not wait for the disk.
DiskWork FileArea::backup(const Json& params) {
    const std::string name = textOf(params, "name");
    if (!service::isPlainFileName(name))
        badRequest(fmt::format("{} is not a name that a folder may have", name));
    std::string host;
    if (const service::FileResult found = volumes_.hostPath("BACKUP/" + name, host); !found.isDone())
        fail(found);
    std::error_code error;
    if (fs::exists(fs::symlink_status(host, error)))
        throw RequestError{code::kRefused, fmt::format("BACKUP:/{} exists already", name),
                           "Choose another name"};
    auto content =
        std::make_shared<const service::BackupContent>(service::takeBackup(controller_, configuration_));
    return [content, host, name] {
        if (const std::string problem = service::writeBackup(*content, host); !problem.empty())
            throw RequestError{code::kFailed, fmt::format("The backup was not written: {}", problem)};
        return Json{{"path", "BACKUP:/" + name}};
    };
}

Json FileArea::restore(const Json& params) {
    const std::string name = textOf(params, "name");
    std::string host;
    if (!service::isPlainFileName(name))
        badRequest(fmt::format("{} is not a name that a folder may have", name));
    if (const service::FileResult found = volumes_.hostPath("BACKUP/" + name, host); !found.isDone())
        fail(found);
    if (!rapid::project::isBackup(host)) notFound(fmt::format("BACKUP:/{} is not a backup", name));
    refuseUnless(controller_.restore(host));
    return {};
}

} // namespace

std::unique_ptr<Area> makeFileArea(const Context& context) {
    return std::make_unique<FileArea>(context);
}

} // namespace rapidc::pendant
