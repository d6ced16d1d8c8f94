// Manual 1.10: numbers and texts that the operator enters. Values outside the limits are asked for again.

#include "runtime/value/value_text.h"
#include "stdlib/impl/operator/question.h"
#include "stdlib/impl/support/fail.h"

#include "natives/operator_dialogs.h"
#include "stdlib_constants.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <type_traits>

using namespace rt;
using lib::Breaks;
using lib::MessageText;
using lib::Reply;

namespace {

std::string textOf(float value) {
    return formatNum(value);
}
std::string textOf(double value) {
    return formatDnum(value);
}

template <class Number> struct NumberWanted {
    const Number* initial;
    const Number* least;
    const Number* most;
    bool integer = false;
    const Number* increment = nullptr; ///< of the tuning dialogs
};

template <class Number> bool isWhole(const Number* value) {
    return !value || std::trunc(*value) == *value;
}

template <class Number> Status checkLimits(TaskCore* task, const NumberWanted<Number>& wanted) {
    if (wanted.least && wanted.most && *wanted.least > *wanted.most)
        return lib::fail(task, err::ERR_UI_MAXMIN, "MinValue is greater than MaxValue");
    if (wanted.integer && !(isWhole(wanted.initial) && isWhole(wanted.least) && isWhole(wanted.most)))
        return lib::fail(task, err::ERR_UI_NOTINT,
                         "with \\AsInteger, InitValue, MinValue and MaxValue must be whole numbers");
    const bool outside = wanted.initial && ((wanted.least && *wanted.initial < *wanted.least) ||
                                            (wanted.most && *wanted.initial > *wanted.most));
    if (!outside) return kOk;
    return lib::fail(task, err::ERR_UI_INITVALUE, "InitValue is not within MinValue and MaxValue");
}

template <class Number> std::string hintFor(const NumberWanted<Number>& wanted, Number present) {
    std::string hint = wanted.integer ? "a whole number" : "a number";
    if (wanted.least) hint += " from " + textOf(*wanted.least);
    if (wanted.most) hint += " up to " + textOf(*wanted.most);
    if (wanted.increment) hint += ", or + and - to change it by " + textOf(*wanted.increment);
    if (wanted.initial) hint += "; Enter alone takes " + textOf(present);
    return hint;
}

/// Why a number is not taken; "" when it is.
template <class Number> std::string refusal(const NumberWanted<Number>& wanted, Number value) {
    if (!std::isfinite(value)) return "The number is too large.";
    if (wanted.integer && !isWhole(&value)) return "A whole number is expected.";
    if (wanted.least && value < *wanted.least) return "The smallest value is " + textOf(*wanted.least) + ".";
    if (wanted.most && value > *wanted.most) return "The largest value is " + textOf(*wanted.most) + ".";
    return {};
}

/// Keys + and -: the value stays within its limits. False when the answer is another one.
template <class Number>
bool tune(const NumberWanted<Number>& wanted, const std::string& answer, Number& present) {
    if (!wanted.increment || answer.empty() || answer.find_first_not_of("+-") != std::string::npos)
        return false;
    for (const char key : answer) {
        present += key == '+' ? *wanted.increment : -*wanted.increment;
        if (wanted.least) present = std::max(present, *wanted.least);
        if (wanted.most) present = std::min(present, *wanted.most);
    }
    return true;
}

/// A limit for clients: 0.7 of type num is 0.7 for them, too, not 0.69999998807907104.
double limitOf(float value) {
    double read = value;
    return parseRapidNumber(fmt::format("{}", value), read) ? read : value;
}
double limitOf(double value) {
    return value;
}

template <class Number>
Status enterNumber(TaskCore* task, const char* instruction, Number* result, const MessageText& text,
                   const NumberWanted<Number>& wanted, const Breaks& breaks) {
    if (const Status status = checkLimits(task, wanted)) return status;
    Dialog dialog;
    dialog.kind = DialogKind::Number;
    dialog.instruction = instruction;
    if (const Status status = lib::fillText(task, text, dialog)) return status;
    Number present = wanted.initial ? *wanted.initial : Number(0);
    dialog.hint = hintFor(wanted, present);
    if (wanted.initial) dialog.initial = textOf(*wanted.initial);
    if (wanted.least) dialog.least = limitOf(*wanted.least);
    if (wanted.most) dialog.most = limitOf(*wanted.most);
    if (wanted.increment) dialog.increment = limitOf(*wanted.increment);
    dialog.isWhole = wanted.integer;
    dialog.isDnum = std::is_same_v<Number, double>;
    const auto accept = [&](const std::string& answer) {
        if (answer.empty() && wanted.initial) return Reply::yes();
        if (tune(wanted, answer, present)) {
            dialog.hint = hintFor(wanted, present);
            return Reply::again({});
        }
        double typed = 0;
        if (!parseRapidNumber(answer, typed)) return Reply::again("A number is expected.");
        const auto value = static_cast<Number>(typed);
        if (std::string why = refusal(wanted, value); !why.empty()) return Reply::again(std::move(why));
        present = value;
        return Reply::yes();
    };
    bool answered = false;
    const Status status = lib::ask(task, breaks, dialog, accept, answered);
    if (!answered) present = wanted.initial ? *wanted.initial : Number(0);
    *result = present;
    return status;
}

} // namespace

