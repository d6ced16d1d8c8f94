#pragma once
// A checked program as queries see it: files by path, names by spelling, and indexes that are built when first used.

#include "frontend/query/cancel.h"
#include "frontend/query/global_names.h"
#include "frontend/sema/checked.h"

#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace rapid::query {

/// A file in one task, or a declaration file of the standard library.
struct FileView {
    const syntax::SyntaxTree* tree = nullptr;
    const sema::Task* task = nullptr; ///< null: library
    std::vector<const sema::Module*> modules;
    const sema::FileFacts* facts = nullptr; ///< null when the file has no module
    mutable uint32_t tokenCount = 0;        ///< 0: not counted yet; see tokenCountOf

    const SourceFile& source() const { return *tree->source; }
    std::string_view text() const { return tree->source->text(); }
    bool isLibrary() const { return task == nullptr; }
};

/// A range in a file: a place to go to.
struct Location {
    std::shared_ptr<const SourceFile> file;
    SourceRange range;      ///< of the name
    SourceRange whole;      ///< of the declaration that has the name; `range` where there is none
    bool isLibrary = false; ///< in a declaration file of the standard library, such as "decl/move.sysx"
    bool operator==(const Location& other) const {
        return file && other.file && file->path() == other.file->path() && range == other.range;
    }
};

/// One generation of a program: made again (cheap) after each check, because symbols and trees are replaced then. Trees make
/// parts of plain aggregates when asked, so only one thread at a time may use the snapshots of a program.
class Snapshot {
  public:
    /// `configuration`: the texts of the .cfg files that belong to the program, for places in them. `kept`: the names of the
    /// program's last snapshot, which may not be used any more; null: there was none.
    explicit Snapshot(const sema::CheckedProgram& program,
                      std::vector<std::shared_ptr<const SourceFile>> configuration = {},
                      std::shared_ptr<GlobalNames> kept = nullptr);
    ~Snapshot();
    Snapshot(const Snapshot&) = delete;
    Snapshot& operator=(const Snapshot&) = delete;

    const sema::CheckedProgram& program() const { return program_; }
    std::span<const std::shared_ptr<const SourceFile>> configuration() const { return configuration_; }
    std::span<const std::unique_ptr<FileView>> files() const { return files_; }

    /// The file in the first task that has it; null when there is no such file.
    const FileView* file(std::string_view path) const;
    /// The file in each task that has it.
    std::vector<const FileView*> filesOf(std::string_view path) const;
    const FileView* fileOf(const sema::Module& module) const;

    /// The declarations of modules of the task that all of it sees.
    const NameTable& globals(const sema::Task& task) const;
    /// Whether no two modules of the task declare the same of these.
    bool hasUniqueGlobals(const sema::Task& task) const;
    const NameTable& predefined() const;
    /// Signals, mechanical units and identities of tasks: by folded name.
    const std::map<std::string, const sema::DataSymbol*>& configured() const;
    /// The declaration of a type; null for types that have none.
    const sema::TypeSymbol* symbolOf(const sema::Type& type) const;

  private:
    void addFiles();

    const sema::CheckedProgram& program_;
    std::vector<std::shared_ptr<const SourceFile>> configuration_;
    std::vector<std::unique_ptr<FileView>> files_; ///< those of the library last
    std::unordered_map<const syntax::SyntaxTree*, const FileView*> byTree_;
    std::shared_ptr<GlobalNames> globals_;
    mutable NameTable predefined_;
    mutable std::map<std::string, const sema::DataSymbol*> configured_;
    mutable bool configuredKnown_ = false;
    mutable std::unordered_map<const sema::Type*, const sema::TypeSymbol*> types_;
};

} // namespace rapid::query
