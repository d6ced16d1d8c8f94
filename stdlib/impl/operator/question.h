#pragma once
// Questions to the operator (manual 1.10): the optional arguments that all dialogs share, their ends, and their texts.

#include "runtime/host/controller.h"

#include <functional>
#include <string>
#include <vector>

namespace rt::lib {

/// The optional arguments that may end a dialog early, and the signal that shows that it is open. Null: not present.
struct Breaks {
    const float* maxTime = nullptr; ///< s
    const Handle* input = nullptr;
    bool inputPassive = false;
    const Handle* output = nullptr;
    bool outputPassive = false;
    const bool* persistent = nullptr;
    bool persistentPassive = false;
    float* breakFlag = nullptr;
    const Handle* active = nullptr; ///< \UIActiveSignal
};

/// How an answer is taken: with a reason it is asked for again.
struct Reply {
    bool accepted = false;
    std::string why; ///< shown to the operator
    static Reply yes() { return {true, {}}; }
    static Reply again(std::string reason) { return {false, std::move(reason)}; }
};
using Accept = std::function<Reply(const std::string& answer)>;

/// Asks until `accept` takes an answer, which may change the dialog for the next time. `answered` is false when the dialog
/// ended otherwise and \BreakFlag says how; without \BreakFlag that raises ERR_TP_MAXTIME, ERR_TP_DIBREAK,
/// ERR_TP_DOBREAK, ERR_TP_PERSBOOLBREAK or ERR_TP_NO_CLIENT.
Status ask(TaskCore* task, const Breaks& breaks, Dialog& dialog, const Accept& accept, bool& answered);

/// ERR_TP_NO_CLIENT while no FlexPendant is connected.
Status checkConnected(TaskCore* task);

/// Sets a digital output as long as it exists (\UIActiveSignal).
class ActiveSignal {
  public:
    /// `handle` may be null. status(): why the signal cannot be set.
    ActiveSignal(TaskCore* task, const Handle* handle);
    ~ActiveSignal();
    ActiveSignal(const ActiveSignal&) = delete;
    ActiveSignal& operator=(const ActiveSignal&) = delete;
    Status status() const { return status_; }

  private:
    IoSystem& io_;
    Handle signal_ = 0;
    Status status_ = kOk;
};

/// The text of a dialog: \Message or \MsgArray; null: neither is present.
struct MessageText {
    const String* header = nullptr;
    const String* message = nullptr;
    const String* lines = nullptr;
    int32_t lineCount = 0;
    bool wrap = false; ///< all lines as one text, broken at 55 characters
    const float* icon = nullptr;
    const String* image = nullptr;
};
/// ERR_ARGVALERR for an icon that does not exist.
Status fillText(TaskCore* task, const MessageText& text, std::string& header, std::string& icon,
                std::string& image, std::vector<std::string>& lines);
inline Status fillText(TaskCore* task, const MessageText& text, Dialog& dialog) {
    return fillText(task, text, dialog.header, dialog.icon, dialog.image, dialog.lines);
}

/// Buttons of a dialog: \Buttons or \BtnArray.
class Buttons {
  public:
    /// ERR_ARGVALERR for a set that does not exist, or more than five own buttons. `standard`: the set without an argument.
    Status read(TaskCore* task, const float* set, const String* own, int32_t ownCount, float standard);
    const std::vector<std::string>& texts() const { return texts_; }
    /// The values that the program gets for them.
    const std::vector<float>& results() const { return results_; }
    /// The button (from 0) that an answer names by its number or its text; -1 when it names none.
    int named(std::string_view answer) const;
    /// The value that the program gets for it: a btnres constant, or its number from 1.
    float result(int button) const;
    /// Without a button only a break can end a dialog: ERR_ARGVALERR when there is none either.
    Status requireEnd(TaskCore* task, const Breaks& breaks) const;

  private:
    std::vector<std::string> texts_;
    std::vector<float> results_;
};

} // namespace rt::lib
