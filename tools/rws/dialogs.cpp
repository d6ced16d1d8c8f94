#include "tools/rws/dialogs.h"

#include "config/letter_case.h"
#include "runtime/base/text_util.h"
#include "runtime/value/value_text.h"
#include "tools/rws/rapid_support.h"
#include "tools/service/dialog_names.h"

#include <algorithm>
#include <fmt/format.h>

namespace rapidc::rws {

namespace {

using rapid::config::sameName;
using Open = rt::OperatorPanel::OpenDialog;

constexpr std::size_t kLongestMessage = 400; // bytes of an event

/// A dialog that waits, or the message of UIMsgWrite, as entries show it.
struct Shown {
    std::string instruction, event, stack, message;
    bool operator==(const Shown&) const = default;
};

std::string joined(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines)
        text += (text.empty() || line.empty() ? "" : " ") + line;
    return text;
}

std::string stackOf(const Open& open) {
    return fmt::format("RAPID/{}/%${}", open.task->name(), open.number);
}

std::optional<Shown> shownNow(service::VirtualController& controller) {
    const rt::OperatorPanel& panel = controller.core().panel();
    const std::vector<Open> open = panel.openDialogs();
    if (!open.empty()) {
        const rt::Dialog& dialog = *open.front().dialog;
        const std::string text = joined(dialog.lines);
        return Shown{dialog.instruction, "SEND", stackOf(open.front()), text.empty() ? dialog.header : text};
    }
    if (!panel.message()) return std::nullopt;
    const std::string text = joined(panel.message()->lines);
    return Shown{"UIMsgWrite", "POST", "", text.empty() ? panel.message()->header : text};
}

Entry entryOf(const char* type, const char* title, const Shown& shown) {
    Entry entry;
    entry.type = type;
    entry.title = title;
    return entry.value("instr", shown.instruction)
        .value("event", shown.event)
        .value("stack", shown.stack)
        .value("execlv", "Normal")
        .value("msg", shown.message);
}

/// "text" as RAPID writes it.
std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"') out += c;
        out += c;
    }
    return out + "\"";
}

/// ["a","b"] as clients read lists.
std::string listText(const std::vector<std::string>& items) {
    std::string out = "[";
    for (const std::string& item : items) {
        out += out.size() > 1 ? ",\"" : "\"";
        for (const char c : item) {
            if (c == '"' || c == '\\') out += '\\';
            out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
        }
        out += '"';
    }
    return out + "]";
}

/// The value that the operator begins with, under the name of its argument.
std::pair<std::string, std::string> initialOf(const rt::Dialog& dialog) {
    switch (dialog.kind) {
    case rt::DialogKind::Text: return {"InitString", quoted(dialog.initial)};
    case rt::DialogKind::List: return {"DefaultIndex", dialog.initial};
    case rt::DialogKind::Choice: return {"DefaultBtn", dialog.initial};
    case rt::DialogKind::Number: break;
    }
    return {"InitValue", dialog.initial};
}

/// The parameters of the instruction that a client shows, by name.
std::vector<std::pair<std::string, std::string>> parametersOf(const rt::Dialog& dialog) {
    std::vector<std::pair<std::string, std::string>> list;
    if (dialog.instruction.starts_with("TP")) {
        list.emplace_back("TPText", quoted(joined(dialog.lines)));
        for (std::size_t i = 0; i < dialog.choices.size(); ++i)
            list.emplace_back(fmt::format("TPFK{}", i + 1), quoted(dialog.choices[i]));
        list.emplace_back("TPAnswer", "0");
        list.emplace_back("TPCompleted", "FALSE");
        return list;
    }
    list.emplace_back("Header", quoted(dialog.header));
    list.emplace_back("MsgArray", listText(dialog.lines));
    if (!dialog.choices.empty()) list.emplace_back("BtnArray", listText(dialog.choices));
    if (!dialog.items.empty()) list.emplace_back("ListItems", listText(dialog.items));
    if (!dialog.image.empty()) list.emplace_back("Image", quoted(dialog.image));
    if (!dialog.initial.empty()) list.emplace_back(initialOf(dialog));
    if (dialog.least) list.emplace_back("MinValue", fmt::format("{}", *dialog.least));
    if (dialog.most) list.emplace_back("MaxValue", fmt::format("{}", *dialog.most));
    static constexpr const char* kIcons[] = {"", "Information", "Warning", "Error"};
    const auto* icon = std::find(std::begin(kIcons), std::end(kIcons), dialog.icon);
    list.emplace_back("Icon", std::to_string(icon == std::end(kIcons) ? 0 : icon - std::begin(kIcons)));
    list.emplace_back("Result", dialog.kind == rt::DialogKind::Text ? "\"\"" : "0");
    return list;
}

