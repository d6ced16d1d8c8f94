#include "tools/rapidc/dap/program_output.h"

#include <cerrno>
#include <fmt/format.h>
#include <system_error>
#include <utility>

namespace rapidc::dap {

ProgramOutput::ProgramOutput(Context& context, std::function<void()> onDialog)
    : context_(context), onDialog_(std::move(onDialog)), nowhere_(std::fopen("/dev/null", "we")) {
    cookie_io_functions_t functions{};
    functions.write = writeDialog;
    dialogs_ = ::fopencookie(this, "w", functions);
    if (nowhere_ == nullptr || dialogs_ == nullptr)
        throw std::system_error(errno, std::generic_category(), "/dev/null");
    rt::Controller& controller = context.controller();
    controller.panel().setOutput(nowhere_, dialogs_);
    controller.panel().onLine([this](std::string_view line) { context_.client.output("stdout", line); });
    listener_ = controller.log().addListener([this](const rt::Event& event) { show(event); });
}

ProgramOutput::~ProgramOutput() {
    rt::Controller& controller = context_.controller();
    controller.log().removeListener(listener_);
    controller.panel().onLine({});
    controller.panel().setOutput(stdout, stderr);
    std::fclose(nowhere_);
    std::fclose(dialogs_);
}

ssize_t ProgramOutput::writeDialog(void* output, const char* bytes, std::size_t size) {
    static_cast<ProgramOutput*>(output)->takeDialog({bytes, size});
    return static_cast<ssize_t>(size);
}

void ProgramOutput::takeDialog(std::string_view text) {
    line_ += text;
    const rt::Task* task = context_.controller().scheduler().running();
    for (std::size_t end = line_.find('\n'); end != std::string::npos; end = line_.find('\n')) {
        context_.client.output("important", line_.substr(0, end),
                               task != nullptr ? context_.place(task->place()) : Json::object());
        line_.erase(0, end + 1);
    }
    onDialog_();
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
