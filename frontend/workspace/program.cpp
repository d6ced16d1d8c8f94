#include "frontend/workspace/program.h"

#include "frontend/project/files.h"
#include "frontend/project/neighbours.h"
#include "frontend/workspace/judge.h"

#include <atomic>
#include <filesystem>

namespace rapid::workspace {

namespace fs = std::filesystem;

Program::Program(std::string root, const Environment& environment, const project::OpenTexts& texts)
    : root_(std::move(root)), environment_(environment), texts_(texts), isFolder_(project::isFolder(root_)) {}

Program::~Program() = default;

void Program::setWarnings(const std::vector<std::string>& warnings) {
    if (warnings_ == warnings) return;
    warnings_ = warnings;
    stale_ = true;
}

void Program::fileChanged(const std::string& path) {
    if (modules_.contains(path))
        changed_[path] = true;
    else if (others_.contains(path))
        stale_ = true;
}

bool Program::update() {
    if (stale_)
        load();
    else if (!changed_.empty())
        takeChanges();
    else
        return false;
    judge();
    static std::atomic<uint64_t> last = 0;
    generation_ = ++last;
    return true;
}

void Program::load() {
    isFolder_ = project::isFolder(root_);
    Inputs inputs;
    inputs.paths = {root_};
    inputs.warnings = warnings_;
    inputs.lint = true;
    inputs.onlyDiagnostics = true; // the controller's opinion of signals is wanted
    inputs.texts = &texts_;
    loaded_ = loadInputs(inputs, environment_);
    if (!loaded_->loaded) { // options that cannot be read: without them
        std::vector<std::string> problems = std::move(loaded_->usageErrors);
        inputs.warnings.clear();
        for (const std::string& option : warnings_) {
            lint::WarningLevels levels;
            std::string problem;
            if (lint::applyOption(option, levels, problem)) inputs.warnings.push_back(option);
        }
        loaded_ = loadInputs(inputs, environment_);
        loaded_->usageErrors.insert(loaded_->usageErrors.begin(), problems.begin(), problems.end());
    }
    loading_ = loaded_->sink.take();
    session_ = std::make_unique<sema::Session>(loaded_->options);
    session_->open(loaded_->tasks);
    listFiles();
    changed_.clear();
    stale_ = false;
}

void Program::listFiles() {
    modules_.clear();
    others_.clear();
    for (const sema::TaskInput& task : loaded_->tasks)
        for (const auto& file : task.files)
            modules_[file->path()] = file;
    for (const std::string& path : loaded_->filesRead) {
        std::error_code ignored;
        const std::string normal = fs::absolute(path, ignored).lexically_normal().string();
        if (!path.empty() && !modules_.contains(normal)) others_[normal] = path;
    }
}

// Several changes of one file count once; a file that vanished, or is encrypted now, changes the list of files.
void Program::takeChanges() {
    for (const auto& [path, yes] : std::exchange(changed_, {})) {
        std::string bytes;
        if (!project::readText(&texts_, path, bytes).empty()) return load();
        const auto file = std::make_shared<const SourceFile>(path, std::move(bytes));
        if (file->isEncrypted()) return load();
        if (file->text() == modules_[path]->text() && file->encoding() == modules_[path]->encoding())
            continue;
        modules_[path] = file;
        for (sema::TaskInput& task : loaded_->tasks)
            for (auto& known : task.files)
                if (known->path() == path) known = file;
        session_->change(file);
    }
}

void Program::judge() {
    diag::Sink sink;
    sink.add(loading_);
    sink.add(session_->diagnostics());
    Judge judge(*loaded_, environment_, sink);
    judge.files(session_->program());
    judge.finish(session_->program(), loaded_->tasks);
    if (!isFolder_) project::noteNeighbours(sink, {root_});
    diagnostics_ = sink.sorted();
}

bool Program::reads(const std::string& path) const {
    return modules_.contains(path) || others_.contains(path);
}

bool Program::hasModule(const std::string& path) const {
    return modules_.contains(path);
}

std::vector<FileInTask> Program::find(const std::string& path) const {
    std::vector<FileInTask> found;
    for (const auto& task : session_->program().tasks) {
        FileInTask file{task.get(), {}};
        for (const sema::Module* module : task->modules)
            if (module->tree->source->path() == path) file.modules.push_back(module);
        if (!file.modules.empty()) found.push_back(std::move(file));
    }
    return found;
}

const syntax::SyntaxTree* Program::tree(const std::string& path) const {
    for (const auto& tree : session_->program().trees)
        if (tree->source->path() == path) return tree.get();
    return nullptr;
}

} // namespace rapid::workspace
