// Events as JSON and as text.

#include "runtime/log/event.h"

#include "config/json_text.h"
#include "config/text_util.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace rt {
namespace {

nlohmann::ordered_json jsonOf(const SourcePlace& place) {
    nlohmann::ordered_json json;
    json["module"] = place.module;
    json["routine"] = place.routine;
    json["line"] = place.line;
    json["column"] = place.column;
    json["file"] = place.file;
    return json;
}

std::string placeText(const SourcePlace& place) {
    std::string text = place.module;
    if (place.line != 0) text += fmt::format(":{}", place.line);
    if (place.routine.empty()) return text;
    return text.empty() ? place.routine : fmt::format("{} in {}", text, place.routine);
}

std::string groupedDigits(uint64_t number) {
    std::string text = std::to_string(number);
    for (std::size_t at = text.size(); at > 3;)
        text.insert(at -= 3, ",");
    return text;
}

bool samePlace(const SourcePlace& a, const SourcePlace& b) {
    return std::tie(a.line, a.column, a.module, a.routine, a.file) ==
           std::tie(b.line, b.column, b.module, b.routine, b.file);
}

} // namespace

bool Event::repeats(const Event& other) const {
    return std::tie(number, type, errorNumber, title, text, task, arguments) ==
               std::tie(other.number, other.type, other.errorNumber, other.title, other.text, other.task,
                        other.arguments) &&
           samePlace(place, other.place) &&
           std::equal(calls.begin(), calls.end(), other.calls.begin(), other.calls.end(), samePlace);
}

const char* typeName(EventType type) {
    switch (type) {
    case EventType::Information: return "information";
    case EventType::Warning: return "warning";
    case EventType::Error: return "error";
    }
    return "error";
}

const char* domainName(int eventNumber) {
    switch (eventNumber / 10'000) {
    case 0: return "common";
    case 1: return "operational";
    case 2: return "system";
    case 3: return "hardware";
    case 4: return "program";
    case 5: return "motion";
    case 7: return "io";
    case 8: return "user";
    case 9: return "safety";
    case 11: return "process";
    case 12: return "configuration";
    default: return "other";
    }
}

std::string toJson(const Event& event) {
    nlohmann::ordered_json json;
    const auto microseconds = event.time / kMicrosecond; // whole ones
    json["sequence"] = event.sequence;
    json["number"] = event.number;
    json["type"] = typeName(event.type);
    json["category"] = domainName(event.number);
    json["title"] = event.title;
    json["text"] = event.text;
    json["time"] = static_cast<double>(microseconds) / 1e6;
    if (event.count > 1) {
        json["count"] = event.count;
        json["since"] = static_cast<double>(event.since / kMicrosecond) / 1e6;
    }
    json["task"] = event.task;
    json["module"] = event.place.module;
    json["routine"] = event.place.routine;
    json["line"] = event.place.line;
    if (!event.place.file.empty()) json["file"] = event.place.file;
    if (event.errorNumber != 0) json["errno"] = event.errorNumber;
    if (!event.errorName.empty()) json["errorName"] = event.errorName;
    if (!event.calls.empty()) {
        for (const SourcePlace& call : event.calls)
            json["calls"].push_back(jsonOf(call));
    }
    // Text of a program may hold bytes that are not UTF-8: they are replaced and never cause a failure.
    return rapid::config::textOf(json);
}

std::string toText(const Event& event) {
    std::string text = fmt::format("[{} s] {} {}: {}", formatSeconds(event.time, 3), typeName(event.type),
                                   event.number, event.title);
    if (event.count > 1)
        text += fmt::format(" (x {} since {} s)", groupedDigits(event.count), formatSeconds(event.since, 3));
    text += '\n';
    if (!event.text.empty()) text += rapid::config::indented(event.text) + '\n';
    if (!event.task.empty()) {
        const std::string place = placeText(event.place);
        text += place.empty() ? fmt::format("    in task {}\n", event.task)
                              : fmt::format("    at {} {}\n", event.task, place);
    }
    for (const SourcePlace& call : event.calls)
        text += fmt::format("    called from {}\n", placeText(call));
    return text;
}

} // namespace rt
