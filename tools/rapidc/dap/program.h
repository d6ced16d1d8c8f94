#pragma once
// Program: what a launch request makes: the compiled program and the controller that it runs on.

#include "config/temporary.h"
#include "runtime/host/controller.h"
#include "tools/program/loaded_program.h"
#include "tools/rapidc/dap/messages.h"

#include <memory>
#include <string>
#include <vector>

namespace rapidc::dap {

/// The arguments of a launch request, checked for their types.
struct LaunchArguments {
    std::string program;
    bool stopOnEntry = false;
    bool noDebug = false;
    bool realtime = false;
    bool operatorDialogs = false; ///< the client answers them
    bool robotEvents = true;      ///< an event at each stop says where the robot is
    std::vector<std::string> robots, config, tasks;
    std::string stimulus, home;

    /// Throws a Refusal. Relative paths count from `cwd`, when that is given.
    static LaunchArguments from(const Arguments& arguments);
};

class Program {
  public:
    /// Compiles, and makes the controller ready. Throws a Refusal; the diagnostics have been sent to the client then.
    Program(const LaunchArguments& arguments, Client& client, const ClientFacts& facts, rt::Inbox& inbox);
    ~Program();
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    rt::Controller& controller() { return *controller_; }
    const Compilation& compilation() const { return loaded_->compilation(); }
    const LaunchArguments& arguments() const { return arguments_; }
    /// The path on this computer of a file as the program knows it ("HOME:/part.modx").
    std::string hostPath(const std::string& file) const;

  private:
    std::unique_ptr<Compilation> check(Client& client);
    void compile(std::unique_ptr<Compilation> compilation, Client& client, const ClientFacts& facts);
    void prepare(rt::Inbox& inbox);

    LaunchArguments arguments_;
    rt::RunOptions options_;
    std::unique_ptr<LoadedProgram> loaded_;
    rapid::config::TemporaryFolder home_;
    std::unique_ptr<rt::Controller> controller_;
};

} // namespace rapidc::dap
