#include "frontend/workspace/workspace.h"

#include "frontend/project/backup.h"
#include "frontend/project/files.h"

#include <algorithm>
#include <filesystem>

namespace rapid::workspace {

namespace fs = std::filesystem;

bool liesIn(const std::string& path, const std::string& folder) {
    return path.starts_with(folder) &&
           (path.size() == folder.size() || folder.ends_with('/') || path[folder.size()] == '/');
}

Workspace::Workspace(const Environment& environment) : environment_(environment) {}
Workspace::~Workspace() = default;

Program* Workspace::make(const std::string& root) {
    auto program = std::make_unique<Program>(root, environment_, texts_);
    program->setWarnings(warnings_);
    programs_.push_back(std::move(program));
    return programs_.back().get();
}

Program* Workspace::rooted(const std::string& root) {
    const auto known = std::find_if(programs_.begin(), programs_.end(),
                                    [&](const auto& program) { return program->root() == root; });
    Program* program = known == programs_.end() ? make(root) : known->get();
    program->update();
    return program;
}

void Workspace::adopt(const std::string& path) {
    if (project::isModule(path)) {
        programOf(path);
        return;
    }
    const std::string type = project::extensionOf(path);
    if (type == ".pgf" || (type == ".cfg" && !ownerOf(path))) rooted(path);
}

void Workspace::setFolders(const std::vector<std::string>& folders) {
    folders_.clear();
    for (const std::string& folder : folders)
        if (std::find(folders_.begin(), folders_.end(), folder) == folders_.end()) folders_.push_back(folder);
    // Programs of single files may belong to a new folder: they are found again when they are asked for.
    std::vector<std::unique_ptr<Program>> known = std::exchange(programs_, {});
    for (const std::string& folder : folders_) {
        const auto kept = std::find_if(known.begin(), known.end(), [&](const auto& program) {
            return program && program->root() == folder;
        });
        if (kept != known.end())
            programs_.push_back(std::move(*kept));
        else
            make(folder);
    }
}

void Workspace::setWarnings(const std::vector<std::string>& warnings) {
    warnings_ = warnings;
    for (const auto& program : programs_)
        program->setWarnings(warnings);
}

std::shared_ptr<const SourceFile> Workspace::read(const std::string& path) const {
    std::string bytes;
    if (!project::readText(&texts_, path, bytes).empty()) return nullptr;
    return std::make_shared<const SourceFile>(path, std::move(bytes));
}

bool Workspace::isRead(const std::string& path) const {
    return std::any_of(programs_.begin(), programs_.end(),
                       [&](const auto& program) { return program->reads(path); });
}

bool Workspace::isInFolders(const std::string& path) const {
    return std::any_of(folders_.begin(), folders_.end(),
                       [&](const std::string& folder) { return liesIn(path, folder); });
}

// Programs that have the file look at it again; those that might have it now, or have it no longer, list their files again.
void Workspace::noteChange(const std::string& path, bool cameOrVanished) {
    const std::string type = project::extensionOf(path);
    const bool matters = project::isModule(path) || type == ".cfg" || type == ".pgf" ||
                         fs::path(path).filename() == project::kSettingsFile ||
                         fs::path(path).filename() == "backinfo.txt";
    for (const auto& program : programs_) {
        program->fileChanged(path);
        if (matters && cameOrVanished &&
            liesIn(path, project::isFolder(program->root())
                             ? program->root()
                             : fs::path(program->root()).parent_path().string()))
            program->reload();
    }
}

void Workspace::setText(const std::string& path, std::string text) {
    std::error_code ignored;
    const bool fresh = !isOpen(path) && !isRead(path) && !fs::exists(path, ignored);
    texts_.set(path, std::move(text));
    noteChange(path, fresh);
}

void Workspace::dropText(const std::string& path) {
    if (!isOpen(path)) return;
    texts_.erase(path);
    std::error_code ignored;
    const bool gone = !fs::exists(path, ignored);
    noteChange(path, gone);
    std::erase_if(programs_,
                  [&](const auto& program) { return !program->isFolder() && program->root() == path; });
}

void Workspace::fileChanged(const std::string& path) {
    std::error_code ignored;
    const bool known = isRead(path);
    const bool exists = fs::exists(path, ignored) || isOpen(path);
    if (project::isFolder(path) ||
        (!exists && !project::isModule(path) && !known)) { // a folder came or vanished
        for (const auto& program : programs_)
            if (liesIn(path, program->root())) program->reload();
        return;
    }
    noteChange(path, exists != known);
}

std::string Workspace::rootFor(const std::string& path) const {
    if (!isInFolders(path)) return path;
    const fs::path folder = fs::path(path).parent_path();
    for (fs::path above = folder; above.has_relative_path() && isInFolders(above.string());
         above = above.parent_path())
        if (project::isBackup(above)) return above.string();
    return folder.string();
}

Program* Workspace::programOf(const std::string& path) {
    if (!project::isModule(path)) return nullptr;
    if (Program* owner = ownerOf(path); owner && owner->hasModule(path)) return owner;
    for (const std::string& root : {rootFor(path), path}) {
        Program* program = rooted(root);
        if (program->hasModule(path)) return program;
    }
    return nullptr; // encrypted, or it vanished
}

Program*
Workspace::programAround(const std::string& path,
                         const std::function<uint32_t(const std::shared_ptr<const SourceFile>&)>& offsetIn) {
    Program* owner = chosenOwner(path);
    const bool othersAreKnown = std::all_of(programs_.begin(), programs_.end(), [&](const auto& program) {
        return program.get() == owner || program->isUpToDate();
    });
    if (owner && othersAreKnown && owner->hasModule(path) && owner->updateAround(path, offsetIn))
        return owner;
    return programOf(path);
}

bool Workspace::isSketched() const {
    return std::any_of(programs_.begin(), programs_.end(),
                       [](const auto& program) { return program->isSketched(); });
}

bool Workspace::isSlowToComplete() const {
    return std::any_of(programs_.begin(), programs_.end(),
                       [](const auto& program) { return program->isSlowToComplete(); });
}

Program* Workspace::programAsAnswered(const std::string& path) const {
    Program* owner = chosenOwner(path);
    return owner && owner->hasModule(path) && !owner->hasChanged() ? owner : nullptr;
}

Program* Workspace::ownerOf(const std::string& path) {
    for (const auto& program : programs_)
        program->update();
    return chosenOwner(path);
}

Program* Workspace::chosenOwner(const std::string& path) const {
    Program* best = nullptr;
    for (const auto& program : programs_) {
        if (!program->isFolder() && program->root() != path) continue; // its files belong to their folders
        if (program->reads(path) && (!best || program->root().size() > best->root().size()))
            best = program.get();
    }
    return best;
}

bool Workspace::bringUpToDate() {
    for (const auto& program : programs_) {
        if (!program->isUpToDate() && interrupted_ && interrupted_()) return false;
        program->update();
    }
    return true;
}

std::vector<Program*> Workspace::programs() {
    std::vector<Program*> found;
    for (const auto& program : programs_) {
        program->update();
        found.push_back(program.get());
    }
    return found;
}

} // namespace rapid::workspace
