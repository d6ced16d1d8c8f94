#include "stdlib/impl/operator/question.h"

#include "runtime/base/text_util.h"
#include "stdlib/impl/io/signals.h"
#include "stdlib/impl/support/fail.h"
#include "stdlib/impl/support/utf8.h"

#include "stdlib_constants.h"

#include <utility>

namespace rt::lib {
namespace {

constexpr const char* kNotConnected = "no FlexPendant is connected";

/// Sets \BreakFlag, or raises.
Status ended(TaskCore* task, const Breaks& breaks, Status number, const char* text) {
    if (!breaks.breakFlag) return fail(task, number, text);
    *breaks.breakFlag = static_cast<float>(number);
    return kOk;
}

/// Looks at what may break a dialog off, as long as it exists.
class BreakWatch {
  public:
    BreakWatch(TaskCore* task, const Breaks& breaks) : task_(taskOf(task)), breaks_(breaks) {
        if (breaks.input) input_ = signalOf(task, *breaks.input, status_);
        if (breaks.output && status_ == kOk) output_ = signalOf(task, *breaks.output, status_);
        if (status_ != kOk || !breaks.persistent) return;
        data_ = task_.scheduler().watchData([this] {
            if (persistentBreaks()) changed_.notifyAll();
        });
    }
    ~BreakWatch() {
        if (data_ != 0) task_.scheduler().unwatchData(data_);
    }
    BreakWatch(const BreakWatch&) = delete;
    BreakWatch& operator=(const BreakWatch&) = delete;

    Status status() const { return status_; }

    void prepare(Dialog& dialog) {
        IoSystem& io = task_.controller().io();
        if (breaks_.maxTime) dialog.deadline = addTime(task_.now(), fromSeconds(*breaks_.maxTime));
        for (const SignalId id : {input_, output_})
            if (id >= 0) dialog.breakQueues.push_back(&io.changed(id));
        if (breaks_.persistent) dialog.breakQueues.push_back(&changed_);
        dialog.broken = [this] { return reason() != kOk; };
    }

    /// ERRNO of the break that holds now, kOk if none does.
    Status reason() const {
        const IoSystem& io = task_.controller().io();
        if (input_ >= 0 && io.value(input_) == (breaks_.inputPassive ? 0 : 1)) return err::ERR_TP_DIBREAK;
        if (output_ >= 0 && io.value(output_) == (breaks_.outputPassive ? 0 : 1)) return err::ERR_TP_DOBREAK;
        return persistentBreaks() ? err::ERR_TP_PERSBOOLBREAK : kOk;
    }

  private:
    bool persistentBreaks() const {
        return breaks_.persistent && *breaks_.persistent != breaks_.persistentPassive;
    }

    Task& task_;
    const Breaks& breaks_;
    SignalId input_ = -1, output_ = -1;
    Status status_ = kOk;
    WaitQueue changed_;
    EventToken data_ = 0;
};

Status report(TaskCore* task, const Breaks& breaks, DialogEnd end, Status reason) {
    switch (end) {
    case DialogEnd::Timeout: return ended(task, breaks, err::ERR_TP_MAXTIME, "no answer within \\MaxTime");
    case DialogEnd::NoClient:
        return ended(task, breaks, err::ERR_TP_NO_CLIENT,
                     "the dialog cannot be answered: run the program at a terminal, or give answers with "
                     "--stimulus");
    default: break;
    }
    return ended(task, breaks, reason == kOk ? err::ERR_TP_DIBREAK : reason, "the dialog was broken off");
}

/// Broken between words so that no line has more characters than the display.
std::vector<std::string> wrapped(const std::string& text) {
    constexpr std::size_t kColumns = 55;
    std::vector<std::string> lines(1);
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(' ', begin), text.size());
        const std::string word = text.substr(begin, end - begin);
        begin = end + 1;
        if (word.empty()) continue;
        std::string& line = lines.back();
        if (line.empty())
            line = word;
        else if (characterCount(line) + 1 + characterCount(word) <= kColumns)
            line += ' ' + word;
        else
            lines.push_back(word);
    }
    return lines;
}

} // namespace

Status ask(TaskCore* task, const Breaks& breaks, Dialog& dialog, const Accept& accept, bool& answered) {
    answered = false;
    BreakWatch watch(task, breaks);
    if (watch.status() != kOk) return watch.status();
    const ActiveSignal active(task, breaks.active);
    if (active.status() != kOk) return active.status();
    watch.prepare(dialog);
    Task& owner = taskOf(task);
    if (!owner.controller().panel().isConnected())
        return ended(task, breaks, err::ERR_TP_NO_CLIENT, kNotConnected);
    OperatorPanel& panel = owner.controller().panel();
    for (;;) {
        DialogEnd end = DialogEnd::Answered;
        std::string answer;
        if (const Status status = panel.ask(owner, dialog, end, answer)) return status;
        if (end != DialogEnd::Answered) return report(task, breaks, end, watch.reason());
        const Reply reply = accept(answer);
        if (!reply.why.empty()) panel.remark(reply.why);
        if (!reply.accepted) continue;
        answered = true;
        if (breaks.breakFlag) *breaks.breakFlag = 0;
        return kOk;
    }
}

