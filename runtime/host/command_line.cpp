#include "runtime/host/command_line.h"

#include "config/nearest.h"
#include "runtime/host/run_options.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace rt {
namespace {

std::string commandsOf(const CLI::App& app) {
    std::string list;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        if (!command->get_group().empty()) // else it is one of rapidc's own
            list += (list.empty() ? "" : ", ") + command->get_name();
    return list;
}

/// The argument that no option takes; "" if there is none.
std::string firstExtra(const CLI::App& app, const CLI::App& command) {
    for (const CLI::App* of : {&command, &app}) {
        const auto extras = of->remaining();
        if (!extras.empty()) return extras.front();
    }
    return {};
}

/// "; did you mean 'a' or 'b'?", or "".
std::string didYouMean(const std::string& written, const std::vector<std::string>& names) {
    std::vector<std::string> near = rapid::config::nearestNames(written, names);
    if (near.empty()) return {};
    if (near.size() > 2) near.resize(2);
    return fmt::format("; did you mean '{}'?", fmt::join(near, "' or '"));
}

std::vector<std::string> optionsOf(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options())
        for (const std::string& name : option->get_lnames())
            names.push_back("--" + name);
    return names;
}

/// The command of rapidc with an option that executables lack, because it concerns compiling or needs the compiler; "" if none.
std::string commandForExecutable(const std::string& option) {
    static constexpr std::pair<const char*, const char*> kOptions[] = {
        {"--task", "build"},
        {"--assume-signals", "build"},
        {"--no-optimise", "build"},
        {"--stepping", "build"},
        {"--strip", "build"},
        {"--no-cache", "build"},
        {"--output", "build"},
        {"-o", "build"},
        {"-W", "build"},
        {"--step", "run"},
        {"--no-stepping", "run"},
        {"--http-port", "serve"},
        {"--https-port", "serve"},
        {"--web-port", "serve"},
        {"--password", "serve"},
        {"--password-file", "serve"},
        {"--backup-dir", "serve"},
        {"--certificate-dir", "serve"},
        {"--system-dir", "serve"},
        {"--temp", "serve"},
        {"--motors-on", "serve"},
        {"--no-program-start", "serve"},
        {"--robotware", "serve"},
    };
    for (const auto& [name, command] : kOptions)
        if (option == name) return fmt::format("'rapidc {}'", command);
    return {};
}

/// "'rapidc run' and 'rapidc build'": where an option exists that this command does not have; "" if nowhere.
std::string placesOf(const std::string& option, const CLI::App& app, const CLI::App& command) {
    std::vector<std::string> places;
    for (const CLI::App* other : app.get_subcommands([](const CLI::App*) { return true; }))
        if (other != &command && !other->get_group().empty() && other->get_option_no_throw(option) != nullptr)
            places.push_back(fmt::format("'rapidc {}'", other->get_name()));
    RunOptions ignored;
    CLI::App executable;
    addRunOptions(Command(executable), ignored, false);
    if (app.get_subcommands([](const CLI::App*) { return true; }).empty())
        return commandForExecutable(option);
    if (places.empty()) return {};
    if (executable.get_option_no_throw(option) != nullptr)
        places.emplace_back("the executables of 'rapidc build'");
    const std::string last = places.back();
    places.pop_back();
    return places.empty() ? last : fmt::format("{} and {}", fmt::join(places, ", "), last);
}

std::string unknownOption(const std::string& extra, const CLI::App& app, const CLI::App& command) {
    const std::string option = extra.substr(0, extra.find('='));
    if (const std::string places = placesOf(option, app, command); !places.empty())
        return fmt::format("'{}' is an option of {}", option, places);
    return fmt::format("there is no option '{}'{}", extra, didYouMean(option, optionsOf(command)));
}

std::string unknownCommand(const std::string& extra, const CLI::App& app, const std::string& commands) {
    if (extra.empty()) return fmt::format("no command is given; the commands are {}", commands);
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        if (!command->get_group().empty()) names.push_back(command->get_name());
    return fmt::format("there is no command '{}'; the commands are {}{}", extra, commands,
                       didYouMean(extra, names));
}

/// The library's own words where ours are clearer: a flag with a value, an option without one.
std::string reworded(const CLI::ParseError& error) {
    const std::string words = error.what();
    constexpr std::string_view kConversion = "Could not convert: ", kMissing = " required ";
    if (error.get_name() == "ConversionError" && words.starts_with(kConversion))
        return words.substr(kConversion.size(), words.find(" = ") - kConversion.size()) + " takes no value";
    const size_t missing = words.find(kMissing), colon = words.find(": ");
    if (error.get_name() == "ArgumentMismatch" && missing != std::string::npos && words.ends_with(" missing"))
        return fmt::format("{} needs a value: {}", words.substr(0, colon),
                           words.substr(missing + kMissing.size(),
                                        words.size() - missing - kMissing.size() - std::strlen(" missing")));
    return words;
}

