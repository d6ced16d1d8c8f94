#pragma once
// OperatorPanel: what the person at the FlexPendant sees and answers. TPWrite lines go to stdout; dialogs
// (texts and answers) to stderr. Answers come from the stimulus, otherwise from the terminal; other clients answer with answerDialog().

#include "runtime/sched/task.h"
#include "runtime/sched/wait_queue.h"

#include <chrono>
#include <cstdio>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace rt {

/// The kind of an answer.
enum class DialogKind : uint8_t {
    Choice, ///< a key or button: its number from 1
    Number,
    Text,
    List ///< an item: its number from 1
};

/// A question to the operator, as data: the terminal shows it as text, other clients may show it as a window.
struct Dialog {
    DialogKind kind = DialogKind::Text;
    std::string instruction;          ///< that asks: "UIMsgBox"
    std::string header;               ///< may be empty
    std::string icon;                 ///< "Information", "Warning", "Error"; "" = none
    std::string image;                ///< picture file, as the program names it; "" = none
    std::vector<std::string> lines;   ///< the text
    std::vector<std::string> choices; ///< keys or buttons, numbered from 1; empty entries are not shown
    std::vector<float> results;       ///< what the program gets for each of the choices; may be empty
    std::vector<std::string> items;   ///< of a list, numbered from 1
    std::vector<std::size_t> visible; ///< numbers of the items that a terminal shows at present
    std::string initial;              ///< text or number that the entry begins with; "" = none
    std::optional<double> least, most, increment; ///< of a number: its limits, the step of its keys + and -
    bool isWhole = false;                         ///< only whole numbers may be answered
    bool isDnum = false;                          ///< a number of type dnum, otherwise of type num
    std::string hint;       ///< what may be answered, for people at a terminal; may be empty
    bool answerable = true; ///< false: it has no button, and something else ends it
    Time deadline = kNever; ///< absolute (\MaxTime)
    /// Ends the dialog early (\DIBreak, \PersBoolBreak); looked at when one of `breakQueues` is notified.
    std::function<bool()> broken;
    std::vector<WaitQueue*> breakQueues;
};

enum class DialogEnd : uint8_t {
    Answered,
    Timeout,  ///< ERR_TP_MAXTIME
    Broken,   ///< ERR_TP_DIBREAK, ERR_TP_DOBREAK, ERR_TP_PERSBOOLBREAK
    NoClient, ///< no answer can come: no stimulus answer left, no terminal. ERR_TP_NO_CLIENT; an event is
              ///< written
};

/// A text that stays on the display while the program continues (UIMsgWrite).
struct PanelMessage {
    std::string header, icon, image;
    std::vector<std::string> lines;
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
    /// People at other clients answer dialogs: the terminal is not asked, and a dialog waits until one of them does.
    void setAnsweredByClients() { answeredByClients_ = true; }
    /// Whether the terminal may be asked (default: stdin is a terminal).
    void setTerminal(bool usable) { terminal_ = usable ? 1 : 0; }
    /// False: no FlexPendant is connected, so nothing can be shown or asked (ERR_TP_NO_CLIENT).
    void setConnected(bool connected) { connected_ = connected; }
    bool isConnected() const { return connected_; }
    /// False: the display has no room for a further view (ERR_UISHOW_FULL).
    void setRoomForViews(bool room) { roomForViews_ = room; }
    bool hasRoomForViews() const { return roomForViews_; }
    void flush();
    /// Lets others see what was written when that is a tenth of a second (wall clock) old: to be called often.
    void keepVisible();

    /// Shows the dialog and suspends the task until it ends; the answer is the line as given, without line
    /// end and blanks around it. A native may ask again when the answer makes no sense.
    Status ask(Task& task, const Dialog& dialog, DialogEnd& end, std::string& answer);

    /// An answer from outside: goes to the dialog that waits longest, or to the one asked next.
    void giveAnswer(std::string text);
    /// Dialogs that wait for an answer, the longest first.
    struct OpenDialog {
        uint64_t number = 0; ///< of this question, never used twice
        const Task* task = nullptr;
        const Dialog* dialog = nullptr; ///< valid until virtual time passes
    };
    std::vector<OpenDialog> openDialogs() const;
    /// Answers that dialog; false when it is not open any more.
    bool answerDialog(uint64_t number, std::string text);

    /// Shows a message in place of the one before it, or removes it.
    void showMessage(PanelMessage message);
    void removeMessage() { message_.reset(); }
    const std::optional<PanelMessage>& message() const { return message_; }
    /// A line for the operator beside a dialog, such as the reason why an answer is refused.
    void remark(std::string_view text);
    /// How many answers are still to come from the stimulus / one of them is due.
    void setAnswersToCome(std::size_t count) { answersToCome_ = count; }
    void answerCame(std::string text) {
        answersToCome_ -= answersToCome_ > 0 ? 1 : 0;
        giveAnswer(std::move(text));
        if (answersToCome_ == 0) answered_.notifyAll(); // dialogs still open learn that no answer will come
    }
    /// Somebody is there to answer or an answer is due (UIClientExist).
    bool canAnswer() const;

  private:
    struct Asking {
        uint64_t number;
        Task& task;
        const Dialog& dialog;
        bool answered = false;
        std::string answer;
    };
    class Listed;
    void show(const Asking& asking);
    void answerTo(Asking& asking, std::string text);
    /// `end` stays empty when the terminal has gone, or has come to be needed.
    Status waitForAnswer(Asking& asking, std::optional<DialogEnd>& end);
    Status askTerminal(Asking& asking, std::optional<DialogEnd>& end);
    Status waitForTurn(Asking& asking, std::optional<DialogEnd>& end);
    Status readAnswer(Asking& asking, std::optional<DialogEnd>& end);
    bool endsNow(const Asking& asking, std::optional<DialogEnd>& end) const;
    bool readTerminal();
    bool isTerminalTurn() const { return answersToCome_ == 0 && terminalUsable(); }
    bool terminalUsable() const;

    EventLog& log_;
    std::FILE* lines_ = stdout;
    bool unseen_ = false; ///< lines were written since the last flush
    std::chrono::steady_clock::time_point seen_ = std::chrono::steady_clock::now();
    std::FILE* dialogs_ = stderr;
    int terminal_ = -1;
    std::deque<std::string> display_;
    std::function<void(std::string_view)> listener_;
    bool answeredByClients_ = false, connected_ = true, roomForViews_ = true;
    std::deque<std::string> answers_;
    std::deque<Asking*> asking_;
    uint64_t lastNumber_ = 0;
    const Asking* terminalUser_ = nullptr; ///< the terminal shows one dialog at a time
    std::optional<PanelMessage> message_;
    std::size_t answersToCome_ = 0;
    WaitQueue answered_;
    std::string typed_; // read from the terminal, not yet a whole line
};

} // namespace rt
