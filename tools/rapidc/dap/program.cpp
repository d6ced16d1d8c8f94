#include "tools/rapidc/dap/program.h"

#include "runtime/robot/robot_model.h"
#include "tools/program/run_setup.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace rapidc::dap {

namespace fs = std::filesystem;
namespace diag = rapid::diag;

namespace {

std::string absolutePath(const std::string& folder, const std::string& path) {
    if (path.empty()) return path;
    std::error_code ignored;
    const fs::path base = folder.empty() ? fs::current_path(ignored) : fs::absolute(folder, ignored);
    std::string result = (base / path).lexically_normal().string();
    while (result.size() > 1 && result.back() == '/')
        result.pop_back();
    return result;
}

/// "NAME[:TYPE]=INPUT,INPUT" with absolute paths.
std::string absoluteTask(const std::string& folder, const std::string& task) {
    const std::size_t equals = task.find('=');
    if (equals == std::string::npos) return task; // refused when it is read
    std::string result = task.substr(0, equals + 1);
    std::string_view inputs = std::string_view(task).substr(equals + 1);
    while (!inputs.empty()) {
        const std::size_t comma = std::min(inputs.find(','), inputs.size());
        result += absolutePath(folder, std::string(inputs.substr(0, comma)));
        if (comma < inputs.size()) result += ',';
        inputs.remove_prefix(std::min(comma + 1, inputs.size()));
    }
    return result;
}

std::string oneLine(const diag::Diagnostic& diagnostic) {
    std::string place;
    if (diagnostic.file) {
        const rapid::LineColumn at = diagnostic.file->lineColumn(diagnostic.range.begin);
        place = fmt::format("{}:{}:{}: ", diagnostic.file->path(), at.line, at.column);
    }
    return fmt::format("{}{}[{}]: {}", place, diag::severityName(diagnostic.severity),
                       diag::codeName(diagnostic.code), diagnostic.message);
}

void sendDiagnostics(const Compilation& compilation, Client& client, const ClientFacts& facts) {
    constexpr std::size_t kMost = 200;
    std::size_t count = 0;
    for (const diag::Diagnostic& diagnostic : compilation.sink.sorted()) {
        if (diagnostic.severity == diag::Severity::Note) continue;
        if (++count > kMost) break;
        Json place = Json::object();
        if (diagnostic.file) {
            const rapid::LineColumn at = diagnostic.file->lineColumn(diagnostic.range.begin);
            const std::string& path = diagnostic.file->path();
            place = {
                {"source", {{"name", fs::path(path).filename().string()}, {"path", facts.pathOut(path)}}},
                {"line", facts.lineOut(at.line)},
                {"column", facts.columnOut(at.column)}};
        }
        const bool error = diagnostic.severity == diag::Severity::Error;
        client.output(error ? "stderr" : "console", diag::renderText(diagnostic, false), std::move(place));
    }
}

} // namespace

LaunchArguments LaunchArguments::from(const Arguments& arguments) {
    LaunchArguments result;
    const std::string folder = arguments.text("cwd", "");
    result.program = absolutePath(folder, arguments.text("program"));
    if (result.program.empty()) throw Refusal("argument 'program' is empty");
    result.stopOnEntry = arguments.flag("stopOnEntry", false);
    result.noDebug = arguments.flag("noDebug", false);
    result.realtime = arguments.flag("realtime", false);
    result.operatorDialogs = arguments.flag("operatorDialogs", false);
    result.robotEvents = arguments.flag("robotEvents", true);
    if (const std::string robot = arguments.text("robot", ""); !robot.empty()) result.robots.push_back(robot);
    for (const std::string& file : arguments.texts("config"))
        result.config.push_back(absolutePath(folder, file));
    for (const std::string& task : arguments.texts("tasks"))
        result.tasks.push_back(absoluteTask(folder, task));
    result.stimulus = absolutePath(folder, arguments.text("stimulus", ""));
    result.home = absolutePath(folder, arguments.text("home", ""));
    return result;
}

Program::Program(const LaunchArguments& arguments, Client& client, const ClientFacts& facts, rt::Inbox& inbox)
    : arguments_(arguments) {
    std::error_code ignored;
    if (!fs::exists(arguments_.program, ignored))
        throw Refusal(fmt::format("there is no file or folder '{}'", arguments_.program));
    options_.tasks = arguments_.tasks;
    options_.configFiles = arguments_.config;
    options_.robots = arguments_.robots;
    options_.stimulus = arguments_.stimulus;
    options_.home = arguments_.home;
    options_.realtime = arguments_.realtime;
    compile(check(client), client, facts);
    prepare(inbox);
}

Program::~Program() = default;

std::unique_ptr<Compilation> Program::check(Client& client) {
    Inputs inputs;
    inputs.paths = {arguments_.program};
    takeOptions(inputs, options_);
    inputs.requireMain = true;
    auto compilation = checkInputs(inputs);
    if (!compilation->usageErrors.empty()) {
        for (const std::string& problem : compilation->usageErrors)
            client.output("stderr", problem);
        throw Refusal(compilation->usageErrors.front());
    }
    std::string error;
    findStimulus(options_, inputs.paths);
    if (!readStimulus(options_, error)) throw Refusal(error);
    return compilation;
}

void Program::compile(std::unique_ptr<Compilation> compilation, Client& client, const ClientFacts& facts) {
    compilation->callsByName = !arguments_.noDebug;
    const bool stepping = !arguments_.noDebug || timesStatements(*compilation);
    loaded_ = std::make_unique<LoadedProgram>(std::move(compilation));
    std::string error;
    const bool compiled =
        loaded_->compile({.name = fs::path(arguments_.program).stem().string(), .stepping = stepping}, error);
    sendDiagnostics(loaded_->compilation(), client, facts);
    if (compiled) return;
    if (!error.empty()) throw Refusal(error);
    const diag::Sink& sink = loaded_->compilation().sink;
    std::string first;
    for (const diag::Diagnostic& diagnostic : sink.sorted())
        if (first.empty() && diagnostic.severity == diag::Severity::Error) first = oneLine(diagnostic);
    const std::size_t count = sink.errorCount();
    if (count > 1) first += fmt::format(" (and {} more)", count - 1);
    throw Refusal("the program cannot be compiled: " + first);
}

void Program::prepare(rt::Inbox& inbox) {
    // The configuration is in the program already; reading it twice would define every signal twice.
    options_.configFiles.clear();
    std::string error;
    const std::string& home = compilation().homeFolder;
    if (options_.home.empty() && !home.empty()) {
        options_.home = copyHome(home, home_, error);
        if (options_.home.empty()) throw Refusal(error);
    }
    controller_ = std::make_unique<rt::Controller>(options_);
    controller_->panel().setTerminal(false);
    controller_->log().setHumanOutput(nullptr);
    loaded_->equip(*controller_);
    controller_->scheduler().setInbox(&inbox);
    if (controller_->prepare(loaded_->description()) != rt::ExitStatus::Ended)
        throw Refusal("the controller cannot be started");
}

std::string Program::hostPath(const std::string& file) const {
    std::string path;
    const bool onVolume = file.find(':') != std::string::npos && file.front() != '/';
    return onVolume && controller_->volumes().resolve(file, path) ? path : file;
}

} // namespace rapidc::dap
