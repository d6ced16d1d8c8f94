// dialogs.*, display.*: what the program asks and shows.

#include "config/json_text.h"
#include "runtime/sim/operator_panel.h"
#include "tools/pendant/areas.h"
#include "tools/pendant/hub.h"
#include "tools/pendant/support.h"
#include "tools/service/dialog_names.h"

#include <algorithm>
#include <deque>
#include <fmt/format.h>
#include <map>

namespace rapidc::pendant {

namespace {

using service::Change;
using Open = rt::OperatorPanel::OpenDialog;

constexpr std::size_t kMostLines = 100; // of the display, as the panel keeps

const char* kindOf(const rt::Dialog& dialog) {
    return dialog.answerable ? service::nameOf(dialog.kind) : "message";
}

Json describe(const Open& open) {
    const rt::Dialog& dialog = *open.dialog;
    Json described = {{"id", open.number},
                      {"task", open.task->name()},
                      {"instruction", dialog.instruction},
                      {"kind", kindOf(dialog)},
                      {"header", dialog.header},
                      {"lines", dialog.lines},
                      {"icon", dialog.icon},
                      {"image", dialog.image},
                      {"choices", dialog.choices},
                      {"items", dialog.items},
                      {"hint", dialog.hint},
                      {"initial", dialog.initial},
                      {"wholeNumbers", dialog.isWhole}};
    if (dialog.least) described["minimum"] = *dialog.least;
    if (dialog.most) described["maximum"] = *dialog.most;
    if (dialog.increment) described["increment"] = *dialog.increment;
    return described;
}

/// The place from 1 of one of the texts.
std::size_t placeOf(const Json& params, const char* name, const std::vector<std::string>& among) {
    const std::size_t last = std::max<std::size_t>(among.size(), 1);
    return static_cast<std::size_t>(wholeOf(params, name, 1, static_cast<int64_t>(last)));
}

/// A dialog without buttons of its own is answered with 1.
std::size_t buttonOf(const rt::Dialog& dialog, const Json& params) {
    const std::size_t button = placeOf(params, "choice", dialog.choices);
    if (!dialog.choices.empty() && !service::showsButton(dialog, button))
        badRequest("This button is not shown");
    return button;
}

/// An item, a button, or both; a button alone takes the default item.
std::string answerToList(const rt::Dialog& dialog, const Json& params) {
    std::string answer, button;
    if (has(params, "choice") && !dialog.choices.empty())
        button = dialog.choices[buttonOf(dialog, params) - 1];
    if (button.empty() || has(params, "item")) {
        const std::size_t item = placeOf(params, "item", dialog.items);
        if (!service::showsItem(dialog, item)) badRequest("This item is not shown");
        answer = std::to_string(item);
    }
    return answer.empty() || button.empty() ? answer + button : answer + " " + button;
}

/// UIMsgWrite: a message that stays while the program continues; its id is 0.
Json describe(const rt::PanelMessage& message) {
    return {{"id", 0},
            {"task", ""},
            {"instruction", "UIMsgWrite"},
            {"kind", "message"},
            {"header", message.header},
            {"lines", message.lines},
            {"icon", message.icon},
            {"image", message.image},
            {"choices", Json::array()},
            {"items", Json::array()},
            {"hint", ""},
            {"initial", ""}};
}

class DialogArea final : public Area {
  public:
    explicit DialogArea(const Context& context) : controller_(context.controller), hub_(context.hub) {
        service::Observer observer;
        observer.changed = [this](Change change, const rt::Task*) {
            if (change == Change::Generation) shown_.clear(), lines_.clear(), isDisplayed_ = false;
            if (change == Change::Dialog || change == Change::Display || change == Change::Generation)
                hub_.wake();
            isChanged_ = isChanged_ || change == Change::Dialog;
            isDisplayed_ = isDisplayed_ || change == Change::Display;
        };
        observer_ = controller_.observers().add(std::move(observer));
    }
    ~DialogArea() override { controller_.observers().remove(observer_); }
    DialogArea(const DialogArea&) = delete;
    DialogArea& operator=(const DialogArea&) = delete;

