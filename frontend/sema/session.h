#pragma once
// Checks the same tasks again and again while their files change: what an editor needs.

#include "frontend/sema/checker.h"

namespace rapid::sema {

/// Holds the library, the trees of all files and what is known about them. After each change program() and
/// diagnostics() are what check() would give for the files as they are now.
///
/// A changed file is parsed and checked again. Other files are left alone as long as they cannot see the change: the
/// declarations that others see are the same, letter by letter. Otherwise all files of the task are checked again, but
/// not parsed. Messages about undeclared names also depend on the other files: on their LOCAL declarations, on the symbols
/// they use, on how they use such names, and on how much of the limits for suggestions they use up. When one of these changes,
/// all files with such names are checked again. This always happens while the files of a task share reports or signals known by
/// use, or while a file has syntax errors. Files with a message that points into the changed one are checked again, too.
class Session {
  public:
    /// `requireMain` does not count: what is being written need not run.
    explicit Session(const CheckOptions& options);
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    /// Takes other tasks or other lists of files; everything is parsed and checked.
    void open(std::vector<TaskInput> tasks);
    /// Takes another text (a SourceFile not used here before) for the file of the same path, in every task that has it. False: no task has such a file.
    bool change(const std::shared_ptr<const SourceFile>& file);

    /// As change(), for an answer about `offset` that cannot wait: of the file all declarations are known then, but bodies of
    /// routines only around the offset, and diagnostics() are those of before. Where others can see the change, everything is
    /// checked at once in a small program; in a large one other files are as the last check has left them. So are the files of
    /// further tasks that have this one. False: no task has such a text, use change().
    bool sketch(const std::shared_ptr<const SourceFile>& file, uint32_t offset);
    /// From how many bytes beside the file on, in all its tasks, sketch() counts what a change concerns as large.
    void setLargeFrom(size_t bytes);
    /// Checks what sketch() has left out. Nothing, when that is nothing.
    void complete();
    bool isComplete() const;
    /// Whether complete() would check files of such a size.
    bool isSlowToComplete() const;

    /// Names in the module `guest` of any task mean from now on what they mean in the module `host`, its LOCAL declarations
    /// included. For texts that are looked at as if they stood in the host, such as the expressions of a debugger. Before the
    /// change() that brings the text.
    void setGuest(const std::string& guest, const std::string& host);

    /// Symbols, trees and facts of changed files are replaced by change(): keep no pointers to them.
    const CheckedProgram& program() const;
    /// Sorted as those of a Sink.
    std::vector<diag::Diagnostic> diagnostics() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace rapid::sema
