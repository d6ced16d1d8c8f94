#include "runtime/host/usage.h"

#include "runtime/host/run_options.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

namespace rt {
namespace {

std::string commandsOf(const CLI::App& app) {
    std::string list;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        if (!command->get_group().empty()) // else it is one of rapidc's own
            list += (list.empty() ? "" : ", ") + command->get_name();
    return list;
}

/// What was given although nothing takes it; "" if there is nothing.
std::string firstExtra(const CLI::App& app, const CLI::App& command) {
    for (const CLI::App* of : {&command, &app}) {
        const auto extras = of->remaining();
        if (!extras.empty()) return extras.front();
    }
    return {};
}

std::string problemOf(const CLI::App& app, const CLI::App& command, const CLI::ParseError& error) {
    const std::string extra = firstExtra(app, command);
    const bool option = extra.size() > 1 && extra[0] == '-';
    const std::string commands = commandsOf(command);
    if (!commands.empty() && !option) {
        return extra.empty() ? fmt::format("no command is given; the commands are {}", commands)
                             : fmt::format("there is no command '{}'; the commands are {}", extra, commands);
    }
    if (!extra.empty()) return fmt::format("{} '{}'", option ? "there is no option" : "unexpected", extra);
    return error.what();
}

} // namespace

int reportUsage(const CLI::App& app, const CLI::ParseError& error, const std::string& name) {
    if (error.get_exit_code() == 0) return app.exit(error); // --help, --version
    const auto chosen = app.get_subcommands();
    const CLI::App& command = chosen.empty() ? app : *chosen.front();
    const std::string full = chosen.empty() ? name : fmt::format("{} {}", name, command.get_name());
    fmt::print(stderr, "{}: {}\n{} --help tells more\n", full, problemOf(app, command, error), full);
    return static_cast<int>(ExitStatus::BadUsage);
}

} // namespace rt
