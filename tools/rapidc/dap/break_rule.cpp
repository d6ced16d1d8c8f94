#include "tools/rapidc/dap/break_rule.h"

#include "runtime/base/text_util.h"
#include "runtime/sched/error_search.h"
#include "runtime/value/value_text.h"

#include <charconv>
#include <cstring>
#include <fmt/format.h>

namespace rapidc::dap {

BreakRule::BreakRule(Context& context, std::string condition, std::string hitCondition,
                     std::string logMessage)
    : context_(context), condition_(rt::trimmed(condition)), hitCondition_(rt::trimmed(hitCondition)) {
    wrong_ = readHits();
    if (wrong_.empty()) wrong_ = readLog(logMessage);
}

/// "3", ">= 3", "% 2" ...
std::string BreakRule::readHits() {
    if (hitCondition_.empty()) return "";
    std::string_view text = hitCondition_;
    struct Word {
        const char* spelling;
        Hits meaning;
    };
    static constexpr Word kWords[] = {{">=", Hits::AtLeast}, {"<=", Hits::AtMost}, {"==", Hits::Equal},
                                      {">", Hits::More},     {"<", Hits::Less},    {"=", Hits::Equal},
                                      {"%", Hits::Multiple}};
    hits_ = Hits::Equal;
    for (const Word& word : kWords) {
        if (text.rfind(word.spelling, 0) != 0) continue;
        hits_ = word.meaning;
        text.remove_prefix(std::strlen(word.spelling));
        break;
    }
    text = rt::trimmed(text);
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), wanted_);
    const bool number = problem == std::errc() && end == text.data() + text.size() && !text.empty();
    if (number && (wanted_ > 0 || (hits_ != Hits::Equal && hits_ != Hits::Multiple))) return "";
    return fmt::format("the hit count '{}' is not a number such as 3, >= 3 or % 2", hitCondition_);
}

/// Text with expressions in braces; an expression may hold braces of its own (indices) and strings.
std::string BreakRule::readLog(const std::string& message) {
    std::string plain;
    for (std::size_t i = 0; i < message.size(); ++i) {
        if (message[i] == '\\' && i + 1 < message.size() && std::strchr("{}\\", message[i + 1]) != nullptr) {
            plain += message[++i];
            continue;
        }
        if (message[i] != '{') {
            plain += message[i];
            continue;
        }
        std::size_t end = i + 1;
        bool inText = false;
        for (int depth = 1; end < message.size(); ++end) {
            if (message[end] == '"') inText = !inText;
            if (!inText && message[end] == '{') ++depth;
            if (!inText && message[end] == '}' && --depth == 0) break;
        }
        if (end >= message.size()) return "a '{' in the log message is not closed";
        if (!plain.empty()) log_.push_back({std::exchange(plain, {}), false});
        log_.push_back({message.substr(i + 1, end - i - 1), true});
        i = end;
    }
    if (!plain.empty()) log_.push_back({plain, false});
    return "";
}

std::string BreakRule::problem(int32_t task, const rt::RoutineDesc* routine) const {
    if (!wrong_.empty() || !context_.evaluator) return wrong_;
    Evaluator& evaluator = *context_.evaluator;
    if (!condition_.empty()) {
        // The whole is a bool; the check of the expression alone would not tell.
        std::string wrong = evaluator.check(task, routine, condition_, ExpressionKind::Value);
        if (wrong.empty() &&
            evaluator.check(task, routine, "NOT (" + condition_ + "\n)", ExpressionKind::Value) != "")
            wrong = "the condition is not a bool";
        if (!wrong.empty()) return wrong;
    }
    for (const Piece& piece : log_) {
        if (!piece.isExpression) continue;
        const std::string wrong = evaluator.check(task, routine, piece.text, ExpressionKind::Value);
        if (!wrong.empty()) return fmt::format("{{{}}}: {}", piece.text, wrong);
    }
    return "";
}

bool BreakRule::holds(rt::Task& task, rt::Frame* at) {
    if (condition_.empty()) return true;
    std::string problem;
    const Site site{&task, at};
    const CompiledExpression* code =
        context_.evaluator->compile(site, condition_, ExpressionKind::Value, problem);
    if (code != nullptr) {
        const Evaluation result = context_.evaluator->now(site, *code);
        problem = result.problem;
        if (result.hasValue && result.value.type->kind == rt::DescKind::Bool)
            return *static_cast<const unsigned char*>(result.value.data) != 0;
    }
    context_.client.output("important", fmt::format("condition '{}': {}", condition_, problem),
                           context_.place(rt::placeOf(at)));
    return true; // stops: the person is to see it
}

bool BreakRule::countsNow() {
    ++count_;
    switch (hits_) {
    case Hits::Every: return true;
    case Hits::Equal: return count_ == wanted_;
    case Hits::AtLeast: return count_ >= wanted_;
    case Hits::More: return count_ > wanted_;
    case Hits::Less: return count_ < wanted_;
    case Hits::AtMost: return count_ <= wanted_;
    case Hits::Multiple: return count_ % wanted_ == 0;
    }
    return true;
}

std::string BreakRule::textOf(const std::string& expression, const Site& site) {
    Evaluation result = context_.evaluator->find(site, expression);
    if (!result.hasValue) {
        std::string problem;
        const CompiledExpression* code =
            context_.evaluator->compile(site, expression, ExpressionKind::Value, problem);
        if (code == nullptr) return fmt::format("<{}>", problem);
        result = context_.evaluator->now(site, *code);
        if (!result.hasValue) return fmt::format("<{}>", result.problem);
    }
    const rt::DebugVariable& value = result.value;
    if (value.data != nullptr && value.rank == 0 && value.type->kind == rt::DescKind::String)
        return std::string(static_cast<const rt::String*>(value.data)->view());
    return rt::valueText(value);
}

void BreakRule::writeLog(rt::Task& task, rt::Frame* at) {
    std::string text;
    for (const Piece& piece : log_)
        text += piece.isExpression ? textOf(piece.text, {&task, at}) : piece.text;
    context_.client.output("console", text, context_.place(rt::placeOf(at)));
}

bool BreakRule::accepts(rt::Task& task, rt::Frame* at) {
    // Conditions and messages take much longer than the instructions that the budget counts: a request must not wait for its end.
    if (context_.inbox.hasCommands()) task.forceSafepoint();
    if (!context_.evaluator || !holds(task, at) || !countsNow()) return false;
    if (log_.empty()) return true;
    writeLog(task, at);
    return false;
}

} // namespace rapidc::dap
