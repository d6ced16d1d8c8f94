#include "tools/rapidc/dap/operator_dialogs.h"

#include "runtime/base/text_util.h"
#include "runtime/sim/operator_panel.h"
#include "tools/service/dialog_names.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>

namespace rapidc::dap {

namespace {

using Open = rt::OperatorPanel::OpenDialog;

Json describe(const Open& open) {
    const rt::Dialog& dialog = *open.dialog;
    Json json{{"id", open.number},
              {"instruction", dialog.instruction},
              {"kind", service::nameOf(dialog.kind)},
              {"header", dialog.header},
              {"lines", dialog.lines},
              {"choices", dialog.kind == rt::DialogKind::List ? dialog.items : dialog.choices},
              {"hint", dialog.hint}};
    if (open.task != nullptr) json["threadId"] = Context::threadOf(*open.task);
    return json;
}

/// The number of a choice, which is given by its number from 1 or by its text.
std::string choiceIn(const std::vector<std::string>& choices, const std::string& answer) {
    if (choices.empty()) return answer; // any key will do
    for (std::size_t i = 0; i < choices.size(); ++i)
        if (!choices[i].empty() && (answer == choices[i] || answer == std::to_string(i + 1)))
            return std::to_string(i + 1);
    throw Refusal(fmt::format("'{}' is none of the choices", answer));
}

/// As a person would type it at the terminal.
std::string typed(const rt::Dialog& dialog, const std::string& answer) {
    if (answer.find_first_of("\r\n") != std::string::npos) throw Refusal("an answer has one line");
    switch (dialog.kind) {
    case rt::DialogKind::Choice: return choiceIn(dialog.choices, answer);
    case rt::DialogKind::List: return choiceIn(dialog.items, answer);
    case rt::DialogKind::Number: {
        const std::string_view text = rt::trimmed(answer);
        double value = 0;
        const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (problem != std::errc() || end != text.data() + text.size())
            throw Refusal(fmt::format("'{}' is not a number", answer));
        return std::string(text);
    }
    case rt::DialogKind::Text: break;
    }
    if (answer.size() > rt::kStringCapacity)
        throw Refusal(fmt::format("a text has at most {} characters", rt::kStringCapacity));
    return "\"" + answer + "\""; // as it is, even when it is empty
}

} // namespace

void OperatorDialogs::addTo(Handlers& handlers) {
    handlers["rapidcAnswerDialog"] = [this](const Request&, const Arguments& arguments) {
        return std::optional<Json>(answer(arguments));
    };
}

void OperatorDialogs::begin(bool answered) {
    isOn_ = answered;
    holds_ = false;
    open_.clear();
    if (!isOn_) return;
    context_.controller().panel().setAnsweredByClients();
    context_.controller().onSleep([this] { look(); });
}

void OperatorDialogs::look() {
    if (!isOn_) return;
    rt::Controller& controller = context_.controller();
    std::set<uint64_t> now;
    for (const Open& open : controller.panel().openDialogs()) {
        if (!open.dialog->answerable) continue;
        now.insert(open.number);
        if (!open_.contains(open.number)) context_.client.event("rapidcDialog", {{"opened", describe(open)}});
    }
    for (const uint64_t number : open_)
        if (!now.contains(number)) context_.client.event("rapidcDialog", {{"closed", number}});
    open_ = std::move(now);
    if (holds_ == !open_.empty()) return;
    holds_ = !holds_;
    rt::Scheduler& scheduler = controller.scheduler();
    scheduler.setResident(holds_);
    if (holds_)
        scheduler.holdPace();
    else
        scheduler.releasePace();
}

Json OperatorDialogs::answer(const Arguments& arguments) {
    const int64_t id = arguments.number("id");
    const std::string text = arguments.text("answer");
    rt::OperatorPanel& panel = context_.controller().panel();
    for (const Open& open : panel.openDialogs()) {
        if (id < 0 || open.number != static_cast<uint64_t>(id) || !open.dialog->answerable) continue;
        panel.answerDialog(open.number, typed(*open.dialog, text));
        look();
        return nullptr;
    }
    throw Refusal(fmt::format("no dialog {} is open", id));
}

} // namespace rapidc::dap
