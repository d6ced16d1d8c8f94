#include "runtime/sim/operator_panel.h"

#include "runtime/base/text_util.h"
#include "runtime/log/event_log.h"

#include <fmt/format.h>

#include <poll.h>
#include <unistd.h>

#include <algorithm>

namespace rt {
namespace {

constexpr std::size_t kKeptLines = 100;

std::string questionOf(const Dialog& dialog) {
    std::string text = dialog.header;
    for (const std::string& line : dialog.lines) {
        if (!text.empty() && !line.empty()) text += ' ';
        text += line;
    }
    return text;
}

/// Something else than an answer can end the dialog.
bool canEndByItself(const Dialog& dialog) {
    return dialog.deadline != kNever || !dialog.breakQueues.empty();
}

bool isBroken(const Dialog& dialog) {
    return dialog.broken && dialog.broken();
}

void printHeader(std::FILE* to, const std::string& icon, const std::string& header) {
    if (icon.empty() && header.empty()) return;
    fmt::print(to, "--- {}{}{} ---\n", icon, icon.empty() || header.empty() ? "" : ": ", header);
}

void printText(std::FILE* to, const std::vector<std::string>& lines, const std::string& image) {
    for (const std::string& line : lines)
        fmt::print(to, "{}\n", line);
    if (!image.empty()) fmt::print(to, "(image {})\n", image);
}

} // namespace

void OperatorPanel::writeLine(std::string_view text) {
    display_.emplace_back(text);
    if (display_.size() > kKeptLines) display_.pop_front();
    const std::string line = std::string(text) + "\n";
    std::fwrite(line.data(), 1, line.size(), lines_);
    unseen_ = true;
    if (listener_) listener_(text);
}

void OperatorPanel::flush() {
    std::fflush(lines_);
    std::fflush(dialogs_);
    unseen_ = false;
    seen_ = std::chrono::steady_clock::now();
}

void OperatorPanel::keepVisible() {
    if (unseen_ && std::chrono::steady_clock::now() - seen_ > std::chrono::milliseconds(100)) flush();
}

bool OperatorPanel::terminalUsable() const {
    if (answeredByClients_) return false;
    if (terminal_ >= 0) return terminal_ != 0;
    return isatty(STDIN_FILENO) == 1;
}

bool OperatorPanel::canAnswer() const {
    return connected_ && (answeredByClients_ || !answers_.empty() || answersToCome_ > 0 || terminalUsable());
}

/// Keeps a dialog in the list of those that wait, even while its task is being unwound.
class OperatorPanel::Listed {
  public:
    Listed(OperatorPanel& panel, Asking& asking) : panel_(panel), asking_(asking) {
        panel_.asking_.push_back(&asking);
    }
    ~Listed() {
        std::erase(panel_.asking_, &asking_);
        if (panel_.terminalUser_ == &asking_) panel_.terminalUser_ = nullptr;
        if (!panel_.asking_.empty()) panel_.answered_.notifyAll(); // the next one may use the terminal
    }
    Listed(const Listed&) = delete;
    Listed& operator=(const Listed&) = delete;

