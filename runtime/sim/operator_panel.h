#pragma once
// OperatorPanel: what the person at the FlexPendant sees and answers. TPWrite lines go to stdout; dialogs
// (texts and answers) to stderr. Answers come from the stimulus, otherwise from the terminal.

#include "runtime/sched/task.h"
#include "runtime/sched/wait_queue.h"

#include <chrono>
#include <cstdio>
#include <deque>
#include <functional>
#include <string>
#include <vector>

namespace rt {

/// A question to the operator.
struct Dialog {
    std::string header;             ///< may be empty
    std::vector<std::string> lines; ///< the text
    std::vector<std::string>
        choices;            ///< keys, buttons or list items, numbered from 1; empty entries are not shown
    Time deadline = kNever; ///< absolute (\MaxTime)
    /// Ends the dialog early (\DIBreak, \PersBoolBreak); looked at when one of `breakQueues` is notified.
    std::function<bool()> broken;
    std::vector<WaitQueue*> breakQueues;
    /// Looked at this often when not 0 (for conditions that no queue tells of).
    Time pollPeriod = 0;
};

enum class DialogEnd : uint8_t {
    Answered,
    Timeout,  ///< ERR_TP_MAXTIME
    Broken,   ///< ERR_TP_DIBREAK, ERR_TP_DOBREAK, ERR_TP_PERSBOOLBREAK
    NoClient, ///< nobody can ever answer: no stimulus answer left, no terminal. ERR_TP_NO_CLIENT; an event is
              ///< written
};

class OperatorPanel {
  public:
    /// Questions without an operator are reported to `log`.
    explicit OperatorPanel(EventLog& log) : log_(log) {}

    /// TPWrite: a line on stdout.
    void writeLine(std::string_view text);
    /// Gets every line from now on.
    void onLine(std::function<void(std::string_view)> listener) { listener_ = std::move(listener); }
    /// TPErase: nothing can be taken back on stdout; kept for clients.
    void erase() { display_.clear(); }
    /// The newest lines shown (at most 100).
    const std::deque<std::string>& display() const { return display_; }
    void setOutput(std::FILE* lines, std::FILE* dialogs) { lines_ = lines, dialogs_ = dialogs; }
    /// Whether the terminal may be asked (default: stdin is a terminal).
    void setTerminal(bool usable) { terminal_ = usable ? 1 : 0; }
    void flush();
    /// Lets others see what was written when that is a tenth of a second (wall clock) old: to be called often.
    void keepVisible();

    /// Shows the dialog and suspends the task until it ends; the answer is the line as given, without line
    /// end and blanks around it. A native may ask again when the answer makes no sense.
    Status ask(Task& task, const Dialog& dialog, DialogEnd& end, std::string& answer);

    /// An answer from outside: goes to the dialog that waits longest, or to the one asked next.
    void giveAnswer(std::string text);
    /// How many answers are still to come from the stimulus / one of them is due.
    void setAnswersToCome(std::size_t count) { answersToCome_ = count; }
    void answerCame(std::string text) {
        answersToCome_ -= answersToCome_ > 0 ? 1 : 0;
        giveAnswer(std::move(text));
        if (answersToCome_ == 0) answered_.notifyAll(); // whoever still asks learns that nobody will answer
    }
    /// Somebody is there to answer or an answer is due (UIClientExist).
    bool canAnswer() const;

  private:
    struct Asking {
        Task* task;
        bool answered = false;
        std::string answer;
    };
    void show(const Dialog& dialog);
    Status waitForAnswer(Task& task, const Dialog& dialog, Asking& asking, WaitResult& result, bool& broken);
    Status askTerminal(Task& task, const Dialog& dialog, DialogEnd& end, std::string& answer);
    bool terminalUsable() const;

    EventLog& log_;
    std::FILE* lines_ = stdout;
    bool unseen_ = false; ///< lines were written since the last flush
    std::chrono::steady_clock::time_point seen_ = std::chrono::steady_clock::now();
    std::FILE* dialogs_ = stderr;
    int terminal_ = -1;
    std::deque<std::string> display_;
    std::function<void(std::string_view)> listener_;
    std::deque<std::string> answers_;
    std::deque<Asking*> asking_;
    std::size_t answersToCome_ = 0;
    WaitQueue answered_;
    std::string typed_; // read from the terminal, not yet a whole line
};

} // namespace rt
