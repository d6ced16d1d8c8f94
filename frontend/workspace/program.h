#pragma once
// Program: what `rapidc check ROOT` judges, kept up to date while its files change.

#include "frontend/sema/session.h"
#include "frontend/workspace/compilation.h"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace rapid::workspace {

/// A file of a program as one of its tasks sees it.
struct FileInTask {
    const sema::Task* task = nullptr;
    std::vector<const sema::Module*> modules; ///< those that the file declares
};

/// Changes are noted at once and cost nothing; update() takes them in. Everything that the other members hand out is good
/// until the next update().
class Program {
  public:
    /// `root`: a folder, a module, a program file or a backup, as an absolute normal path. `texts` count before the files;
    /// both references have to outlive the program.
    Program(std::string root, const Environment& environment, const project::OpenTexts& texts);
    ~Program();
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    const std::string& root() const { return root_; }
    bool isFolder() const { return isFolder_; }
    /// Options as those of -W, for the whole program.
    void setWarnings(const std::vector<std::string>& warnings);
    /// The text of a file changed, in memory or on disk. Files that are not part of the program are ignored.
    void fileChanged(const std::string& path);
    /// Files came or vanished, or a configuration changed: everything is loaded again.
    void reload() { stale_ = true; }
    /// Takes in what has changed. False when that is nothing.
    bool update();
    /// Takes in a change of the text of one module for an answer at a place in it that cannot wait. `offsetIn` gives the place
    /// in the new text. Bodies of routines elsewhere in the module, and in a large program other modules that can see the
    /// change, are checked by the next update(). False: nothing was done,
    /// call update().
    bool updateAround(const std::string& path,
                      const std::function<uint32_t(const std::shared_ptr<const SourceFile>&)>& offsetIn);
    /// Whether a change has been noted since the last update() or updateAround().
    bool hasChanged() const { return stale_ || !changed_.empty(); }
    /// Whether updateAround() has left something to check.
    bool isSketched() const { return session_ && !session_->isComplete(); }
    /// Whether that is all of a large program.
    bool isSlowToComplete() const { return session_ && session_->isSlowToComplete(); }
    bool isUpToDate() const { return !hasChanged() && session_->isComplete(); }

    /// Of the last update that changed something; no two updates of any programs have the same.
    uint64_t generation() const { return generation_; }
    /// Trees, symbols and facts of all tasks; of files with mistakes as well.
    const sema::CheckedProgram& checked() const { return session_->program(); }
    /// The inputs beside the modules: options of the check, configuration texts, problems with options. Its `program` is
    /// empty and its `tasks` are the files as they are now.
    const Compilation& loaded() const { return *loaded_; }
    /// As `rapidc check` reports them, sorted by file and place. Takes a look at the whole program when something has changed
    /// since the last time.
    const std::vector<diag::Diagnostic>& diagnostics();
    /// Whether diagnostics() would take long: a program of some 100,000 lines.
    bool isSlowToJudge() const;
    /// The same for one module without that look: messages of the check are those of now, warnings of 8xxx those of the last
    /// look as far as their places are still there.
    std::vector<diag::Diagnostic> quickDiagnostics(const std::string& path) const;

    /// Whether a path is a module, a configuration or another file that was read for the program.
    bool reads(const std::string& path) const;
    /// Whether it is one of the modules.
    bool hasModule(const std::string& path) const;
    /// The tasks that have this module; empty if none has.
    std::vector<FileInTask> find(const std::string& path) const;
    /// The tree of a module as it is now; null if no task has it.
    const syntax::SyntaxTree* tree(const std::string& path) const;

  private:
    void load();
    void takeChanges();
    std::shared_ptr<const SourceFile> readChanged(const std::string& path) const;
    void takeText(const std::shared_ptr<const SourceFile>& file);
    bool isSameText(const SourceFile& file) const;
    void newGeneration();
    void judge();
    void keepJudgement();
    void moveJudgement(const SourceFile& before, const std::shared_ptr<const SourceFile>& now);
    void listFiles();

    std::string root_;
    const Environment& environment_;
    const project::OpenTexts& texts_;
    std::vector<std::string> warnings_;
    std::unique_ptr<Compilation> loaded_;
    std::unique_ptr<sema::Session> session_;
    std::vector<diag::Diagnostic> loading_; ///< what was wrong before the check
    std::vector<diag::Diagnostic> diagnostics_;
    std::map<std::string, std::vector<diag::Diagnostic>> judgement_; ///< what judge() has added, by path
    uint64_t judged_ = 0;                                            ///< generation of `diagnostics_`
    double judgeMilliseconds_ = 0;                                   ///< what the last look took
    std::map<std::string, std::shared_ptr<const SourceFile>, std::less<>> modules_; ///< by path
    std::map<std::string, std::string> others_; ///< configurations, settings ... by path
    std::set<std::string> changed_;             ///< paths of modules
    uint64_t generation_ = 0;
    bool stale_ = true;
    bool isFolder_ = false;
};

} // namespace rapid::workspace
