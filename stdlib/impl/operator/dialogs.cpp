// Manual 1.10: questions to the operator. An answer that makes no sense is asked for again.

#include "runtime/value/value_text.h"
#include "stdlib/impl/io/signals.h"
#include "stdlib/impl/support/fail.h"

#include "stdlib_constants.h"
#include "stdlib_natives.h"

#include <cmath>
#include <functional>

using namespace rt;

namespace {

constexpr Time kPersistentPoll = 100 * kMillisecond; // nothing tells of changes of a persistent

/// What may end a dialog early, as the optional arguments say.
struct Breaks {
    const float* maxTime;
    const Handle* input;
    bool inputPassive;
    const Handle* output;
    bool outputPassive;
    const bool* persistent;
    bool persistentPassive;
    float* breakFlag;
};

/// The signal a break waits for; -1 when there is none.
Status breakSignal(TaskCore* task, const Handle* handle, SignalId& id) {
    Status status = kOk;
    id = handle ? lib::signalOf(task, *handle, status) : -1;
    return status;
}

/// Sets \BreakFlag, or raises.
Status ended(TaskCore* task, const Breaks& breaks, Status number, const char* text) {
    if (!breaks.breakFlag) return lib::fail(task, number, text);
    *breaks.breakFlag = static_cast<float>(number);
    return kOk;
}

class Question {
  public:
    Question(TaskCore* task, const Breaks& breaks) : task_(task), breaks_(breaks) {}

    /// Asks until `accept` takes an answer; false in `answered` when the dialog ended otherwise (\BreakFlag).
    Status ask(Dialog dialog, const std::function<bool(const std::string&)>& accept, bool& answered) {
        answered = false;
        if (const Status status = prepare(dialog)) return status;
        Task& owner = taskOf(task_);
        while (true) {
            DialogEnd end = DialogEnd::Answered;
            std::string answer;
            if (const Status status = owner.controller().panel().ask(owner, dialog, end, answer))
                return status;
            if (end != DialogEnd::Answered) return report(end);
            if (!accept(answer)) continue;
            answered = true;
            if (breaks_.breakFlag) *breaks_.breakFlag = 0;
            return kOk;
        }
    }

  private:
    Status prepare(Dialog& dialog) {
        Task& owner = taskOf(task_);
        IoSystem& io = owner.controller().io();
        if (const Status status = breakSignal(task_, breaks_.input, input_)) return status;
        if (const Status status = breakSignal(task_, breaks_.output, output_)) return status;
        if (breaks_.maxTime) dialog.deadline = addTime(owner.now(), fromSeconds(*breaks_.maxTime));
        for (const SignalId id : {input_, output_})
            if (id >= 0) dialog.breakQueues.push_back(&io.changed(id));
        if (breaks_.persistent != nullptr) dialog.pollPeriod = kPersistentPoll;
        dialog.broken = [this] { return reason() != kOk; };
        return kOk;
    }

    /// ERRNO of the break that holds now, kOk if none does.
    Status reason() const {
        const IoSystem& io = taskOf(task_).controller().io();
        if (input_ >= 0 && io.value(input_) == (breaks_.inputPassive ? 0 : 1)) return err::ERR_TP_DIBREAK;
        if (output_ >= 0 && io.value(output_) == (breaks_.outputPassive ? 0 : 1)) return err::ERR_TP_DOBREAK;
        if (breaks_.persistent && *breaks_.persistent != breaks_.persistentPassive)
            return err::ERR_TP_PERSBOOLBREAK;
        return kOk;
    }

    Status report(DialogEnd end) const {
        switch (end) {
        case DialogEnd::Timeout:
            return ended(task_, breaks_, err::ERR_TP_MAXTIME, "no answer within \\MaxTime");
        case DialogEnd::NoClient:
            return ended(task_, breaks_, err::ERR_TP_NO_CLIENT, "nobody can answer the dialog");
        default: break;
        }
        const Status number = reason();
        return ended(task_, breaks_, number == kOk ? err::ERR_TP_DIBREAK : number,
                     "the dialog was broken off");
    }

    TaskCore* task_;
    const Breaks& breaks_;
    SignalId input_ = -1, output_ = -1;
};

Dialog dialogOf(const String* text) {
    Dialog dialog;
    dialog.lines.emplace_back(text->view());
    return dialog;
}

/// TPReadNum and TPReadDnum: asks until the answer is a number.
template <class Number>
Status readNumber(TaskCore* task, Number* answer, const String* text, const Breaks& breaks) {
    double value = 0;
    bool answered = false;
    const auto accept = [&value](const std::string& typed) { return parseRapidNumber(typed, value); };
    const Status status = Question(task, breaks).ask(dialogOf(text), accept, answered);
    if (answered) *answer = static_cast<Number>(value);
    return status;
}

} // namespace

extern "C" {

Status rt_TPReadFK(TaskCore* task, float* TPAnswer, const String* TPText, const String* TPFK1,
                   const String* TPFK2, const String* TPFK3, const String* TPFK4, const String* TPFK5,
                   const float* MaxTime, Handle* DIBreak, bool DIPassive, Handle* DOBreak, bool DOPassive,
                   bool* PersBoolBreak, bool PersBoolPassive, float* BreakFlag) {
    const Breaks breaks{MaxTime,   DIBreak,       DIPassive,       DOBreak,
                        DOPassive, PersBoolBreak, PersBoolPassive, BreakFlag};
    Dialog dialog = dialogOf(TPText);
    for (const String* key : {TPFK1, TPFK2, TPFK3, TPFK4, TPFK5})
        dialog.choices.emplace_back(key->view());
    const std::vector<std::string> keys = dialog.choices;
    double value = 0;
    const auto accept = [&](const std::string& answer) {
        return parseRapidNumber(answer, value) && value >= 1 && value <= 5 && std::trunc(value) == value &&
               !keys[static_cast<size_t>(value) - 1].empty();
    };
    bool answered = false;
    const Status status = Question(task, breaks).ask(dialog, accept, answered);
    if (answered) *TPAnswer = static_cast<float>(value);
    return status;
}

Status rt_TPReadNum(TaskCore* task, float* TPAnswer, const String* TPText, const float* MaxTime,
                    Handle* DIBreak, bool DIPassive, Handle* DOBreak, bool DOPassive, bool* PersBoolBreak,
                    bool PersBoolPassive, float* BreakFlag) {
    return readNumber(
        task, TPAnswer, TPText,
        {MaxTime, DIBreak, DIPassive, DOBreak, DOPassive, PersBoolBreak, PersBoolPassive, BreakFlag});
}

Status rt_TPReadDnum(TaskCore* task, double* TPAnswer, const String* TPText, const float* MaxTime,
                     Handle* DIBreak, bool DIPassive, Handle* DOBreak, bool DOPassive, bool* PersBoolBreak,
                     bool PersBoolPassive, float* BreakFlag) {
    return readNumber(
        task, TPAnswer, TPText,
        {MaxTime, DIBreak, DIPassive, DOBreak, DOPassive, PersBoolBreak, PersBoolPassive, BreakFlag});
}
}
