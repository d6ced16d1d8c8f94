#pragma once
// Files and folders as the loader sees them: names in any case, modules read once however many tasks have them.

#include "frontend/diag/diagnostic.h"
#include "frontend/project/open_texts.h"
#include "frontend/sema/checker.h"

#include <filesystem>
#include <set>
#include <string>
#include <sys/types.h>
#include <unordered_map>
#include <vector>

namespace rapid::project {

/// ".mod" of "Main.MOD"
std::string extensionOf(const std::filesystem::path& path);
/// .mod .modx .sys .sysx .prg
bool isModule(const std::filesystem::path& path);
bool isFolder(const std::filesystem::path& path);
/// Entries of a folder, sorted by name; empty if it cannot be read.
std::vector<std::filesystem::path> entries(const std::filesystem::path& folder);
/// The entry of `folder` called `name` in any case (Windows made many of these folders); empty if there is none.
std::filesystem::path findEntry(const std::filesystem::path& folder, const std::string& name);
/// The same for "a/b/c.mod" step by step; '\' separates too.
std::filesystem::path findPath(const std::filesystem::path& folder, std::string_view relative);

/// Reads files and reports what cannot be read.
class FileReader {
  public:
    /// `texts`, which may be null, count before the files.
    explicit FileReader(diag::Sink& sink, const OpenTexts* texts = nullptr) : sink_(sink), texts_(texts) {}

    template <size_t N> void report(diag::Message<N> message, diag::MessageArgs<N> args) {
        sink_.report(message, nullptr, {}, args);
    }
    void report(diag::Message<0> message) { sink_.report(message, nullptr, {}); }
    /// The bytes of a file; false when it cannot be read, which is reported.
    bool read(const std::filesystem::path& path, std::string& bytes);
    /// Entries of a folder, sorted by name, open texts included; that it cannot be listed is reported, once.
    std::vector<std::filesystem::path> list(const std::filesystem::path& folder);
    /// Every file that read() was asked for.
    const std::vector<std::string>& filesRead() const { return filesRead_; }
    bool isUnreadable(const std::filesystem::path& folder) const {
        return unreadable_.contains(folder.string());
    }
    /// Adds a module to a task. An encrypted one is opaque: it gets a note and becomes one of the task's missing
    /// modules. A file the task has already is reported and left out.
    void addModule(const std::filesystem::path& path, sema::TaskInput& task);

  private:
    std::shared_ptr<const SourceFile> load(const std::filesystem::path& path);
    bool isKnown(const std::filesystem::path& path, const sema::TaskInput& task);

    diag::Sink& sink_;
    const OpenTexts* texts_;
    std::unordered_map<std::string, std::shared_ptr<const SourceFile>> known_; ///< by path
    std::unordered_map<const sema::TaskInput*, std::set<std::pair<dev_t, ino_t>>> identities_;
    std::set<std::string> unreadable_; ///< folders
    std::vector<std::string> filesRead_;
};

} // namespace rapid::project
