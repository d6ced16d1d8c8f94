// The state file as text: JSON, versioned. The text comes from a disk and may be anything.

#include "config/json_text.h"
#include "runtime/host/chain_image.h"
#include "runtime/host/json_numbers.h"
#include "runtime/host/path_image.h"
#include "runtime/host/saved_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace rt {
namespace {

using Json = nlohmann::json;
using Data = std::map<std::string, StateImage::Datum>;

constexpr const char* kFormat = "rapidc controller state";
constexpr int kVersion = 2;
constexpr std::pair<const char*, StateImage::Pointer> kPointers[] = {
    {"main", StateImage::Pointer::Main},
    {"ended", StateImage::Pointer::Ended},
    {"inside", StateImage::Pointer::Inside},
    {"exited", StateImage::Pointer::Exited},
};

Json jsonOf(const Data& data) {
    Json json = Json::object();
    for (const auto& [key, datum] : data)
        json[key] = {{"type", datum.type}, {"initial", datum.initial}, {"value", datum.value}};
    return json;
}

Json jsonOf(const Event& event) {
    return {
        {"sequence", event.sequence}, {"number", event.number},       {"type", static_cast<int>(event.type)},
        {"title", event.title},       {"text", event.text},           {"time", event.time},
        {"task", event.task},         {"module", event.place.module}, {"routine", event.place.routine},
        {"file", event.place.file},   {"line", event.place.line},     {"column", event.place.column},
        {"errno", event.errorNumber}, {"errorName", event.errorName}, {"arguments", event.arguments},
        {"count", event.count},       {"since", event.since}};
}

Json jsonOf(const StateImage::TaskImage& task) {
    Json json = {{"pointer", kPointers[static_cast<std::size_t>(task.pointer)].first},
                 {"place", task.place},
                 {"cycles", task.cycles}};
    if (task.pointer != StateImage::Pointer::Inside) return json;
    if (!task.chain) {
        json["refusal"] = task.refusal;
        return json;
    }
    json["chain"] = jsonOf(*task.chain);
    json["interruptsEnabled"] = task.interruptsEnabled;
    json["queuedInterrupts"] = task.queuedInterrupts;
    json["interrupts"] = Json::array();
    for (const StateImage::Interrupt& interrupt : task.interrupts) {
        Json row = jsonOf(interrupt.what);
        row["module"] = interrupt.module;
        row["routine"] = interrupt.routine;
        json["interrupts"].push_back(std::move(row));
    }
    return json;
}

// at(), get() and whole() throw what readImage catches.

template <class Integer> void whole(const Json& json, Integer& value) {
    value = static_cast<Integer>(numberFrom<int64_t>(json));
}

Data dataFrom(const Json& json) {
    Data data;
    for (const auto& [key, row] : json.items())
        data[key] = {row.at("type").get<std::string>(), row.at("initial").get<std::string>(),
                     row.at("value").get<std::string>()};
    return data;
}

Event eventFrom(const Json& json) {
    Event event;
    whole(json.at("sequence"), event.sequence);
    whole(json.at("number"), event.number);
    int type = 0;
    whole(json.at("type"), type);
    event.type = static_cast<EventType>(std::clamp(type, 1, 3));
    json.at("title").get_to(event.title);
    json.at("text").get_to(event.text);
    whole(json.at("time"), event.time);
    json.at("task").get_to(event.task);
    json.at("module").get_to(event.place.module);
    json.at("routine").get_to(event.place.routine);
    json.at("file").get_to(event.place.file);
    whole(json.at("line"), event.place.line);
    whole(json.at("column"), event.place.column);
    whole(json.at("errno"), event.errorNumber);
    json.at("errorName").get_to(event.errorName);
    json.at("arguments").get_to(event.arguments);
    if (json.contains("count")) { // not in images of earlier versions
        whole(json.at("count"), event.count);
        whole(json.at("since"), event.since);
        if (event.count == 0) event.count = 1;
    }
    return event;
}

StateImage::TaskImage taskFrom(const Json& json) {
    StateImage::TaskImage task;
    const auto word = json.at("pointer").get<std::string>();
    for (const auto& [name, pointer] : kPointers)
        if (word == name) task.pointer = pointer;
    json.at("place").get_to(task.place);
    if (json.contains("refusal")) json.at("refusal").get_to(task.refusal);
    if (json.contains("cycles")) whole(json.at("cycles"), task.cycles);
    if (!json.contains("chain")) return task;
    task.chain = chainFrom(json.at("chain"));
    json.at("interruptsEnabled").get_to(task.interruptsEnabled);
    for (const Json& queued : json.value("queuedInterrupts", Json::array()))
        whole(queued, task.queuedInterrupts.emplace_back());
    for (const Json& row : json.at("interrupts"))
        task.interrupts.push_back(
            {interruptFrom(row), row.at("module").get<std::string>(), row.at("routine").get<std::string>()});
    return task;
}

StateImage imageFrom(const Json& json, const robot::UnitLookup& units) {
    StateImage image;
    for (const auto& [name, task] : json.at("tasks").items())
        image.tasks[name] = taskFrom(task);
    image.persistents = dataFrom(json.at("persistents"));
    image.variables = dataFrom(json.at("variables"));
    image.interruptNumbers = dataFrom(json.at("interruptNumbers"));
    for (const auto& [name, kept] : json.at("kept").items())
        image.kept[name] = rapid::config::textOf(kept);
    json.at("signals").get_to(image.signals);
    for (const Json& group : json.at("groups"))
        image.groups.push_back({group.at("robot").get<std::string>(),
                                group.at("axes").get<std::vector<double>>(),
                                earlierPathFrom(group.at("motion"), units)});
    if (json.contains("synchronised")) json.at("synchronised").get_to(image.synchronised);
    for (const Json& event : json.at("events"))
        image.events.push_back(eventFrom(event));
    return image;
}

} // namespace

std::string writeImage(const StateImage& image) {
    Json tasks = Json::object(), events = Json::array();
    for (const auto& [name, task] : image.tasks)
        tasks[name] = jsonOf(task);
    for (const Event& event : image.events)
        events.push_back(jsonOf(event));
    Json kept = Json::object();
    Json groups = Json::array();
    for (const StateImage::Group& group : image.groups)
        groups.push_back({{"robot", group.robot}, {"axes", group.axes}, {"motion", jsonOf(group.path)}});
    for (const auto& [name, text] : image.kept)
        kept[name] = rapid::config::tryParseJson(text);
    const Json json = {{"format", kFormat},
                       {"version", kVersion},
                       {"tasks", tasks},
                       {"persistents", jsonOf(image.persistents)},
                       {"variables", jsonOf(image.variables)},
                       {"interruptNumbers", jsonOf(image.interruptNumbers)},
                       {"kept", kept},
                       {"signals", image.signals},
                       {"groups", groups},
                       {"synchronised", image.synchronised},
                       {"events", events}};
    return rapid::config::textOf(json, 1) + "\n";
}

std::string readImage(const std::string& text, StateImage& image, const robot::UnitLookup& units) {
    const Json json = rapid::config::tryParseJson(text);
    if (json.is_discarded()) return "it is not JSON text, or only a part of it";
    if (!json.is_object() || json.value("format", Json()) != kFormat)
        return "it is not the state of a controller";
    if (json.value("version", Json()) != kVersion) return "it was written by another version of rapidc";
    try {
        image = imageFrom(json, units);
    } catch (const std::exception&) {
        return "a part of it is missing or has a different form";
    }
    return {};
}

} // namespace rt
