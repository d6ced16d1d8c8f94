#include "tools/rapidc/dap/program_output.h"

#include <cerrno>
#include <fmt/format.h>
#include <system_error>

namespace rapidc::dap {

ProgramOutput::ProgramOutput(Context& context) : context_(context), nowhere_(std::fopen("/dev/null", "we")) {
    if (nowhere_ == nullptr) throw std::system_error(errno, std::generic_category(), "/dev/null");
    rt::Controller& controller = context.controller();
    controller.panel().setOutput(nowhere_, stderr); // dialogs: see StrayOutput
    controller.panel().onLine([this](std::string_view line) { context_.client.output("stdout", line); });
    listener_ = controller.log().addListener([this](const rt::Event& event) { show(event); });
}

ProgramOutput::~ProgramOutput() {
    rt::Controller& controller = context_.controller();
    controller.log().removeListener(listener_);
    controller.panel().onLine({});
    controller.panel().setOutput(stdout, stderr);
    std::fclose(nowhere_);
}

void ProgramOutput::show(const rt::Event& event) {
    constexpr uint64_t kMost = 10'000;
    if (++shown_ > kMost) {
        if (shown_ == kMost + 1) context_.client.output("important", "Further events are not shown.");
        return;
    }
    std::string text = rt::toText(event);
    context_.client.output(event.type == rt::EventType::Error ? "important" : "console", text,
                           context_.place(event.place));
}

} // namespace rapidc::dap