std::string problemOf(const CLI::App& app, const CLI::App& command, const CLI::ParseError& error) {
    const std::string extra = firstExtra(app, command);
    const bool option = extra.size() > 1 && extra[0] == '-';
    const std::string commands = commandsOf(command);
    if (!commands.empty() && !option) return unknownCommand(extra, command, commands);
    if (option) return unknownOption(extra, app, command);
    return extra.empty() ? reworded(error) : fmt::format("unexpected '{}'", extra);
}

/// Reports what parsing ended with. `name`: of the executable. Returns the exit status.
int report(const CLI::App& app, const CLI::ParseError& error, const std::string& name) {
    if (error.get_exit_code() == 0) return app.exit(error); // --help, --version
    const auto chosen = app.get_subcommands();
    const CLI::App& command = chosen.empty() ? app : *chosen.front();
    const std::string full = chosen.empty() ? name : fmt::format("{} {}", name, command.get_name());
    fmt::print(stderr, "{}: {}\n{} --help says more\n", full, problemOf(app, command, error), full);
    return static_cast<int>(ExitStatus::BadUsage);
}

} // namespace

const Option& Option::required() const {
    option_->required();
    return *this;
}

const Option& Option::typeName(const std::string& name) const {
    option_->type_name(name);
    return *this;
}

const Option& Option::oneValueEach() const {
    option_->allow_extra_args(false)->take_all();
    return *this;
}

const Option& Option::oneOf(const std::vector<std::string>& values) const {
    option_->check(CLI::IsMember(values));
    return *this;
}

const Option& Option::excludes(const Option& other) const {
    option_->excludes(other.option_);
    return *this;
}

const Option& Option::hide() const {
    option_->group("");
    return *this;
}

Option Command::add(const std::string& names, std::string& value, const std::string& text) const {
    return Option(app_->add_option(names, value, text));
}

Option Command::add(const std::string& names, std::vector<std::string>& values,
                    const std::string& text) const {
    return Option(app_->add_option(names, values, text));
}

Option Command::addChecked(const std::string& name, std::function<std::string(const std::string&)> take,
                           const std::string& text) const {
    const auto takeOrThrow = [name, take = std::move(take)](const std::string& value) {
        if (const std::string problem = take(value); !problem.empty())
            throw CLI::ValidationError(name, problem);
    };
    return Option(app_->add_option_function<std::string>(name, takeOrThrow, text));
}

Option Command::addOptional(const std::string& name, const std::string& otherwise,
                            std::function<std::string(const std::string&)> take,
                            const std::string& text) const {
    auto values = std::make_shared<std::vector<std::string>>();
    CLI::Option* option = app_->add_flag(name, *values, text);
    option->each([name, values, otherwise, take = std::move(take)](const std::string& value) {
        const bool isAlone = value == "true"; // the library's word for it
        if (const std::string problem = take(isAlone ? otherwise : value); !problem.empty())
            throw CLI::ValidationError(problem); // the library names the option itself
    });
    return Option(option);
}

Option Command::addFlag(const std::string& names, bool& value, const std::string& text) const {
    return Option(app_->add_flag(names, value, text));
}

void Command::requireOneOf(const std::string& argument, const std::string& option) const {
    app_->parse_complete_callback([app = app_, argument, option] {
        if (app->count(argument) + app->count(option) == 0) throw CLI::RequiredError(argument);
    });
}

void Command::hide() const {
    app_->group("");
}

CommandLine::CommandLine(std::string name, const std::string& about)
    : name_(std::move(name)), app_(std::make_unique<CLI::App>(about)) {}

CommandLine::~CommandLine() = default;

void CommandLine::setVersion(const std::string& text) const {
    app_->set_version_flag("--version", text);
}

Command CommandLine::addCommand(const std::string& name, const std::string& about,
                                std::function<int()> body) {
    app_->name(name_);
    app_->require_subcommand(1);
    CLI::App* command = app_->add_subcommand(name, about);
    command->callback([this, body = std::move(body)] { chosen_ = body; });
    return Command(*command);
}

void CommandLine::addCommands(const std::function<bool(const CommandEntry&)>& wanted) {
    for (const CommandEntry& entry : commands_)
        if (wanted(entry)) entry.add(*this);
}

int CommandLine::run(int argc, const char* const* argv, const std::function<int()>& body) {
    const std::string_view first = argc > 1 ? argv[1] : "";
    const auto isChosen = [first](const CommandEntry& entry) { return first == entry.name; };
    const bool chooses = std::any_of(commands_.begin(), commands_.end(), isChosen);
    addCommands([&](const CommandEntry& entry) { return !chooses || isChosen(entry); });
    try {
        app_->parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (chooses && error.get_exit_code() != 0)
            addCommands([&](const CommandEntry& entry) { return !isChosen(entry); });
        return report(*app_, error, name_);
    }
    const std::function<int()>& rest = chosen_ ? chosen_ : body;
    return rest ? rest() : 0;
}

} // namespace rt
