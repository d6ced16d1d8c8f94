#pragma once
// ProgramOutput: what a program and its controller write, as output events.

#include "tools/rapidc/dap/context.h"

#include <cstdio>
#include <string>
#include <string_view>
#include <sys/types.h>

namespace rapidc::dap {

class ProgramOutput {
  public:
    /// From now on. The controller of the context must outlive this.
    /// `onDialog` is called when a part of a dialog has been shown.
    ProgramOutput(Context& context, std::function<void()> onDialog);
    ~ProgramOutput();
    ProgramOutput(const ProgramOutput&) = delete;
    ProgramOutput& operator=(const ProgramOutput&) = delete;

  private:
    void show(const rt::Event& event);
    /// The text of a dialog with the operator, in pieces.
    void takeDialog(std::string_view text);
    static ssize_t writeDialog(void* output, const char* bytes, std::size_t size);

    Context& context_;
    std::function<void()> onDialog_;
    std::FILE* nowhere_;
    std::FILE* dialogs_;
    std::string line_; ///< of a dialog, not complete
    uint64_t listener_;
    uint64_t shown_ = 0;
};

} // namespace rapidc::dap
