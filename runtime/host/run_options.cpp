#include "runtime/host/run_options.h"

#include "runtime/base/text_util.h"
#include "runtime/host/command_line.h"

#include <fmt/format.h>

#include <cmath>

namespace rt {
namespace {

void addRate(const Command& command, RunOptions& options) {
    const auto take = [&options](const std::string& text) -> std::string {
        double number = 0;
        if (text == "unlimited")
            number = 0;
        else if (!parseNumber(text, number) || number < 0 || number != std::floor(number) ||
                 number > static_cast<double>(kUnlimitedRate)) {
            return fmt::format("'{}' is neither a number of instructions from 0 to {} nor 'unlimited'", text,
                               kUnlimitedRate);
        }
        options.rate = number == 0 ? kUnlimitedRate : static_cast<int64_t>(number);
        return {};
    };
    command
        .addChecked(
            "--rate", take,
            fmt::format(
                "RAPID instructions per millisecond of virtual time. RobotWare 7 documents {} (the default), "
                "to be raised to {} at most; 'unlimited' (or 0): an instruction takes a nanosecond",
                kDefaultRate, kMaxControllerRate))
        .typeName("N|unlimited");
}

/// An option that takes a whole number from 0 to `most`.
template <class Integer>
void addWhole(const Command& command, const char* option, Integer& value, double most,
              const std::string& text) {
    const auto take = [&value, most](const std::string& given) -> std::string {
        double number = 0;
        if (!parseNumber(given, number) || number < 0 || number > most || number != std::floor(number))
            return fmt::format("'{}' is not a whole number from 0 to {:.0f}", given, most);
        value = static_cast<Integer>(number);
        return {};
    };
    command.addChecked(option, take, text).typeName("N");
}

void addMaxTime(const Command& command, RunOptions& options) {
    const auto take = [&options](const std::string& text) -> std::string {
        if (!parseNumber(text, options.maxTime) || options.maxTime < 0)
            return fmt::format("'{}' is not a number of seconds, 0 or more", text);
        options.hasMaxTime = true;
        return {};
    };
    command.addChecked("--max-time", take, "End the run at this virtual time (exit status 4)")
        .typeName("SECONDS");
}

/// The disks and devices of the controller.
void addDisks(const Command& command, RunOptions& options) {
    command
        .add("--home", options.home, "The controller's HOME:; default: an empty folder, removed at the end")
        .typeName("DIR");
    command
        .add("--volume", options.volumes,
             "A further disk of the controller, such as USB1=DIR; TEMP, RAMDISK, BACKUP and DATA are empty "
             "folders "
             "otherwise, removed at the end; repeatable")
        .typeName("NAME=DIR")
        .oneValueEach();
    command
        .add("--device", options.devices,
             "A serial channel or printer, such as com1=HOME:/in.txt,HOME:/out.txt: it is read from the "
             "first file (or "
             "FIFO) of a volume and written to the second, or both the same; repeatable")
        .typeName("NAME=FILE[,FILE]")
        .oneValueEach();
    command
        .add("--camera", options.cameras,
             "A camera of Integrated Vision and the JSON file of its results; repeatable")
        .typeName("NAME=FILE.json")
        .oneValueEach();
}

void addNetwork(const Command& command, net::NetworkOptions& options) {
    command.addFlag("--offline", options.offline,
                    "Sockets connect tasks of this controller only, without this computer's network");
    command
        .addOptional(
            "--listen", "any", [&options](const std::string& text) { return takeListen(options, text); },
            "Let other computers connect to sockets of the program: at the address that it names, or at this "
            "one; default: this computer only")
        .typeName("[=ADDRESS]");
    command
        .addOptional(
            "--connect", "any", [&options](const std::string& text) { return takeConnect(options, text); },
            "Let the program connect to other computers: to any, to this one, or to OTHER where it names "
            "ADDRESS; repeatable")
        .typeName("[=ADDRESS[=OTHER]]");
}

/// A whole number of microseconds, so that times in files are exact.
void addTick(const Command& command, RunOptions& options) {
    const auto take = [&options](const std::string& text) -> std::string {
        constexpr double kLeast = 0.1, kMost = 100; // ms
        double number = 0;
        const bool isNumber = parseNumber(text, number) && number >= kLeast && number <= kMost;
        const double microseconds = std::round(1000 * number);
        if (!isNumber || std::abs(1000 * number - microseconds) > 1e-6)
            return fmt::format("'{}' is not a time from {} to {} ms in whole microseconds", text, kLeast,
                               kMost);
        options.tick = static_cast<Time>(microseconds) * (kMillisecond / 1000);
        return {};
    };
    command
        .addChecked(
            "--tick", take,
            "Period of motion in ms: samples of trace and report, outputs of TriggSpeed; default 4, real "
            "controllers 4.032")
        .typeName("MS");
}

void addRobots(const Command& command, RunOptions& options) {
    command
        .add("--robot", options.robots,
             fmt::format("Robot model, of a further robot UNIT=MODEL; repeatable; default \"{}\"",
                         kDefaultRobot))
        .typeName("[UNIT=]MODEL")
        .oneValueEach();
    command
        .add("--conveyor", options.conveyors,
             "A simulated conveyor, such as CNV1=speed:200,every:400: mm/s, and an object each 400 mm; keys: "
             "speed, "
             "acceleration, every, sync, window, min, max, separation, adjustment, adjustment_acceleration, "
             "at, turn, "
             "rotating, index, index_speed, trigger, axis, counts, signals; repeatable")
        .typeName("UNIT=KEY:VALUE,...")
        .oneValueEach();
    command
        .add("--planner", options.planner,
             "How movements are timed: measured (as real controllers; default) or optimal (shortest time "
             "within all limits, including jerk)")
        .oneOf({"measured", "optimal"});
    addTick(command, options);
}

void addOutputs(const Command& command, RunOutputs& outputs) {
    command.add("--trace", outputs.trace, "Write the robot's motion, one sample every 4 ms (--tick)")
        .typeName("FILE.csv");
    command.addFlag(
        "--motors", outputs.motors,
        "With --trace: add the positions of the motors (m1 to m6), which recordings of real robots show");
    command.add("--signals", outputs.signals, "Write every change of a signal").typeName("FILE.csv");
    command.add("--events", outputs.events, "Write the event log, one JSON object per line")
        .typeName("FILE.jsonl");
    command
        .add("--errors", outputs.errors, "Write every error that is raised and where, including handled ones")
        .typeName("FILE.csv");
    command
        .add("--report", outputs.report,
             "Write a page with the path in 3D, speeds, signals, events and a table of movements")
        .typeName("FILE.html");
    command
        .add("--compare", outputs.compare,
             "Compare with a trace or a recording (columns time_s and j1..j6 or x,y,z): time error, path "
             "distance, where they come from")
        .typeName("FILE.csv");
    command.add("--picture", outputs.picture, "Draw the path of the TCP with zones, points and signals")
        .typeName("FILE.svg");
    command.addFlag("--summary", outputs.summary,
                    "Print cycle time, what slowed each movement, and the paths of the files");
}

} // namespace

void addRunOptions(const Command& command, RunOptions& options, bool withTasks) {
    addWhole(command, "--cycles", options.cycles, 1e12,
             "Number of times main is executed, 0: forever; default 1");
    if (withTasks) {
        command
            .add("--task", options.tasks,
                 "Add a task that executes the main of its inputs; NAME:STATIC= and NAME:SEMISTATIC= give "
                 "its type; "
                 "repeatable; also adds inputs to a task")
            .typeName("NAME[:TYPE]=INPUT[,INPUT]")
            .oneValueEach();
    }
    command
        .add("--config", options.configFiles,
             "EIO, SYS, MOC, SIO or PROC parameters in ABB's text format; repeatable")
        .typeName("FILE.cfg")
        .oneValueEach();
    addRobots(command, options);
    addDisks(command, options);
    command
        .add("--stimulus", options.stimulus,
             "Events from outside: lines time_s,target,value; a file, a pipe, or - for the "
             "standard input")
        .typeName("FILE.csv");
    addOutputs(command, options.outputs);
    command
        .add("--state", options.state,
             "Folder that keeps the controller's state from run to run: data, events, the robot's "
             "position, and where "
             "a program that was interrupted continues")
        .typeName("DIR");
    command.addFlag("--pp-to-main", options.ppToMain,
                    "With --state: begin at main, not where the program was interrupted");
    command.addFlag(
        "--save", options.save,
        "Write the values of persistents back into the source files at the end, and let Save do so");
    addNetwork(command, options.network);
    command.addFlag("--realtime", options.realtime, "Pace virtual time to the wall clock");
    addMaxTime(command, options);
    addWhole(command, "--seed", options.seed, UINT32_MAX, "Start value of Rand; default 1");
    addRate(command, options);
}

} // namespace rt
