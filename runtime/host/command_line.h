#pragma once
// CommandLine: the commands, options and arguments of an executable. Only its .cpp file includes CLI11, which costs every
// file that does seconds of compile time.

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace rt {

/// An option or an argument of a command. Valid as long as its CommandLine.
class Option {
  public:
    explicit Option(CLI::Option* option) : option_(option) {}

    const Option& required() const;
    const Option& typeName(const std::string& name) const; ///< for the help
    const Option& oneValueEach() const;                    ///< arguments may follow; repeatable
    const Option& oneOf(const std::vector<std::string>& values) const;
    const Option& excludes(const Option& other) const;
    const Option& hide() const; ///< leaves it out of the help

  private:
    CLI::Option* option_;
};

/// A command, or the executable itself. Valid as long as its CommandLine.
class Command {
  public:
    explicit Command(CLI::App& app) : app_(&app) {}

    /// Adds an option ("-o,--output") or an argument ("input"). The value stays as it is unless one is given.
    Option add(const std::string& names, std::string& value, const std::string& text) const;
    Option add(const std::string& names, std::vector<std::string>& values, const std::string& text) const;
    /// `take` stores the value and returns what is wrong with it, or "".
    Option addChecked(const std::string& name, std::function<std::string(const std::string&)> take,
                      const std::string& text) const;
    /// The same for an option whose value may be left out: `--name` alone means `otherwise`; a value follows after `=` only.
    /// Repeatable.
    Option addOptional(const std::string& name, const std::string& otherwise,
                       std::function<std::string(const std::string&)> take, const std::string& text) const;
    Option addFlag(const std::string& names, bool& value, const std::string& text) const;
    /// Refuses the command without the argument unless the option is given.
    void requireOneOf(const std::string& argument, const std::string& option) const;
    void hide() const; ///< leaves it out of the help

  private:
    CLI::App* app_;
};

class CommandLine;

/// A command and the function that adds it.
struct CommandEntry {
    const char* name;
    void (*add)(CommandLine& line);
};

class CommandLine {
  public:
    /// `name`: what messages begin with.
    CommandLine(std::string name, const std::string& about);
    CommandLine(const CommandLine&) = delete;
    CommandLine& operator=(const CommandLine&) = delete;
    ~CommandLine();

    Command executable() const { return Command(*app_); }
    /// Adds --version.
    void setVersion(const std::string& text) const;
    /// One of the commands must be given then. `body` returns the exit status.
    Command addCommand(const std::string& name, const std::string& about, std::function<int()> body);

    /// The commands of the executable, in the order of the help. Options take time to add, so only those of the chosen command
    /// are added, unless the help or a message needs the others.
    void setCommands(std::span<const CommandEntry> commands) { commands_ = commands; }

    /// Reads the arguments, calls the command that is chosen, or else `body`, and returns its exit status. Prints "NAME:
    /// what is wrong; where help is" to stderr and returns BadUsage, or prints the help that was asked for.
    int run(int argc, const char* const* argv, const std::function<int()>& body = {});

  private:
    /// Adds the commands for which `wanted` says so.
    void addCommands(const std::function<bool(const CommandEntry&)>& wanted);

    std::string name_;
    std::unique_ptr<CLI::App> app_;
    std::span<const CommandEntry> commands_;
    std::function<int()> chosen_; ///< body of the command that was read
};

} // namespace rt
