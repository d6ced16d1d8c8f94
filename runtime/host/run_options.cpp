#include "runtime/host/run_options.h"

#include "runtime/base/text_util.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <cmath>

namespace rt {
namespace {

void addRate(CLI::App& app, RunOptions& options) {
    const auto take = [&options](const std::string& text) {
        double number = 0;
        if (text == "unlimited")
            number = 0;
        else if (!parseNumber(text, number) || number < 0 || number != std::floor(number) ||
                 number > static_cast<double>(kUnlimitedRate)) {
            throw CLI::ValidationError("--rate",
                                       fmt::format("'{}' is neither a number of instructions from 0 to {} "
                                                   "nor 'unlimited'",
                                                   text, kUnlimitedRate));
        }
        options.rate = number == 0 ? kUnlimitedRate : static_cast<int64_t>(number);
    };
    app.add_option_function<std::string>(
           "--rate", take,
           fmt::format(
               "RAPID instructions per millisecond of virtual time. RobotWare 7 documents {} (the default), "
               "to be raised to {} at most; 'unlimited' (or 0): an instruction takes a nanosecond",
               kDefaultRate, kMaxControllerRate))
        ->type_name("N|unlimited");
}

/// An option that takes a whole number from 0 to `most`.
template <class Integer>
CLI::Option* addWhole(CLI::App& app, const char* option, Integer& value, double most,
                      const std::string& text) {
    const auto take = [&value, option, most](const std::string& given) {
        double number = 0;
        if (!parseNumber(given, number) || number < 0 || number > most || number != std::floor(number))
            throw CLI::ValidationError(
                option, fmt::format("'{}' is not a whole number from 0 to {:.0f}", given, most));
        value = static_cast<Integer>(number);
    };
    return app.add_option_function<std::string>(option, take, text)->type_name("N");
}

void addMaxTime(CLI::App& app, RunOptions& options) {
    const auto take = [&options](const std::string& text) {
        if (!parseNumber(text, options.maxTime) || options.maxTime < 0) {
            throw CLI::ValidationError("--max-time",
                                       fmt::format("'{}' is not a number of seconds, 0 or more", text));
        }
        options.hasMaxTime = true;
    };
    app.add_option_function<std::string>("--max-time", take,
                                         "end the run at this virtual time (exit status 4)")
        ->type_name("SECONDS");
}

} // namespace

void addRunOptions(CLI::App& app, RunOptions& options, bool withTasks) {
    addWhole(app, "--cycles", options.cycles, 1e12, "how often main is run; 0 = for ever; default 1");
    if (withTasks) {
        app.add_option(
               "--task", options.tasks,
               "add a task running the main of its inputs; NAME:STATIC= and NAME:SEMISTATIC= give its type; "
               "repeatable, also to add inputs to a task")
            ->type_name("NAME[:TYPE]=INPUT[,INPUT]")
            ->allow_extra_args(false) // inputs follow
            ->take_all();
    }
    app.add_option("--config", options.configFiles,
                   "EIO, SYS, MOC, SIO or PROC parameters in ABB's text format; repeatable")
        ->type_name("FILE.cfg")
        ->allow_extra_args(false)
        ->take_all();
    app.add_option("--robot", options.robot, fmt::format("robot model; default \"{}\"", kDefaultRobot))
        ->type_name("MODEL");
    app.add_option("--home", options.home,
                   "the controller's HOME:; default: an empty folder, removed at the end")
        ->type_name("DIR");
    app.add_option("--stimulus", options.stimulus,
                   "what happens from outside: lines time_s,target,value; a file, a pipe, or - for the "
                   "standard input")
        ->type_name("FILE.csv");
    app.add_option("--trace", options.trace, "write the robot's motion, a sample each 4 ms")
        ->type_name("FILE.csv");
    app.add_option("--signals", options.signals, "write every change of a signal")->type_name("FILE.csv");
    app.add_option("--events", options.events, "write the event log, an object a line")
        ->type_name("FILE.jsonl");
    app.add_option("--state", options.state,
                   "folder that keeps the controller's state from run to run: data, events, the robot's "
                   "position, and where "
                   "a program that was interrupted goes on")
        ->type_name("DIR");
    app.add_flag("--pp-to-main", options.ppToMain, "with --state: the program begins at main nevertheless");
    app.add_flag("--save", options.save,
                 "write the values of persistents back into the source files at the end, and let Save do so");
    app.add_flag("--realtime", options.realtime, "pace virtual time to the wall clock");
    addMaxTime(app, options);
    addWhole(app, "--seed", options.seed, UINT32_MAX, "start value of Rand; default 1");
    addRate(app, options);
}

} // namespace rt
