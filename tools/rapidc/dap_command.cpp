// rapidc dap: the debug adapter, over standard input and output.

#include "runtime/host/command_line.h"
#include "tools/rapidc/commands.h"
#include "tools/rapidc/dap/session.h"

#include <atomic>
#include <chrono>
#include <csignal>
#include <memory>
#include <thread>
#include <unistd.h>

namespace rapidc {

namespace {

/// Objects that the reading thread uses as long as the process lives: it cannot be interrupted.
struct Input {
    explicit Input(int output) : channel(STDIN_FILENO, output) {}
    protocol::Channel channel;
    rt::Inbox inbox;
    dap::Session* session = nullptr; ///< used by commands of the inbox only
};

/// A program that does not let go must not keep the adapter alive when its client has gone.
constexpr std::chrono::seconds kPatience{10};

void readMessages(const std::shared_ptr<Input>& input) {
    std::string problem;
    for (;;) {
        std::string message;
        if (!input->channel.read(message, problem)) break;
        input->inbox.post(
            [input = input.get(), message = std::move(message)] { input->session->take(message); });
    }
    if (problem == "the input ends inside a message") problem.clear(); // the client has died
    input->inbox.post([input = input.get(), problem] { input->session->inputEnded(problem); });
    std::this_thread::sleep_for(kPatience);
    ::_exit(0);
}

int serve() {
    std::signal(SIGPIPE, SIG_IGN);
    dap::StrayOutput stray;
    const auto input = std::make_shared<Input>(stray.protocolOutput());
    dap::Session session(input->channel, input->inbox, stray);
    input->session = &session;
    std::thread(readMessages, input).detach();
    return session.run();
}

} // namespace

void addDapCommand(rt::CommandLine& line) {
    line.addCommand("dap", "Debug adapter (DAP) on standard input and output, for editors",
                    [] { return serve(); });
}

} // namespace rapidc
