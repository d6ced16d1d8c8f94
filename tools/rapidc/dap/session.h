#pragma once
// Session: one client of the debug adapter, from its first message to its last. The thread that runs the session is the
// scheduler's; another one reads messages and posts them into the inbox.

#include "tools/rapidc/dap/breakpoint_requests.h"
#include "tools/rapidc/dap/context.h"
#include "tools/rapidc/dap/execution_requests.h"
#include "tools/rapidc/dap/inspection_requests.h"
#include "tools/rapidc/dap/operator_dialogs.h"
#include "tools/rapidc/dap/program_output.h"
#include "tools/rapidc/dap/source_requests.h"
#include "tools/rapidc/dap/stray_output.h"

#include <memory>
#include <optional>
#include <string>

namespace rapidc::dap {

class Session final : public rt::DebugClient {
  public:
    Session(protocol::Channel& channel, rt::Inbox& inbox, StrayOutput& stray);
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    /// Until the client disconnects. The exit status of the process.
    int run();
    /// A message of the client; called through the inbox.
    void take(const std::string& message);
    /// No message will come any more. `problem`: "" when the client has closed its side.
    void inputEnded(const std::string& problem);

    // ---- DebugClient
    void stopped(rt::Debugger& debugger, rt::Task& task, rt::StopReason reason) override;
    bool stopsAtError(const rt::Task& task) override;
    bool stopsAtHandledError(const rt::Task& task, int number) override;

  private:
    Json initialize(const Arguments& arguments);
    std::optional<Json> launch(const Request& request, const Arguments& arguments);
    Json configurationDone(const Arguments& arguments);
    void disconnect(const Request& request);
    Json terminate(const Arguments& arguments);
    std::optional<Json> restart(const Request& request, const Arguments& arguments);

    void handle(const Request& request);
    static Json capabilities();
    void makeProgram(const LaunchArguments& arguments);
    void runProgram();
    void dropProgram();
    void endRun();
    void carryOutRestart();
    void showStray();
    void progress(bool begins);
    void showRobot(rt::Task& task);

    Client client_;
    StrayOutput& stray_;
    Context context_;
    Handlers handlers_;
    BreakpointRequests breakpoints_;
    InspectionRequests inspection_;
    ExecutionRequests execution_;
    SourceRequests sources_;
    OperatorDialogs dialogs_;
    std::unique_ptr<ProgramOutput> output_;
    std::optional<LaunchArguments> launched_; ///< what a restart launches again
    struct Restart {
        Request request;
        LaunchArguments arguments;
    };
    std::optional<Restart> restart_;
    std::optional<Request> disconnect_;
    bool initialized_ = false, configured_ = false;
    bool startWanted_ = false; ///< the program is ready to run
    bool entering_ = false;    ///< the program pointer was moved to a routine that is being entered
    bool finished_ = false;
    std::vector<std::string> early_; ///< messages that came before the run had begun
    int status_ = 0;
};

} // namespace rapidc::dap
