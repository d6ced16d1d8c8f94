#pragma once
// Workspace: folders and files of an editor as programs. Files on disk and in memory, added, changed, removed, renamed.
//
// A workspace folder is one program, as `rapidc check FOLDER` judges it; two folders are two programs. A module that no
// folder's program has belongs to the backup around it, else to the folder it lies in when that is inside a workspace
// folder, else it is a program by itself.
//
// For one thread at a time. Changes are noted at once; programs take them in when they are asked for.

#include "frontend/workspace/program.h"

#include <functional>

namespace rapid::workspace {

class Workspace {
  public:
    /// The environment has to outlive the workspace.
    explicit Workspace(const Environment& environment);
    ~Workspace();
    Workspace(const Workspace&) = delete;
    Workspace& operator=(const Workspace&) = delete;

    /// Absolute paths. Programs of folders that are no longer among them are forgotten.
    void setFolders(const std::vector<std::string>& folders);
    const std::vector<std::string>& folders() const { return folders_; }
    /// Options as those of -W, for all programs.
    void setWarnings(const std::vector<std::string>& warnings);

    /// The text of a file counts from now on, whether there is such a file or not. `path` is absolute and normal.
    void setText(const std::string& path, std::string text);
    /// The file on disk counts again.
    void dropText(const std::string& path);
    bool isOpen(const std::string& path) const { return texts_.find(path) != nullptr; }
    /// The text of a file, open or on disk; null when it cannot be read.
    std::shared_ptr<const SourceFile> read(const std::string& path) const;
    const project::OpenTexts& texts() const { return texts_; }
    /// A file on disk came, changed or vanished.
    void fileChanged(const std::string& path);

    /// The program that a module belongs to, up to date; null when the path is not a module. The modules of no folder get a program
    /// of their own here.
    Program* programOf(const std::string& path);
    /// The same for an answer at a place in the module that cannot wait: see Program::updateAround.
    Program* programAround(const std::string& path,
                           const std::function<uint32_t(const std::shared_ptr<const SourceFile>&)>& offsetIn);
    /// Whether the last answer of that kind has left something to check.
    bool isSketched() const;
    /// Whether that takes long.
    bool isSlowToComplete() const;
    /// The program that a module belonged to at the last answer of any kind, with what that has left to check; null: it has to be
    /// asked for by programOf, because something has changed since.
    Program* programAsAnswered(const std::string& path) const;
    /// Gives an open file that no program reads one of its own, if it is a module, a program file or a configuration. A program
    /// file always gets one.
    void adopt(const std::string& path);
    /// The program that owns what is said about a file of any kind, up to date; null if none reads it.
    Program* ownerOf(const std::string& path);
    /// Takes in all changes. False: `interrupted` (setInterrupted) has ended that early.
    bool bringUpToDate();
    /// All programs, folders first, up to date.
    std::vector<Program*> programs();
    /// Asked between programs while all are brought up to date.
    void setInterrupted(std::function<bool()> interrupted) { interrupted_ = std::move(interrupted); }

  private:
    Program* make(const std::string& root);
    Program* rooted(const std::string& root);
    Program* chosenOwner(const std::string& path) const;
    std::string rootFor(const std::string& path) const;
    bool isRead(const std::string& path) const;
    bool isInFolders(const std::string& path) const;
    void noteChange(const std::string& path, bool cameOrVanished);

    const Environment& environment_;
    project::OpenTexts texts_;
    std::vector<std::string> folders_;
    std::vector<std::string> warnings_;
    std::vector<std::unique_ptr<Program>> programs_; ///< those of folders first
    std::function<bool()> interrupted_;
};

/// Whether `path` is `folder` or lies in it.
bool liesIn(const std::string& path, const std::string& folder);

} // namespace rapid::workspace
