#include "frontend/workspace/program.h"

#include "frontend/diag/messages/lowering.h"
#include "frontend/diag/messages/warnings.h"
#include "frontend/project/files.h"
#include "frontend/project/neighbours.h"
#include "frontend/source/same_ends.h"
#include "frontend/workspace/judge.h"

#include <atomic>
#include <chrono>
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
        changed_.insert(path);
    else if (others_.contains(path))
        stale_ = true;
}

bool Program::update() {
    if (isUpToDate()) return false;
    if (stale_)
        load();
    else
        takeChanges();
    newGeneration();
    return true;
}

bool Program::updateAround(
    const std::string& path,
    const std::function<uint32_t(const std::shared_ptr<const SourceFile>&)>& offsetIn) {
    if (stale_ || changed_.size() != 1 || !changed_.contains(path)) return false;
    const auto file = readChanged(path);
    if (!file || isSameText(*file) || !session_->sketch(file, offsetIn(file))) return false;
    changed_.clear();
    takeText(file);
    newGeneration();
    return true;
}

void Program::newGeneration() {
    static std::atomic<uint64_t> last = 0;
    generation_ = ++last;
}

void Program::load() {
    isFolder_ = project::isFolder(root_);
    Inputs inputs;
    inputs.paths = {root_};
    inputs.warnings = warnings_;
    inputs.lint = true;
    inputs.documented = true;
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
    judgement_.clear();
    judged_ = 0;
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
// Null: it is not a text any more, so that everything has to be loaded again.
std::shared_ptr<const SourceFile> Program::readChanged(const std::string& path) const {
    std::string bytes;
    if (!project::readText(&texts_, path, bytes).empty()) return nullptr;
    auto file = std::make_shared<const SourceFile>(path, std::move(bytes));
    return file->isEncrypted() ? nullptr : file;
}

bool Program::isSameText(const SourceFile& file) const {
    const SourceFile& known = *modules_.at(file.path());
    return file.text() == known.text() && file.encoding() == known.encoding();
}

void Program::takeText(const std::shared_ptr<const SourceFile>& file) {
    std::shared_ptr<const SourceFile>& module = modules_.at(file->path());
    moveJudgement(*module, file);
    module = file;
    for (sema::TaskInput& task : loaded_->tasks)
        for (auto& known : task.files)
            if (known->path() == file->path()) known = file;
}

void Program::takeChanges() {
    for (const std::string& path : std::exchange(changed_, {})) {
        const auto file = readChanged(path);
        if (!file) return load();
        if (isSameText(*file)) continue;
        takeText(file);
        session_->change(file);
    }
    session_->complete();
}

const std::vector<diag::Diagnostic>& Program::diagnostics() {
    if (judged_ == generation_) return diagnostics_;
    const auto start = std::chrono::steady_clock::now();
    judge();
    keepJudgement();
    judged_ = generation_;
    judgeMilliseconds_ =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return diagnostics_;
}

bool Program::isSlowToJudge() const {
    constexpr double kSlow = 20;
    constexpr size_t kLarge = size_t{2} << 20; // bytes
    if (judged_ == generation_) return false;
    if (judged_ != 0) return judgeMilliseconds_ > kSlow;
    size_t size = 0;
    for (const auto& [path, file] : modules_)
        size += file->text().size();
    return size > kLarge;
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

namespace {
/// Reports that the check itself never makes.
bool isOfJudge(const diag::Diagnostic& d) {
    return d.code == diag::say::BuiltinNotImplemented.code || d.code == diag::say::BadDirective.code ||
           d.code == diag::say::UnknownWarning.code || static_cast<int>(d.code) / 1000 == 8;
}
} // namespace

void Program::keepJudgement() {
    judgement_.clear();
    for (const diag::Diagnostic& d : diagnostics_)
        if (d.file && isOfJudge(d) && modules_.contains(d.file->path()))
            judgement_[d.file->path()].push_back(d);
}

// Places before and after the edit are known; what it touches is left out, and so is what points to other places.
void Program::moveJudgement(const SourceFile& before, const std::shared_ptr<const SourceFile>& now) {
    const auto found = judgement_.find(now->path());
    if (found == judgement_.end()) return;
    const auto [head, tail] = sameEnds(before.text(), now->text());
    const auto shift = static_cast<uint32_t>(now->text().size() - before.text().size()); // modulo 2^32
    std::vector<diag::Diagnostic> moved;
    for (diag::Diagnostic& d : found->second) {
        const bool above = d.range.end <= head, below = d.range.begin >= before.text().size() - tail;
        if (!above && !below) continue;
        if (below) d.range = {d.range.begin + shift, d.range.end + shift};
        d.file = now;
        d.notes.clear();
        d.fixes.clear();
        moved.push_back(std::move(d));
    }
    found->second = std::move(moved);
}

std::vector<diag::Diagnostic> Program::quickDiagnostics(const std::string& path) const {
    diag::Sink sink;
    for (const auto& all : {loading_, session_->diagnostics()})
        for (const diag::Diagnostic& d : all)
            if (d.file && d.file->path() == path) sink.add(std::span(&d, 1));
    lint::applyLevels(loaded_->warningLevels, sink);
    if (const auto kept = judgement_.find(path); kept != judgement_.end()) sink.add(kept->second);
    return sink.sorted();
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
