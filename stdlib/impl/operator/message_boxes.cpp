// Manual 1.10: UIMsgBox and UIMessageBox, which wait for a button; UIMsgWrite, which does not.

#include "stdlib/impl/operator/question.h"
#include "stdlib/impl/support/fail.h"

#include "natives/operator.h"
#include "natives/operator_dialogs.h"
#include "stdlib_constants.h"

#include <memory>

using namespace rt;
using lib::Breaks;
using lib::Reply;

namespace {

/// `button` stays as it is when the dialog is broken off.
Status askButton(TaskCore* task, const char* instruction, const lib::MessageText& text,
                 const lib::Buttons& buttons, const Breaks& breaks, float& button) {
    if (const Status status = buttons.requireEnd(task, breaks)) return status;
    Dialog dialog;
    dialog.kind = DialogKind::Choice;
    dialog.instruction = instruction;
    if (const Status status = lib::fillText(task, text, dialog)) return status;
    dialog.choices = buttons.texts();
    dialog.results = buttons.results();
    dialog.answerable = !dialog.choices.empty();
    int chosen = -1;
    const auto accept = [&](const std::string& answer) {
        chosen = buttons.named(answer);
        if (answer.empty() && buttons.texts().size() == 1) chosen = 0; // just Enter
        return chosen >= 0 ? Reply::yes() : Reply::again("The number or the text of a button is expected.");
    };
    bool answered = false;
    const Status status = lib::ask(task, breaks, dialog, accept, answered);
    if (answered) button = buttons.result(chosen);
    return status;
}

/// The message that UIMsgWrite shows, until it is removed.
class ShownMessage {
  public:
    ShownMessage(TaskCore* task, const bool* ends, bool endValue, const Handle* active)
        : scheduler_(taskOf(task).scheduler()), panel_(taskOf(task).controller().panel()),
          active_(std::make_unique<lib::ActiveSignal>(task, active)) {
        if (!ends || active_->status() != kOk) return;
        watch_ = scheduler_.watchData([this, ends, endValue] {
            if (*ends == endValue) remove();
        });
    }
    ~ShownMessage() { scheduler_.unwatchData(watch_); }
    ShownMessage(const ShownMessage&) = delete;
    ShownMessage& operator=(const ShownMessage&) = delete;

    Status status() const { return active_ ? active_->status() : kOk; }
    void remove() {
        panel_.removeMessage();
        active_.reset();
    }

  private:
    Scheduler& scheduler_;
    OperatorPanel& panel_;
    std::unique_ptr<lib::ActiveSignal> active_;
    EventToken watch_ = 0;
};

struct Messages {
    std::unique_ptr<ShownMessage> shown;
};

/// The persistent of that name, as the task sees it; null and an error when there is none.
const bool* persistentNamed(TaskCore* task, const String& name, Status& status) {
    const GlobalDesc* data = taskOf(task).controller().findGlobal(name.view(), {}, taskOf(task));
    if (data && data->kind == kGlobalPersistent && data->type->kind == DescKind::Bool)
        return static_cast<const bool*>(data->address);
    status = lib::fail(task, err::ERR_REFUNKDAT,
                       "there is no persistent of type bool named " + std::string(name.view()));
    return nullptr;
}

} // namespace

extern "C" {

Status rt_UIMsgBox(TaskCore* task, const String* Header, const String* MsgLine1, const String* MsgLine2,
                   const String* MsgLine3, const String* MsgLine4, const String* MsgLine5, bool Wrap,
                   const float* Buttons, const float* Icon, const String* Image, float* Result,
                   const float* MaxTime, Handle* DIBreak, bool DIPassive, Handle* DOBreak, bool DOPassive,
                   bool* PersBoolBreak, bool PersBoolPassive, float* BreakFlag, Handle* UIActiveSignal) {
    const String* given[] = {MsgLine1, MsgLine2, MsgLine3, MsgLine4, MsgLine5};
    String lines[5];
    for (std::size_t i = 0; i < 5; ++i)
        if (given[i]) lines[i] = *given[i];
    lib::Buttons buttons;
    if (const Status status = buttons.read(task, Buttons, nullptr, 0, k::btnOK)) return status;
    float button = k::resUnkwn;
    const Status status = askButton(task, "UIMsgBox", {Header, nullptr, lines, 5, Wrap, Icon, Image}, buttons,
                                    {MaxTime, DIBreak, DIPassive, DOBreak, DOPassive, PersBoolBreak,
                                     PersBoolPassive, BreakFlag, UIActiveSignal},
                                    button);
    if (status == kOk && Result) *Result = button;
    return status;
}

Status rt_UIMessageBox(TaskCore* task, float* result, const String* Header, const String* Message,
                       const String* MsgArray, int32_t MsgArrayDim1, bool Wrap, const float* Buttons,
                       const String* BtnArray, int32_t BtnArrayDim1, const float* DefaultBtn,
                       const float* Icon, const String* Image, const float* MaxTime, Handle* DIBreak,
                       bool DIPassive, Handle* DOBreak, bool DOPassive, bool* PersBoolBreak,
                       bool PersBoolPassive, float* BreakFlag, Handle* UIActiveSignal) {
    lib::Buttons buttons;
    if (const Status status = buttons.read(task, Buttons, BtnArray, BtnArrayDim1, k::btnOK)) return status;
    float button = DefaultBtn ? *DefaultBtn : k::resUnkwn;
    const Status status =
        askButton(task, "UIMessageBox", {Header, Message, MsgArray, MsgArrayDim1, Wrap, Icon, Image}, buttons,
                  {MaxTime, DIBreak, DIPassive, DOBreak, DOPassive, PersBoolBreak, PersBoolPassive, BreakFlag,
                   UIActiveSignal},
                  button);
    *result = button;
    return status;
}

Status rt_UIMsgWrite(TaskCore* task, const String* Header, const String* Message, const String* MsgArray,
                     int32_t MsgArrayDim1, bool Wrap, const float* Icon, const String* Image, bool* PersBool,
                     const String* PersBoolName, const bool* AbortValue, Handle* UIActiveSignal) {
    PanelMessage message;
    Status status = lib::checkConnected(task);
    if (status == kOk)
        status = lib::fillText(task, {Header, Message, MsgArray, MsgArrayDim1, Wrap, Icon, Image},
                               message.header, message.icon, message.image, message.lines);
    const bool* ends = PersBool;
    if (status == kOk && PersBoolName) ends = persistentNamed(task, *PersBoolName, status);
    if (status != kOk) return status;
    Controller& controller = taskOf(task).controller();
    std::unique_ptr<ShownMessage>& shown = controller.service<Messages>().shown;
    shown.reset();
    shown = std::make_unique<ShownMessage>(task, ends, AbortValue ? *AbortValue : true, UIActiveSignal);
    if (shown->status() != kOk) return shown->status();
    controller.panel().showMessage(std::move(message));
    return kOk;
}

Status rt_UIMsgWriteAbort(TaskCore* task) {
    Controller& controller = taskOf(task).controller();
    if (auto& shown = controller.service<Messages>().shown) shown->remove();
    controller.service<Messages>().shown.reset();
    return kOk;
}
}
