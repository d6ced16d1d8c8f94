// Manual 1.10: UIListView. A terminal shows a long list in pages, which can be filtered.

#include "runtime/base/text_util.h"
#include "stdlib/impl/operator/question.h"
#include "stdlib/impl/support/fail.h"

#include "natives/operator_dialogs.h"
#include "stdlib_constants.h"

#include <algorithm>
#include <charconv>

using namespace rt;
using lib::Breaks;
using lib::Reply;

namespace {

constexpr std::size_t kPage = 20;

/// The part of the list that a terminal shows.
class Pages {
  public:
    /// `standard` is the number of the item that an empty line takes, 0 for none; its page comes first.
    Pages(Dialog& dialog, std::size_t standard) : dialog_(dialog), standard_(standard) { filter({}); }

    /// "+", "-" and "/text"; false for an answer that is something else.
    bool take(std::string_view answer) {
        if (answer == "+")
            first_ = first_ + kPage < found_.size() ? first_ + kPage : first_;
        else if (answer == "-")
            first_ = first_ < kPage ? 0 : first_ - kPage;
        else if (!answer.empty() && answer[0] == '/')
            return filter(upperCase(answer.substr(1))), true;
        else
            return false;
        show();
        return true;
    }

  private:
    void filter(const std::string& part) {
        found_.clear();
        for (std::size_t i = 0; i < dialog_.items.size(); ++i) {
            const std::string& item = dialog_.items[i];
            if (!item.empty() && upperCase(item).find(part) != std::string::npos) found_.push_back(i + 1);
        }
        filtered_ = !part.empty();
        const auto standard = std::find(found_.begin(), found_.end(), standard_);
        first_ = standard == found_.end()
                     ? 0
                     : static_cast<std::size_t>(standard - found_.begin()) / kPage * kPage;
        show();
    }
    void show() {
        const std::size_t end = std::min(first_ + kPage, found_.size());
        dialog_.visible.assign(found_.begin() + static_cast<std::ptrdiff_t>(first_),
                               found_.begin() + static_cast<std::ptrdiff_t>(end));
        dialog_.hint = "the number of an item";
        if (!dialog_.choices.empty()) dialog_.hint += ", and the text of a button after it";
        if (standard_ > 0) dialog_.hint += "; Enter alone takes " + std::to_string(standard_);
        if (found_.size() > kPage || filtered_)
            dialog_.hint += "; " + std::to_string(dialog_.visible.size()) + " of " +
                            std::to_string(found_.size()) +
                            (filtered_ ? " found items are shown" : " items are shown") +
                            ": + and - turn the page, /text finds, / shows all";
    }

    Dialog& dialog_;
    std::size_t standard_;
    std::vector<std::size_t> found_; ///< numbers of the items that the filter lets through
    std::size_t first_ = 0;
    bool filtered_ = false;
};

/// "3", "3 Cancel" or "Cancel": an item, 0 when none is named, and a button, -1 when none is.
struct Chosen {
    std::size_t item = 0;
    int button = -1;

    bool read(const std::string& answer, const Dialog& dialog, const lib::Buttons& buttons) {
        const char* end = answer.data() + answer.size();
        const auto [rest, error] = std::from_chars(answer.data(), end, item);
        if (error != std::errc()) {
            item = 0;
            button = buttons.named(answer);
            return button >= 0;
        }
        if (item < 1 || item > dialog.items.size() || dialog.items[item - 1].empty()) return false;
        const std::string_view named = trimmed(std::string_view(rest, static_cast<std::size_t>(end - rest)));
        button = named.empty() ? -1 : buttons.named(named);
        return named.empty() || button >= 0;
    }
};

/// An item needs a text or an image to be seen.
std::vector<std::string> itemTexts(const data::Listitem* items, int32_t count) {
    std::vector<std::string> texts;
    for (int32_t i = 0; i < count; ++i) {
        std::string text(items[i].text.view());
        if (items[i].image.size() > 0)
            text += (text.empty() ? "(image " : " (image ") + std::string(items[i].image.view()) + ")";
        texts.push_back(std::move(text));
    }
    return texts;
}

} // namespace

extern "C" {

Status rt_UIListView(TaskCore* task, float* result, float* Result, const String* Header,
                     const data::Listitem* ListItems, int32_t ListItemsDim1, const float* ButtonSet,
                     const String* BtnArray, int32_t BtnArrayDim1, const float* Icon,
                     const float* DefaultIndex, const float* MaxTime, Handle* DIBreak, bool DIPassive,
                     Handle* DOBreak, bool DOPassive, bool* PersBoolBreak, bool PersBoolPassive,
                     float* BreakFlag, Handle* UIActiveSignal) {
    const Breaks breaks{MaxTime,       DIBreak,         DIPassive, DOBreak,       DOPassive,
                        PersBoolBreak, PersBoolPassive, BreakFlag, UIActiveSignal};
    lib::Buttons buttons;
    if (const Status status = buttons.read(task, ButtonSet, BtnArray, BtnArrayDim1, k::btnNone))
        return status;
    Dialog dialog;
    dialog.kind = DialogKind::List;
    dialog.instruction = "UIListView";
    if (const Status status =
            lib::fillText(task, {Header, nullptr, nullptr, 0, false, Icon, nullptr}, dialog))
        return status;
    dialog.items = itemTexts(ListItems, ListItemsDim1);
    dialog.choices = buttons.texts();
    dialog.results = buttons.results();
    const bool empty =
        std::all_of(dialog.items.begin(), dialog.items.end(), [](const auto& item) { return item.empty(); });
    if (empty && buttons.texts().empty())
        return lib::fail(task, err::ERR_ARGVALERR, "no item of the list has a text, and there is no button");
    const float standard = DefaultIndex ? *DefaultIndex : 0;
    if (!(standard >= 0 && standard <= static_cast<float>(ListItemsDim1)))
        return lib::failWith(task, err::ERR_ARGVALERR, "DefaultIndex is {}; the list has {} items",
                             static_cast<double>(standard), ListItemsDim1);
    if (standard > 0) dialog.initial = std::to_string(static_cast<int>(standard));
    Pages pages(dialog, static_cast<std::size_t>(standard));
    Chosen chosen;
    const auto accept = [&](const std::string& answer) {
        if (answer.empty() && standard > 0) return chosen = {}, Reply::yes();
        if (pages.take(answer)) return Reply::again({});
        if (chosen.read(answer, dialog, buttons)) return Reply::yes();
        return Reply::again("The number of an item is expected.");
    };
    bool answered = false;
    const Status status = lib::ask(task, breaks, dialog, accept, answered);
    *result = answered && chosen.item > 0 ? static_cast<float>(chosen.item) : standard;
    if (!Result) return status;
    *Result = k::resUnkwn;
    if (answered && !buttons.texts().empty()) *Result = buttons.result(std::max(chosen.button, 0));
    return status;
}
}