Status checkConnected(TaskCore* task) {
    if (taskOf(task).controller().panel().isConnected()) return kOk;
    return fail(task, err::ERR_TP_NO_CLIENT, kNotConnected);
}

ActiveSignal::ActiveSignal(TaskCore* task, const Handle* handle) : io_(taskOf(task).controller().io()) {
    if (!handle) return;
    status_ = ioStatus(task, io_.set(*handle, 1), *handle);
    if (status_ == kOk) signal_ = *handle;
}

ActiveSignal::~ActiveSignal() {
    if (signal_ != 0) io_.set(signal_, 0);
}

Status fillText(TaskCore* task, const MessageText& text, std::string& header, std::string& icon,
                std::string& image, std::vector<std::string>& lines) {
    static constexpr const char* kIcons[] = {"", "Information", "Warning", "Error", "Question"};
    const float number = text.icon ? *text.icon : k::iconNone;
    if (number != k::iconNone && number != k::iconInfo && number != k::iconWarning &&
        number != k::iconError && number != k::iconQuestion)
        return failWith(task, err::ERR_ARGVALERR,
                        "{} is not an icon; use iconNone, iconInfo, iconWarning, iconError or iconQuestion",
                        static_cast<double>(number));
    icon = kIcons[static_cast<std::size_t>(number)];
    if (text.header) header = text.header->view();
    if (text.image) image = text.image->view();
    if (text.message) lines.emplace_back(text.message->view());
    for (int32_t i = 0; text.lines && i < text.lineCount; ++i)
        lines.emplace_back(text.lines[i].view());
    while (!lines.empty() && lines.back().empty())
        lines.pop_back();
    if (!text.wrap) return kOk;
    std::string all;
    for (const std::string& line : lines)
        all += (all.empty() ? "" : " ") + line;
    lines = wrapped(all);
    return kOk;
}

Status Buttons::read(TaskCore* task, const float* set, const String* own, int32_t ownCount, float standard) {
    constexpr int32_t kMostOwn = 5;
    if (own) {
        if (ownCount > kMostOwn)
            return failWith(task, err::ERR_ARGVALERR, "\\BtnArray has {} elements; five buttons fit",
                            ownCount);
        for (int32_t i = 0; i < ownCount; ++i) {
            texts_.emplace_back(own[i].view());
            results_.push_back(static_cast<float>(i + 1));
        }
        return kOk;
    }
    using Button = std::pair<const char*, float>;
    static const Button ok{"OK", k::resOK}, abort{"Abort", k::resAbort}, retry{"Retry", k::resRetry},
        ignore{"Ignore", k::resIgnore}, cancel{"Cancel", k::resCancel}, yes{"Yes", k::resYes},
        no{"No", k::resNo};
    static const std::vector<std::pair<float, std::vector<Button>>> kSets = {
        {k::btnNone, {}},
        {k::btnOK, {ok}},
        {k::btnAbrtRtryIgn, {abort, retry, ignore}},
        {k::btnOKCancel, {ok, cancel}},
        {k::btnRetryCancel, {retry, cancel}},
        {k::btnYesNo, {yes, no}},
        {k::btnYesNoCancel, {yes, no, cancel}},
    };
    const float wanted = set ? *set : standard;
    for (const auto& [number, buttons] : kSets) {
        if (number != wanted) continue;
        for (const auto& [text, result] : buttons) {
            texts_.emplace_back(text);
            results_.push_back(result);
        }
        return kOk;
    }
    return failWith(task, err::ERR_ARGVALERR,
                    "there is no set of buttons {}; use a constant such as btnOKCancel",
                    static_cast<double>(wanted));
}

int Buttons::named(std::string_view answer) const {
    for (std::size_t i = 0; i < texts_.size(); ++i) {
        const bool meant = answer == std::to_string(i + 1) || sameName(answer, texts_[i]);
        if (meant && !texts_[i].empty()) return static_cast<int>(i);
    }
    return -1;
}

float Buttons::result(int button) const {
    return results_[static_cast<std::size_t>(button)];
}

Status Buttons::requireEnd(TaskCore* task, const Breaks& breaks) const {
    for (const std::string& text : texts_)
        if (!text.empty()) return kOk;
    if (breaks.maxTime || breaks.input || breaks.output || breaks.persistent) return kOk;
    return fail(task, err::ERR_ARGVALERR,
                "a dialog without a button never ends: give it a button, \\MaxTime or a break");
}

} // namespace rt::lib
