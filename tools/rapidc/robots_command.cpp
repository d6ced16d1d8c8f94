// rapidc robots: the robot models that --robot and MOC.cfg may name.

#include "config/json_text.h"
#include "tools/rapidc/commands.h"

#include "runtime/host/command_line.h"
#include "runtime/host/run_options.h"
#include "runtime/robot/robot_model.h"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>

namespace rapidc {

namespace {

/// Remarks for a user of a model; "" for none.
const char* limitationOf(const robot::RobotModel& model) {
    const bool isEstimated = std::find(model.provisional.begin(), model.provisional.end(), "geometry_mm") !=
                             model.provisional.end();
    return isEstimated ? "lengths are estimated" : "";
}

std::vector<robot::RobotModel> allModels() {
    std::vector<robot::RobotModel> models;
    for (const std::string& name : robot::robotModelNames())
        if (auto model = robot::loadRobotModel(name)) models.push_back(std::move(*model));
    return models;
}

void printTable(const std::vector<robot::RobotModel>& models) {
    fmt::print("{:<26} {:>10} {:>8}  {}\n", "model", "payload kg", "reach m", "note");
    for (const robot::RobotModel& model : models) {
        std::string note = limitationOf(model);
        if (model.name == rt::kDefaultRobot) note = "default";
        fmt::print("{:<26} {:>10g} {:>8g}{}{}\n", model.name, model.payloadKg, model.reachM,
                   note.empty() ? "" : "  ", note);
    }
    fmt::print(
        "\n{} models; --robot takes a name, a part of it that fits one model only (irb120), or the path of a "
        "model file (.json)\n",
        models.size());
}

void printTsv(const std::vector<robot::RobotModel>& models) {
    fmt::print("model\tpayload_kg\treach_m\tdefault\tnote\n");
    for (const robot::RobotModel& model : models)
        fmt::print("{}\t{:g}\t{:g}\t{}\t{}\n", model.name, model.payloadKg, model.reachM,
                   model.name == rt::kDefaultRobot ? "yes" : "no", limitationOf(model));
}

void printJson(const std::vector<robot::RobotModel>& models) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const robot::RobotModel& model : models) {
        nlohmann::ordered_json row;
        row["model"] = model.name;
        row["payloadKg"] = model.payloadKg;
        row["reachM"] = model.reachM;
        row["default"] = model.name == rt::kDefaultRobot;
        row["lowerDeg"] = model.lowerDeg;
        row["upperDeg"] = model.upperDeg;
        row["maxSpeedDegPerS"] = model.maxSpeed;
        row["note"] = limitationOf(model);
        list.push_back(std::move(row));
    }
    fmt::print("{}\n", rapid::config::textOf(list, 2));
}

int listRobots(const std::string& format) {
    const std::vector<robot::RobotModel> models = allModels();
    if (format == "json")
        printJson(models);
    else if (format == "tsv")
        printTsv(models);
    else
        printTable(models);
    return 0;
}

} // namespace

void addRobotsCommand(rt::CommandLine& line) {
    auto format = std::make_shared<std::string>("human");
    const rt::Command command =
        line.addCommand("robots", "List the robot models", [format] { return listRobots(*format); });
    command.add("--format", *format, "human, tsv or json").oneOf({"human", "tsv", "json"});
}

} // namespace rapidc
