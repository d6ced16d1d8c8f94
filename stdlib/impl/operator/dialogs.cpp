// Manual 1.10: TPReadFK, TPReadNum, TPReadDnum. An answer that makes no sense is asked for again.

#include "runtime/value/value_text.h"
#include "stdlib/impl/operator/question.h"

#include "natives/operator.h"
#include "stdlib_constants.h"

#include <cmath>

using namespace rt;
using lib::Reply;

namespace {

/// TPReadNum and TPReadDnum.
template <class Number>
Status readNumber(TaskCore* task, const char* instruction, Number* answer, const String* text,
                  const lib::Breaks& breaks) {
    Dialog dialog;
    dialog.kind = DialogKind::Number;
    dialog.instruction = instruction;
    dialog.lines.emplace_back(text->view());
    double value = 0;
    bool answered = false;
    const auto accept = [&value](const std::string& typed) {
        if (parseRapidNumber(typed, value) && std::isfinite(static_cast<Number>(value))) return Reply::yes();
        return Reply::again("A number is expected.");
    };
    const Status status = lib::ask(task, breaks, dialog, accept, answered);
    if (answered) *answer = static_cast<Number>(value);
    return status;
}

} // namespace

extern "C" {

Status rt_TPReadFK(TaskCore* task, float* TPAnswer, const String* TPText, const String* TPFK1,
                   const String* TPFK2, const String* TPFK3, const String* TPFK4, const String* TPFK5,
                   const float* MaxTime, Handle* DIBreak, bool DIPassive, Handle* DOBreak, bool DOPassive,
                   bool* PersBoolBreak, bool PersBoolPassive, float* BreakFlag) {
    const lib::Breaks breaks{MaxTime,   DIBreak,       DIPassive,       DOBreak,
                             DOPassive, PersBoolBreak, PersBoolPassive, BreakFlag};
    String keys[] = {*TPFK1, *TPFK2, *TPFK3, *TPFK4, *TPFK5};
    lib::Buttons buttons;
    if (const Status status = buttons.read(task, nullptr, keys, 5, k::btnNone)) return status;
    if (const Status status = buttons.requireEnd(task, breaks)) return status;
    Dialog dialog;
    dialog.kind = DialogKind::Choice;
    dialog.instruction = "TPReadFK";
    dialog.lines.emplace_back(TPText->view());
    dialog.choices = buttons.texts();
    dialog.results = buttons.results();
    int key = -1;
    const auto accept = [&](const std::string& answer) {
        key = buttons.named(answer);
        return key >= 0 ? Reply::yes() : Reply::again("The number of a key is expected.");
    };
    bool answered = false;
    const Status status = lib::ask(task, breaks, dialog, accept, answered);
    if (answered) *TPAnswer = buttons.result(key);
    return status;
}

Status rt_TPReadNum(TaskCore* task, float* TPAnswer, const String* TPText, const float* MaxTime,
                    Handle* DIBreak, bool DIPassive, Handle* DOBreak, bool DOPassive, bool* PersBoolBreak,
                    bool PersBoolPassive, float* BreakFlag) {
    return readNumber(
        task, "TPReadNum", TPAnswer, TPText,
        {MaxTime, DIBreak, DIPassive, DOBreak, DOPassive, PersBoolBreak, PersBoolPassive, BreakFlag});
}

Status rt_TPReadDnum(TaskCore* task, double* TPAnswer, const String* TPText, const float* MaxTime,
                     Handle* DIBreak, bool DIPassive, Handle* DOBreak, bool DOPassive, bool* PersBoolBreak,
                     bool PersBoolPassive, float* BreakFlag) {
    return readNumber(
        task, "TPReadDnum", TPAnswer, TPText,
        {MaxTime, DIBreak, DIPassive, DOBreak, DOPassive, PersBoolBreak, PersBoolPassive, BreakFlag});
}
}