    void addTo(MethodTable& methods) override {
        methods.add("dialogs.list", [this](Client&, const Json&) { return Json{{"dialogs", list()}}; });
        methods.add("dialogs.answer", [this](Client&, const Json& params) { return answer(params); });
        methods.add("display.read", [this](Client&, const Json&) { return display(); });
    }
    void describe(Json& state) override {
        flush(); // what this answer holds is not notified after it
        state["dialogs"] = list();
        state["display"] = display();
    }
    void flush() override {
        if (std::exchange(isChanged_, false)) flushDialogs();
        if (std::exchange(isDisplayed_, false)) flushDisplay();
    }

  private:
    rt::OperatorPanel& panel() const { return controller_.core().panel(); }
    Json list() const {
        Json dialogs = Json::array();
        for (const Open& open : panel().openDialogs())
            dialogs.push_back(pendant::describe(open));
        if (panel().message()) dialogs.push_back(pendant::describe(*panel().message()));
        return dialogs;
    }
    Json display() const {
        const std::deque<std::string>& lines = panel().display();
        const std::size_t first = lines.size() - std::min(lines.size(), kMostLines);
        return {{"lines",
                 std::vector<std::string>(lines.begin() + static_cast<std::ptrdiff_t>(first), lines.end())}};
    }
    void flushDialogs();
    void flushDisplay();
    Json answer(const Json& params);

    service::VirtualController& controller_;
    Hub& hub_;
    service::Observers::Token observer_ = 0;
    std::map<uint64_t, Json> shown_; ///< dialogs that pages know of
    std::deque<std::string> lines_;  ///< of the display, as pages know them
    bool isChanged_ = false, isDisplayed_ = false;
};

void DialogArea::flushDialogs() {
    std::map<uint64_t, Json> now;
    for (Json& each : list()) {
        const auto id = each.at("id").get<uint64_t>();
        now[id] = std::move(each);
    }
    for (const auto& [id, dialog] : shown_)
        if (!now.contains(id)) hub_.broadcast("dialog", {{"closed", id}});
    for (const auto& [id, dialog] : now) {
        const auto before = shown_.find(id);
        if (before == shown_.end() || before->second != dialog)
            hub_.broadcast("dialog", {{"opened", dialog}});
    }
    shown_ = std::move(now);
}

/// The new lines, or everything when the display was erased meanwhile.
void DialogArea::flushDisplay() {
    const std::deque<std::string>& now = panel().display();
    std::size_t kept = std::min(lines_.size(), now.size()); // the end of what was is the beginning of what is
    const auto continues = [&] {
        return std::equal(lines_.end() - static_cast<std::ptrdiff_t>(kept), lines_.end(), now.begin());
    };
    while (kept > 0 && !continues())
        --kept;
    if (kept == 0 && !lines_.empty()) hub_.broadcast("display", {{"clear", true}});
    for (std::size_t i = kept; i < now.size(); ++i)
        hub_.broadcast("display", {{"line", now[i]}});
    lines_ = now;
}

Json DialogArea::answer(const Json& params) {
    const auto id = static_cast<uint64_t>(wholeOf(params, "id", 0, int64_t{1} << 53));
    const std::vector<Open> dialogs = panel().openDialogs();
    const auto open =
        std::find_if(dialogs.begin(), dialogs.end(), [&](const Open& each) { return each.number == id; });
    if (open == dialogs.end()) notFound("This dialog is not open any more");
    const rt::Dialog& dialog = *open->dialog;
    std::string answer;
    switch (dialog.kind) {
    case rt::DialogKind::Choice: answer = std::to_string(buttonOf(dialog, params)); break;
    case rt::DialogKind::List: answer = answerToList(dialog, params); break;
    case rt::DialogKind::Number: {
        const double number = numberOf(params, "number");
        if (!service::takesNumber(dialog, number))
            badRequest("The number is not one of those that may be entered");
        answer = fmt::format("{}", number);
        break;
    }
    case rt::DialogKind::Text: {
        const std::string text = textOf(params, "text");
        if (text.size() > rt::kStringCapacity)
            badRequest(fmt::format("A text has at most {} characters", rt::kStringCapacity));
        if (text.find_first_of("\r\n") != std::string::npos) badRequest("A text has one line");
        answer = "\"" + text + "\""; // as it is, even when it is empty
        break;
    }
    }
    if (!panel().answerDialog(id, answer)) refuseUnless("this dialog takes no answer");
    return {};
}

} // namespace

std::unique_ptr<Area> makeDialogArea(const Context& context) {
    return std::make_unique<DialogArea>(context);
}

} // namespace rapidc::pendant