/// The name of the parameter that takes the answer.
bool takesAnswer(std::string_view name) {
    for (const char* known : {"Result", "TPAnswer", "ResultIndex", "Answer", "UIAnswer"})
        if (sameName(name, known)) return true;
    return false;
}

/// The number of a button: the value that the program gets for it, or its place from 1. 0: there is none.
std::size_t buttonOf(const rt::Dialog& dialog, double value) {
    for (std::size_t i = 0; i < dialog.results.size(); ++i)
        if (static_cast<double>(dialog.results[i]) == value && service::showsButton(dialog, i + 1))
            return i + 1;
    const bool isPlace = value >= 1 && value <= static_cast<double>(dialog.choices.size());
    const auto place = isPlace ? static_cast<std::size_t>(value) : 0;
    return static_cast<double>(place) == value && service::showsButton(dialog, place) ? place : 0;
}

/// "3", "3 Cancel" or "Cancel": an item, a button, or both. None: the list shows no such item or button.
std::optional<std::string> itemOf(const rt::Dialog& dialog, const std::string& text) {
    const std::size_t digits = std::min(text.find_first_not_of("0123456789"), text.size());
    const std::string button(rt::trimmed(std::string_view(text).substr(digits)));
    if (digits == 0 && button.empty()) return std::nullopt;
    const auto isItem = [&dialog](const std::string& number) {
        return number.size() <= 9 && service::showsItem(dialog, std::stoul(number));
    };
    if (digits > 0 && !isItem(text.substr(0, digits))) return std::nullopt;
    if (button.empty()) return text;
    const bool isShown = std::any_of(dialog.choices.begin(), dialog.choices.end(),
                                     [&button](const auto& choice) { return sameName(choice, button); });
    return isShown ? std::optional(text) : std::nullopt;
}

/// The answer as the dialog takes it. None: it makes no sense.
std::optional<std::string> answerOf(const rt::Dialog& dialog, const std::string& given) {
    double number = 0;
    const std::string text(rt::trimmed(given));
    const bool isNumber = rt::parseRapidNumber(text, number);
    switch (dialog.kind) {
    case rt::DialogKind::Choice: {
        for (std::size_t i = 0; i < dialog.choices.size(); ++i)
            if (!dialog.choices[i].empty() && sameName(dialog.choices[i], text)) return std::to_string(i + 1);
        const std::size_t button = isNumber ? buttonOf(dialog, number) : 0;
        return button > 0 ? std::optional(std::to_string(button)) : std::nullopt;
    }
    case rt::DialogKind::Number:
        return isNumber && service::takesNumber(dialog, number) ? std::optional(text) : std::nullopt;
    case rt::DialogKind::List: return itemOf(dialog, text);
    case rt::DialogKind::Text: break;
    }
    const bool isQuoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
    if (given.size() > rt::kStringCapacity + (isQuoted ? 2 : 0)) return std::nullopt;
    return isQuoted ? text : "\"" + given + "\""; // as it is, even when it is empty
}

const Open* dialogOf(const std::vector<Open>& open, const Request& request) {
    std::string stack = request.parameter("stack");
    if (stack.starts_with('/')) stack.erase(0, 1);
    for (const Open& each : open)
        if (sameName(stackOf(each), stack)) return &each;
    return nullptr;
}

/// Reports dialogs that open and close.
class DialogWatch final : public Watch {
  public:
    DialogWatch(service::VirtualController& controller, Changed changed)
        : controller_(controller), changed_(std::move(changed)), last_(shownNow(controller)) {
        service::Observer observer;
        observer.changed = [this](service::Change change, const rt::Task*) {
            if (change == service::Change::Dialog || change == service::Change::Generation) look();
        };
        token_ = controller_.observers().add(std::move(observer));
    }
    ~DialogWatch() override { controller_.observers().remove(token_); }
    DialogWatch(const DialogWatch&) = delete;
    DialogWatch& operator=(const DialogWatch&) = delete;

    std::optional<Entry> now() const { return last_ ? std::optional(event(*last_)) : std::nullopt; }

