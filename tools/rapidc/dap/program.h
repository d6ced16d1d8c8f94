#pragma once
// Program: what a launch request makes: the compiled program and the controller that it runs on.

#include "codegen/codegen.h"
#include "config/temporary.h"
#include "runtime/host/controller.h"
#include "runtime/host/unit_loader.h"
#include "tools/rapidc/dap/messages.h"
#include "tools/rapidc/pipeline.h"
#include "tools/rapidc/program_sources.h"
#include "tools/rapidc/unit_compiler.h"

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
    std::vector<std::string> robots, config, tasks;
    std::string stimulus, home;

    /// Throws a Refusal. Relative paths count from `cwd`, when that is given.
    static LaunchArguments from(const Arguments& arguments);
};

class Program {
  public:
    /// Compiles, and makes the controller ready. Throws a Refusal; the diagnostics have been sent to the client then.
    Program(const LaunchArguments& arguments, Client& client, rt::Inbox& inbox);
    ~Program();
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    rt::Controller& controller() { return *controller_; }
    const Compilation& compilation() const { return *compilation_; }
    const LaunchArguments& arguments() const { return arguments_; }
    /// The path on this computer of a file as the program knows it ("HOME:/part.modx").
    std::string hostPath(const std::string& file) const;

  private:
    void check(Client& client);
    void compile(Client& client);
    void prepare(rt::Inbox& inbox);

    LaunchArguments arguments_;
    rt::RunOptions options_;
    std::unique_ptr<Compilation> compilation_;
    ir::Module module_;
    codegen::CodegenOptions codegen_;
    std::unique_ptr<codegen::JitProgram> jit_;
    std::unique_ptr<ProgramSources> sources_;
    std::unique_ptr<SourceCompiler> compiler_;
    std::unique_ptr<rt::UnitLoader> loader_;
    rapid::config::TemporaryFolder home_;
    std::unique_ptr<rt::Controller> controller_;
};

} // namespace rapidc::dap
