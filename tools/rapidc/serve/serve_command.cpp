// rapidc serve: a virtual controller for clients: Robot Web Services in both dialects, EGM, and a web page.

#include "runtime/host/command_line.h"
#include "runtime/host/stop_signals.h"
#include "tools/program/run_setup.h"
#include "tools/rapidc/commands.h"
#include "tools/rapidc/serve/serve_settings.h"
#include "tools/rapidc/serve/serving.h"
#include "tools/rapidc/usage.h"

#include <chrono>
#include <cstdio>
#include <fmt/format.h>

namespace rapidc {

namespace {

/// Clients count on an end within 2 s of the signal, even when a large program is being compiled.
constexpr std::chrono::milliseconds kPatience{1700};

int serveInputs(serve::ServeSettings& settings) {
    std::vector<std::unique_ptr<rapid::config::TemporaryFolder>> folders;
    if (const std::string problem = complete(settings, folders); !problem.empty())
        return usageError("serve", problem);
    const rt::StopSignals signals(kPatience);
    rt::ExitStatus status = rt::ExitStatus::Ended;
    {
        service::VirtualController controller(settings.controller);
        status = controller.open();
        if (status != rt::ExitStatus::Ended) return static_cast<int>(status);
        serve::Serving serving(settings, controller);
        if (const std::string problem = serving.open(); !problem.empty()) return usageError("serve", problem);
        if (serving.hasKeptParameters()) {
            status = controller.reopen();
            if (status != rt::ExitStatus::Ended) {
                fmt::print(stderr, "rapidc serve: with the system parameters of {}/SYSPAR\n",
                           settings.systemFolder);
                return static_cast<int>(status);
            }
        }
        serving.start();
        status = controller.run();
        if (const service::CycleCount& cycles = controller.cycles(); cycles.missed > 0)
            fmt::print(
                stderr,
                "rapidc serve: {} of {} motion cycles began late ({:.2f} %), the latest by {:.1f} ms\n",
                cycles.missed, cycles.cycles, cycles.missedShare(),
                static_cast<double>(cycles.latest) / rt::kMillisecond);
    }
    folders.clear();
    // A service ends by itself: the first process of a container cannot be ended by a signal that it does not handle.
    if (const int received = rt::StopSignals::received(); received != 0)
        return rt::StopSignals::kStatus + received;
    return static_cast<int>(status);
}

} // namespace

void addServeCommand(rt::CommandLine& line) {
    auto settings = std::make_shared<serve::ServeSettings>();
    const rt::Command command =
        line.addCommand("serve", "Run a virtual controller for clients: Robot Web Services, EGM, a web page",
                        [settings] { return serveInputs(*settings); });
    serve::addServeOptions(command, *settings);
}

} // namespace rapidc
