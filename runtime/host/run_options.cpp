#include "runtime/host/run_options.h"

#include "runtime/io/text_util.h"

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

void addMaxTime(CLI::App& app, RunOptions& options) {
    const auto take = [&options](const std::string& text) {
        if (!parseNumber(text, options.maxTime) || options.maxTime < 0) {
            throw CLI::ValidationError("--max-time", fmt::format("'{}' is not a number of seconds", text));
        }
        options.hasMaxTime = true;
    };
    app.add_option_function<std::string>("--max-time", take,
                                         "end the run at this virtual time (exit status 4)")
        ->type_name("SECONDS");
}

} // namespace

void addRunOptions(CLI::App& app, RunOptions& options, bool withTasks) {
    app.add_option("--cycles", options.cycles, "how often main is run; 0 = for ever; default 1")
        ->check(CLI::NonNegativeNumber)
        ->type_name("N");
    if (withTasks) {
        app.add_option(
               "--task", options.tasks,
               "add a task running INPUT's main; NAME:STATIC= and NAME:SEMISTATIC= give its type; repeatable")
            ->type_name("NAME[:TYPE]=INPUT")
            ->take_all();
    }
    app.add_option("--config", options.configFiles,
                   "EIO, SYS, MOC, SIO or PROC parameters in ABB's text format; repeatable")
        ->type_name("FILE.cfg")
        ->take_all();
    app.add_option("--robot", options.robot, fmt::format("robot model; default \"{}\"", kDefaultRobot))
        ->type_name("MODEL");
    app.add_option("--home", options.home,
                   "the controller's HOME:; default: an empty folder, removed at the end")
        ->type_name("DIR");
    app.add_option("--stimulus", options.stimulus, "what happens from outside: lines time_s,target,value")
        ->type_name("FILE.csv");
    app.add_option("--trace", options.trace, "write the robot's motion, a sample each 4 ms")
        ->type_name("FILE.csv");
    app.add_option("--signals", options.signals, "write every change of a signal")->type_name("FILE.csv");
    app.add_option("--events", options.events, "write the event log, an object a line")
        ->type_name("FILE.jsonl");
    app.add_flag("--realtime", options.realtime, "pace virtual time to the wall clock");
    addMaxTime(app, options);
    app.add_option("--seed", options.seed, "start value of Rand; default 1")->type_name("N");
    addRate(app, options);
}

} // namespace rt
