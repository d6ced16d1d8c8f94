#include "config/json_text.h"
#include "tools/testing/reports.h"

namespace testing {
namespace {

nlohmann::ordered_json placeJson(const Spot& spot) {
    nlohmann::ordered_json json;
    json["file"] = spot.file;
    json["line"] = spot.line;
    json["column"] = spot.column;
    if (!spot.routine.empty()) json["routine"] = spot.routine;
    return json;
}

nlohmann::ordered_json testJson(const TestCase& test) {
    nlohmann::ordered_json json;
    json["id"] = test.id;
    json["task"] = test.task;
    json["module"] = test.module;
    json["name"] = test.name;
    json["file"] = test.file;
    json["line"] = test.line;
    json["column"] = test.column;
    json["endLine"] = test.endLine;
    if (test.skip) json["skip"] = *test.skip;
    if (!test.problem.empty()) json["problem"] = test.problem;
    return json;
}

} // namespace

std::string jsonText(const std::vector<Finished>& results) {
    nlohmann::ordered_json document;
    document["tests"] = nlohmann::ordered_json::array();
    for (const Finished& one : results) {
        nlohmann::ordered_json json = testJson(one.test);
        const TestResult& result = one.result;
        json["outcome"] = nameOf(result.outcome);
        if (!result.message.empty()) json["message"] = result.message;
        if (result.outcome != Outcome::Passed && result.spot.line > 0) json["at"] = placeJson(result.spot);
        if (!result.expected.empty()) {
            json["expected"] = result.expected;
            json["actual"] = result.actual;
        }
        for (const Spot& call : result.calls)
            json["calls"].push_back(placeJson(call));
        json["assertions"] = result.assertions;
        json["virtualTime"] = static_cast<double>(result.virtualTime) / 1e9;
        json["wallTime"] = result.wallTime;
        if (!result.output.empty()) json["output"] = result.output;
        if (!result.events.empty()) json["events"] = result.events;
        document["tests"].push_back(std::move(json));
    }
    const Totals totals = totalsOf(results);
    document["totals"] = {{"tests", totals.all()},       {"passed", totals.passed},
                          {"failed", totals.failed},     {"errors", totals.errors},
                          {"timeouts", totals.timeouts}, {"skipped", totals.skipped}};
    return rapid::config::textOf(document, 2) + "\n";
}

std::string listJson(const std::vector<TestCase>& tests) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const TestCase& test : tests)
        list.push_back(testJson(test));
    return rapid::config::textOf(list, 2) + "\n";
}

} // namespace testing