  private:
    static Entry event(Shown shown) {
        if (shown.message.size() > kLongestMessage) shown.message.resize(kLongestMessage);
        // events of different dialogs are not merged, because their titles differ
        return entryOf("rap-ui-ev", shown.stack.empty() ? "uievent" : shown.stack.c_str(), shown);
    }
    void look() {
        const std::optional<Shown> now = shownNow(controller_);
        if (now == last_) return;
        if (last_ && last_->event == "SEND") {
            last_->event = "ABORT";
            changed_(event(*last_));
        }
        last_ = now;
        if (last_) changed_(event(*last_));
    }

    service::VirtualController& controller_;
    Changed changed_;
    std::optional<Shown> last_;
    service::Observers::Token token_ = 0;
};

} // namespace

void Dialogs::addTo(Router& router, Subscribables& subscribables) {
    const std::string root = "/rw/rapid/uiinstr";
    router.getBoth(root, [](const Request&) { return folder({{"rap-uiactive-li", "uiinstr/active"}}); });
    router.getBoth(root + "/active", [this](const Request& request) { return active(request); });
    router.getBoth(root + "/active/params/{stack*}",
                   [this](const Request& request) { return parameters(request); });
    router.getBoth(root + "/active/param/{stack*}/{name}",
                   [this](const Request& request) { return parameter(request); });
    const Handler set = [this](const Request& request) { return answer(request); };
    router.postBoth(root + "/active/param/{stack*}/{name}", set);
    router.action(root + "/active/param/{stack*}/{name}", "set", set);
    subscribables.add(
        {root,
         "uievent",
         false,
         {},
         [this](const Request&, const Changed& changed, Subscription& out) -> std::optional<Failure> {
             auto watch = std::make_unique<DialogWatch>(controller_, changed);
             if (const std::optional<Entry> now = watch->now()) out.initial.push_back(*now);
             out.watch = std::move(watch);
             return std::nullopt;
         }});
}

Reply Dialogs::active(const Request& request) {
    const std::optional<Shown> shown = shownNow(controller_);
    if (!shown) return Reply::refuse(ReturnCode::NotFound, "No dialog is open");
    Document document;
    document.entries.push_back(
        entryOf(request.dialect == Dialect::V1 ? "rap-uiactive-li" : "rap-uiinstr-li", "active", *shown));
    return Reply::of(std::move(document));
}

Reply Dialogs::parameters(const Request& request) {
    const std::vector<Open> open = controller_.core().panel().openDialogs();
    const Open* dialog = dialogOf(open, request);
    if (dialog == nullptr) return Reply::refuse(ReturnCode::NotFound, "This dialog is not open");
    Document document;
    document.place = Document::Place::Resources;
    for (const auto& [name, value] : parametersOf(*dialog->dialog))
        document.add("rap-uiparams-li", name).value("value", value);
    return Reply::of(std::move(document));
}

Reply Dialogs::parameter(const Request& request) {
    const std::vector<Open> open = controller_.core().panel().openDialogs();
    const Open* dialog = dialogOf(open, request);
    if (dialog == nullptr) return Reply::refuse(ReturnCode::NotFound, "This dialog is not open");
    for (const auto& [name, value] : parametersOf(*dialog->dialog)) {
        if (!sameName(name, request.parameter("name"))) continue;
        Document document;
        document.add("rap-uiparam", name).value("value", value);
        return Reply::of(std::move(document));
    }
    return Reply::refuse(ReturnCode::NotFound, "The instruction has no such parameter");
}

Reply Dialogs::answer(const Request& request) {
    rt::OperatorPanel& panel = controller_.core().panel();
    const std::vector<Open> open = panel.openDialogs();
    const Open* dialog = dialogOf(open, request);
    if (dialog == nullptr) return Reply::refuse(ReturnCode::NotFound, "This dialog is not open");
    const std::string& name = request.parameter("name");
    if (sameName(name, "TPCompleted")) return Reply::done(); // the answer itself ends the dialog
    if (!takesAnswer(name)) return badParameter("the parameter", "Result");
    if (!request.form.has("value")) return badParameter("value", "the answer");
    const std::optional<std::string> answer = answerOf(*dialog->dialog, request.form.text("value"));
    if (!answer) return badParameter("value", "an answer that the dialog takes");
    if (!panel.answerDialog(dialog->number, *answer))
        return Reply::refuse(ReturnCode::Rejected, "This dialog takes no answer");
    return Reply::done();
}

} // namespace rapidc::rws
