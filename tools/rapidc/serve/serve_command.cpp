// rapidc serve: a virtual controller for clients: Robot Web Services in both dialects, EGM, and a web page.

#include "runtime/host/command_line.h"
#include "runtime/host/stop_signals.h"
#include "tools/program/run_setup.h"
#include "tools/rapidc/commands.h"
#include "tools/rapidc/serve/serve_settings.h"
#include "tools/rapidc/serve/serving.h"

#include <cstdio>
#include <fmt/format.h>

namespace rapidc {

namespace {

int usageError(const std::string& problem) {
    fmt::print(stderr, "rapidc serve: {}\n", problem);
    return static_cast<int>(rt::ExitStatus::BadUsage);
}

int serveInputs(serve::ServeSettings& settings) {
    std::vector<std::unique_ptr<rapid::config::TemporaryFolder>> folders;
    if (const std::string problem = complete(settings, folders); !problem.empty()) return usageError(problem);
    const rt::StopSignals signals;
    rt::ExitStatus status = rt::ExitStatus::Ended;
    {
        service::VirtualController controller(settings.controller);
        status = controller.open();
        if (status != rt::ExitStatus::Ended) return static_cast<int>(status);
        serve::Serving serving(settings, controller);
        if (const std::string problem = serving.open(); !problem.empty()) return usageError(problem);
        serving.start();
        status = controller.run();
    }
    folders.clear();
    rt::StopSignals::endIfReceived();
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