  private:
    OperatorPanel& panel_;
    Asking& asking_;
};

/// Names the task only when several ask.
void OperatorPanel::show(const Asking& asking) {
    const Dialog& dialog = asking.dialog;
    std::fflush(lines_); // the text before the question must appear first
    if (asking_.size() > 1) fmt::print(dialogs_, "[{}]\n", asking.task.name());
    printHeader(dialogs_, dialog.icon, dialog.header);
    printText(dialogs_, dialog.lines, dialog.image);
    for (const std::size_t number : dialog.visible)
        fmt::print(dialogs_, "  {}: {}\n", number, dialog.items[number - 1]);
    for (std::size_t i = 0; i < dialog.choices.size(); ++i) {
        if (dialog.choices[i].empty()) continue;
        if (dialog.kind == DialogKind::List)
            fmt::print(dialogs_, "  [{}]\n", dialog.choices[i]);
        else
            fmt::print(dialogs_, "  {}: {}\n", i + 1, dialog.choices[i]);
    }
    if (!dialog.hint.empty()) fmt::print(dialogs_, "({})\n", dialog.hint);
    std::fflush(dialogs_);
}

void OperatorPanel::showMessage(PanelMessage message) {
    std::fflush(lines_);
    printHeader(dialogs_, message.icon, message.header);
    printText(dialogs_, message.lines, message.image);
    std::fflush(dialogs_);
    message_ = std::move(message);
}

void OperatorPanel::remark(std::string_view text) {
    fmt::print(dialogs_, "{}\n", text);
}

void OperatorPanel::answerTo(Asking& asking, std::string text) {
    asking.answered = true;
    asking.answer = std::move(text);
    answered_.notifyAll();
}

void OperatorPanel::giveAnswer(std::string text) {
    for (Asking* asking : asking_) {
        if (!asking->answered && asking->dialog.answerable) return answerTo(*asking, std::move(text));
    }
    answers_.push_back(std::move(text));
}

std::vector<OperatorPanel::OpenDialog> OperatorPanel::openDialogs() const {
    std::vector<OpenDialog> open;
    for (const Asking* asking : asking_) {
        if (!asking->answered) open.push_back({asking->number, &asking->task, &asking->dialog});
    }
    return open;
}

bool OperatorPanel::answerDialog(uint64_t number, std::string text) {
    for (Asking* asking : asking_) {
        if (asking->number != number || asking->answered || !asking->dialog.answerable) continue;
        answerTo(*asking, std::move(text));
        return true;
    }
    return false;
}

Status OperatorPanel::ask(Task& task, const Dialog& dialog, DialogEnd& end, std::string& answer) {
    Asking asking{++lastNumber_, task, dialog, false, {}};
    const Listed listed(*this, asking);
    if (!answers_.empty() && dialog.answerable) {
        asking.answered = true;
        asking.answer = std::move(answers_.front());
        answers_.pop_front();
    }
    if (asking.answered || !dialog.answerable || !isTerminalTurn()) show(asking);
    std::optional<DialogEnd> ended;
    endsNow(asking, ended);
    bool fromTerminal = false;
    while (!ended) {
        fromTerminal = dialog.answerable && isTerminalTurn();
        const Status status = fromTerminal ? askTerminal(asking, ended) : waitForAnswer(asking, ended);
        if (status < 0) return status;
    }
    end = *ended;
    if (end == DialogEnd::NoClient) log_.write(EventId::NoOperator, &task, {questionOf(dialog)});
    if (end != DialogEnd::Answered) return kOk;
    answer = std::string(trimmed(asking.answer));
    if (!fromTerminal) fmt::print(dialogs_, "> {}\n", answer);
    return kOk;
}

/// An answer counts more than a break at the same time, and a break more than the time that is over.
bool OperatorPanel::endsNow(const Asking& asking, std::optional<DialogEnd>& end) const {
    if (asking.answered)
        end = DialogEnd::Answered;
    else if (isBroken(asking.dialog))
        end = DialogEnd::Broken;
    else if (asking.task.now() >= asking.dialog.deadline)
        end = DialogEnd::Timeout;
    return end.has_value();
}

/// For the stimulus, a client or a break; returns without an end when the terminal is to be asked.
Status OperatorPanel::waitForAnswer(Asking& asking, std::optional<DialogEnd>& end) {
    const Dialog& dialog = asking.dialog;
    const auto hopeless = [&] {
        return !canEndByItself(dialog) && !answeredByClients_ && answersToCome_ == 0 && !terminalUsable();
    };
    WaitSpec spec;
    spec.queues = dialog.breakQueues;
    spec.queues.push_back(&answered_);
    spec.deadline = dialog.deadline;
    spec.condition = [&] {
        return asking.answered || isBroken(dialog) || hopeless() || (dialog.answerable && isTerminalTurn());
    };
    WaitResult result = WaitResult::Done;
    const Status status = asking.task.waitFor(spec, result);
    if (status < 0) return status;
    if (result == WaitResult::Timeout)
        end = DialogEnd::Timeout;
    else if (!endsNow(asking, end) && hopeless())
        end = DialogEnd::NoClient;
    return kOk;
}

Status OperatorPanel::askTerminal(Asking& asking, std::optional<DialogEnd>& end) {
    if (const Status status = waitForTurn(asking, end); status < 0) return status;
    if (end || !terminalUsable()) return kOk;
    terminalUser_ = &asking;
    show(asking);
    fmt::print(dialogs_, "> ");
    std::fflush(dialogs_);
    return readAnswer(asking, end);
}

/// Until no other task uses the terminal or has waited for it longer.
Status OperatorPanel::waitForTurn(Asking& asking, std::optional<DialogEnd>& end) {
    const auto hasTurn = [&] {
        const auto waits = [](const Asking* other) { return !other->answered && other->dialog.answerable; };
        return terminalUser_ == nullptr && *std::find_if(asking_.begin(), asking_.end(), waits) == &asking;
    };
    if (hasTurn()) return kOk;
    WaitSpec spec;
    spec.queues = asking.dialog.breakQueues;
    spec.queues.push_back(&answered_);
    spec.deadline = asking.dialog.deadline;
    spec.condition = [&] { return asking.answered || isBroken(asking.dialog) || hasTurn(); };
    WaitResult result = WaitResult::Done;
    const Status status = asking.task.waitFor(spec, result);
    if (status == kOk) endsNow(asking, end);
    return status;
}

/// One line. Breaks are looked at between waits; virtual time keeps pace with the wall clock.
Status OperatorPanel::readAnswer(Asking& asking, std::optional<DialogEnd>& end) {
    constexpr Time kLook = 100 * kMillisecond;
    while (!endsNow(asking, end)) {
        const std::size_t lineEnd = typed_.find('\n');
        if (lineEnd != std::string::npos) {
            asking.answered = true;
            asking.answer = typed_.substr(0, lineEnd);
            typed_.erase(0, lineEnd + 1);
            continue;
        }
        WaitResult result{};
        const Time until = std::min(asking.dialog.deadline, addTime(asking.task.now(), kLook));
        const Status status = asking.task.waitExternal(STDIN_FILENO, POLLIN, until, result);
        if (status < 0) return status;
        if (result == WaitResult::Done && !readTerminal()) return kOk;
    }
    return kOk;
}

/// False at the end of input: no answer can come any more.
bool OperatorPanel::readTerminal() {
    char buffer[512];
    const ssize_t got = ::read(STDIN_FILENO, buffer, sizeof buffer);
    if (got <= 0) {
        terminal_ = 0;
        answered_.notifyAll();
        return false;
    }
    typed_.append(buffer, static_cast<std::size_t>(got));
    return true;
}

} // namespace rt
