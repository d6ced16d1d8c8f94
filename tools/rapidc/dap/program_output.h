#pragma once
// ProgramOutput: what a program and its controller write, as output events.

#include "tools/rapidc/dap/context.h"

#include <cstdio>

namespace rapidc::dap {

class ProgramOutput {
  public:
    /// From now on. The controller of the context must outlive this.
    explicit ProgramOutput(Context& context);
    ~ProgramOutput();
    ProgramOutput(const ProgramOutput&) = delete;
    ProgramOutput& operator=(const ProgramOutput&) = delete;

  private:
    void show(const rt::Event& event);

    Context& context_;
    std::FILE* nowhere_;
    uint64_t listener_;
    uint64_t shown_ = 0;
};

} // namespace rapidc::dap