extern "C" {

Status rt_UINumEntry(TaskCore* task, float* result, const String* Header, const String* Message,
                     const String* MsgArray, int32_t MsgArrayDim1, bool Wrap, const float* Icon,
                     const float* InitValue, const float* MinValue, const float* MaxValue, bool AsInteger,
                     const float* MaxTime, Handle* DIBreak, bool DIPassive, Handle* DOBreak, bool DOPassive,
                     bool* PersBoolBreak, bool PersBoolPassive, float* BreakFlag, Handle* UIActiveSignal) {
    return enterNumber<float>(task, "UINumEntry", result,
                              {Header, Message, MsgArray, MsgArrayDim1, Wrap, Icon, nullptr},
                              {InitValue, MinValue, MaxValue, AsInteger, nullptr},
                              {MaxTime, DIBreak, DIPassive, DOBreak, DOPassive, PersBoolBreak,
                               PersBoolPassive, BreakFlag, UIActiveSignal});
}

Status rt_UIDnumEntry(TaskCore* task, double* result, const String* Header, const String* Message,
                      const String* MsgArray, int32_t MsgArrayDim1, bool Wrap, const float* Icon,
                      const double* InitValue, const double* MinValue, const double* MaxValue, bool AsInteger,
                      const float* MaxTime, Handle* DIBreak, bool DIPassive, Handle* DOBreak, bool DOPassive,
                      bool* PersBoolBreak, bool PersBoolPassive, float* BreakFlag, Handle* UIActiveSignal) {
    return enterNumber<double>(task, "UIDnumEntry", result,
                               {Header, Message, MsgArray, MsgArrayDim1, Wrap, Icon, nullptr},
                               {InitValue, MinValue, MaxValue, AsInteger, nullptr},
                               {MaxTime, DIBreak, DIPassive, DOBreak, DOPassive, PersBoolBreak,
                                PersBoolPassive, BreakFlag, UIActiveSignal});
}

Status rt_UINumTune(TaskCore* task, float* result, const String* Header, const String* Message,
                    const String* MsgArray, int32_t MsgArrayDim1, bool Wrap, const float* Icon,
                    float InitValue, float Increment, const float* MinValue, const float* MaxValue,
                    const float* MaxTime, Handle* DIBreak, bool DIPassive, Handle* DOBreak, bool DOPassive,
                    bool* PersBoolBreak, bool PersBoolPassive, float* BreakFlag, Handle* UIActiveSignal) {
    return enterNumber<float>(task, "UINumTune", result,
                              {Header, Message, MsgArray, MsgArrayDim1, Wrap, Icon, nullptr},
                              {&InitValue, MinValue, MaxValue, false, &Increment},
                              {MaxTime, DIBreak, DIPassive, DOBreak, DOPassive, PersBoolBreak,
                               PersBoolPassive, BreakFlag, UIActiveSignal});
}

Status rt_UIDnumTune(TaskCore* task, double* result, const String* Header, const String* Message,
                     const String* MsgArray, int32_t MsgArrayDim1, bool Wrap, const float* Icon,
                     double InitValue, double Increment, const double* MinValue, const double* MaxValue,
                     const float* MaxTime, Handle* DIBreak, bool DIPassive, Handle* DOBreak, bool DOPassive,
                     bool* PersBoolBreak, bool PersBoolPassive, float* BreakFlag, Handle* UIActiveSignal) {
    return enterNumber<double>(task, "UIDnumTune", result,
                               {Header, Message, MsgArray, MsgArrayDim1, Wrap, Icon, nullptr},
                               {&InitValue, MinValue, MaxValue, false, &Increment},
                               {MaxTime, DIBreak, DIPassive, DOBreak, DOPassive, PersBoolBreak,
                                PersBoolPassive, BreakFlag, UIActiveSignal});
}

/// A text in quotation marks may be empty or begin with blanks; Enter alone takes InitString.
Status rt_UIAlphaEntry(TaskCore* task, String* result, const String* Header, const String* Message,
                       const String* MsgArray, int32_t MsgArrayDim1, bool Wrap, const float* Icon,
                       const String* InitString, const float* MaxTime, Handle* DIBreak, bool DIPassive,
                       Handle* DOBreak, bool DOPassive, bool* PersBoolBreak, bool PersBoolPassive,
                       float* BreakFlag, Handle* UIActiveSignal) {
    Dialog dialog;
    dialog.instruction = "UIAlphaEntry";
    if (const Status status =
            lib::fillText(task, {Header, Message, MsgArray, MsgArrayDim1, Wrap, Icon, nullptr}, dialog))
        return status;
    const std::string initial(InitString ? InitString->view() : std::string_view());
    dialog.initial = initial;
    if (!initial.empty()) dialog.hint = "Enter alone takes \"" + initial + "\"; \"\" is an empty text";
    std::string text;
    const auto accept = [&](const std::string& answer) {
        text = answer.empty() ? initial : answer;
        if (answer.size() >= 2 && answer.front() == '"' && answer.back() == '"')
            text = answer.substr(1, answer.size() - 2);
        if (text.size() <= kStringCapacity) return Reply::yes();
        return Reply::again("The text is too long: a string holds 80 bytes.");
    };
    bool answered = false;
    const Status status = lib::ask(task,
                                   {MaxTime, DIBreak, DIPassive, DOBreak, DOPassive, PersBoolBreak,
                                    PersBoolPassive, BreakFlag, UIActiveSignal},
                                   dialog, accept, answered);
    result->assign(answered ? text : initial);
    return status;
}
}
