#pragma once
// OperatorDialogs: questions of the program to the operator (TPReadNum, UIMsgBox ...) that the client answers. Not part of the
// protocol: a client asks for them by the launch argument "operatorDialogs". docs/debugging.md describes the messages.

#include "tools/rapidc/dap/context.h"

#include <set>

namespace rapidc::dap {

class OperatorDialogs {
  public:
    explicit OperatorDialogs(Context& context) : context_(context) {}
    void addTo(Handlers& handlers);

    /// A program was made. `answered`: its dialogs wait for the client.
    void begin(bool answered);
    /// Its controller leaves.
    void end() { isOn_ = false; }
    /// Sends the client which dialogs were opened and closed since the last call. While one is open, virtual time keeps pace with
    /// the clock and the run does not end because all tasks wait.
    void look();

  private:
    Json answer(const Arguments& arguments);

    Context& context_;
    bool isOn_ = false;
    bool holds_ = false;      ///< the scheduler waits for an answer
    std::set<uint64_t> open_; ///< those that the client knows of
};

} // namespace rapidc::dap
