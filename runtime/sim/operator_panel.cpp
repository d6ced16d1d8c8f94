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
    const bool watched = !dialog.breakQueues.empty() || dialog.pollPeriod > 0;
    return dialog.deadline != kNever || (dialog.broken && watched);
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
    if (terminal_ >= 0) return terminal_ != 0;
    return isatty(STDIN_FILENO) == 1;
}

bool OperatorPanel::canAnswer() const {
    return !answers_.empty() || answersToCome_ > 0 || terminalUsable();
}

void OperatorPanel::show(const Dialog& dialog) {
    std::fflush(lines_); // what was written before the question stands before it
    if (!dialog.header.empty()) fmt::print(dialogs_, "--- {} ---\n", dialog.header);
    for (const std::string& line : dialog.lines)
        fmt::print(dialogs_, "{}\n", line);
    for (std::size_t i = 0; i < dialog.choices.size(); ++i) {
        if (!dialog.choices[i].empty()) fmt::print(dialogs_, "  {}: {}\n", i + 1, dialog.choices[i]);
    }
    std::fflush(dialogs_);
}

void OperatorPanel::giveAnswer(std::string text) {
    for (Asking* asking : asking_) {
        if (asking->answered) continue;
        asking->answered = true;
        asking->answer = std::move(text);
        answered_.notifyAll();
        return;
    }
    answers_.push_back(std::move(text));
}

Status OperatorPanel::ask(Task& task, const Dialog& dialog, DialogEnd& end, std::string& answer) {
    show(dialog);
    Asking asking{&task, false, {}};
    if (!answers_.empty()) {
        asking.answered = true;
        asking.answer = std::move(answers_.front());
        answers_.pop_front();
    } else if (answersToCome_ == 0 && terminalUsable()) {
        const Status status = askTerminal(task, dialog, end, answer);
        if (status == kOk && end == DialogEnd::Answered) answer = std::string(trimmed(answer));
        return status;
    } else if (answersToCome_ == 0 && !canEndByItself(dialog)) {
        log_.write(EventId::NoOperator, &task, {questionOf(dialog)});
        end = DialogEnd::NoClient;
        return kOk;
    }
    bool broken = false;
    WaitResult result = WaitResult::Done;
    if (!asking.answered) {
        const Status status = waitForAnswer(task, dialog, asking, result, broken);
        if (status < 0) return status;
    }
    end = asking.answered ? DialogEnd::Answered : broken ? DialogEnd::Broken : DialogEnd::Timeout;
    if (!asking.answered && result == WaitResult::Done && !broken) { // the last answer went to another dialog
        log_.write(EventId::NoOperator, &task, {questionOf(dialog)});
        end = DialogEnd::NoClient;
    }
    if (asking.answered) {
        answer = std::string(trimmed(asking.answer));
        fmt::print(dialogs_, "> {}\n", answer);
    }
    return kOk;
}

Status OperatorPanel::waitForAnswer(Task& task, const Dialog& dialog, Asking& asking, WaitResult& result,
                                    bool& broken) {
    const bool endless = !canEndByItself(dialog);
    WaitSpec spec;
    spec.queues = dialog.breakQueues;
    spec.queues.push_back(&answered_);
    spec.deadline = dialog.deadline;
    spec.pollPeriod = dialog.broken ? dialog.pollPeriod : 0;
    spec.condition = [&] {
        broken = dialog.broken && dialog.broken();
        return asking.answered || broken || (endless && answersToCome_ == 0 && !terminalUsable());
    };
    asking_.push_back(&asking);
    const Status status = task.waitFor(spec, result);
    asking_.erase(std::find(asking_.begin(), asking_.end(), &asking));
    return status;
}

/// One line from the terminal. Break conditions are looked at between waits; virtual time keeps step with the wall.
Status OperatorPanel::askTerminal(Task& task, const Dialog& dialog, DialogEnd& end, std::string& answer) {
    constexpr Time kLook = 100 * kMillisecond;
    fmt::print(dialogs_, "> ");
    std::fflush(dialogs_);
    for (;;) {
        const std::size_t lineEnd = typed_.find('\n');
        if (lineEnd != std::string::npos) {
            answer = typed_.substr(0, lineEnd);
            typed_.erase(0, lineEnd + 1);
            end = DialogEnd::Answered;
            return kOk;
        }
        if (dialog.broken && dialog.broken()) {
            end = DialogEnd::Broken;
            return kOk;
        }
        if (task.now() >= dialog.deadline) {
            end = DialogEnd::Timeout;
            return kOk;
        }
        Time until = dialog.deadline;
        if (dialog.broken) until = std::min(until, addTime(task.now(), kLook));
        WaitResult result{};
        const Status status = task.waitExternal(STDIN_FILENO, POLLIN, until, result);
        if (status < 0) return status;
        if (result == WaitResult::Timeout) continue;
        char buffer[512];
        const ssize_t got = read(STDIN_FILENO, buffer, sizeof buffer);
        if (got <= 0) { // end of input: nobody there any more
            terminal_ = 0;
            log_.write(EventId::NoOperator, &task, {questionOf(dialog)});
            end = DialogEnd::NoClient;
            return kOk;
        }
        typed_.append(buffer, static_cast<std::size_t>(got));
    }
}

} // namespace rt
