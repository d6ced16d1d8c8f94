#include "runtime/host/chain_image.h"

#include "runtime/host/json_numbers.h"

#include <string>
#include <utility>

namespace rt {
namespace {

using Json = nlohmann::json;

constexpr std::pair<const char*, SavedLocal::Kind> kLocalKinds[] = {
    {"value", SavedLocal::Kind::Value},   {"absent", SavedLocal::Kind::Absent},
    {"object", SavedLocal::Kind::Object}, {"copy", SavedLocal::Kind::Copy},
    {"fresh", SavedLocal::Kind::Fresh},
};

Json imageOf(const SourcePlace& place) {
    return {{"module", place.module},
            {"routine", place.routine},
            {"file", place.file},
            {"line", place.line},
            {"column", place.column}};
}

SourcePlace placeFrom(const Json& json) {
    SourcePlace place;
    json.at("module").get_to(place.module);
    json.at("routine").get_to(place.routine);
    json.at("file").get_to(place.file);
    place.line = numberFrom<uint32_t>(json.at("line"));
    place.column = numberFrom<uint32_t>(json.at("column"));
    return place;
}

Json imageOf(const SavedLocal& local) {
    Json json = {{"kind", kLocalKinds[static_cast<std::size_t>(local.kind)].first}, {"type", local.type}};
    if (!local.value.empty()) json["value"] = local.value;
    if (!local.object.empty()) {
        json["object"] = local.object;
        json["offset"] = local.offset;
    }
    return json;
}

SavedLocal localFrom(const Json& json) {
    SavedLocal local;
    const auto word = json.at("kind").get<std::string>();
    for (const auto& [name, kind] : kLocalKinds)
        if (word == name) local.kind = kind;
    json.at("type").get_to(local.type);
    if (json.contains("value")) json.at("value").get_to(local.value);
    if (json.contains("object")) {
        json.at("object").get_to(local.object);
        local.offset = numberFrom<uint64_t>(json.at("offset"));
    }
    return local;
}

Json imageOf(const SavedFrame& frame) {
    Json locals = Json::array();
    for (const SavedLocal& local : frame.locals)
        locals.push_back(imageOf(local));
    return {{"module", frame.module},       {"routine", frame.routine}, {"text", frame.textHash},
            {"statement", frame.statement}, {"failed", frame.failed},   {"locals", locals}};
}

SavedFrame frameFrom(const Json& json) {
    SavedFrame frame;
    json.at("module").get_to(frame.module);
    json.at("routine").get_to(frame.routine);
    frame.textHash = numberFrom<uint32_t>(json.at("text"));
    frame.statement = numberFrom<int32_t>(json.at("statement"));
    frame.failed = numberFrom<int32_t>(json.at("failed"));
    for (const Json& local : json.at("locals"))
        frame.locals.push_back(localFrom(local));
    return frame;
}

Json imageOf(const ErrorMemory& errors) {
    Json retries = Json::array();
    for (const ErrorMemory::Retries& entry : errors.retries) {
        Json counts = Json::array();
        for (const auto& [number, count] : entry.counts)
            counts.push_back({number, count});
        retries.push_back({{"depth", entry.depth},
                           {"statement", entry.statement},
                           {"number", entry.number},
                           {"counts", counts}});
    }
    Json json = {{"errno", errors.errorNumber},
                 {"intno", errors.interruptNumber},
                 {"text", errors.text},
                 {"place", imageOf(errors.place)},
                 {"retries", retries}};
    if (errors.handled)
        json["handled"] = {{"depth", errors.handled->depth},
                           {"number", errors.handled->number},
                           {"text", errors.handled->text},
                           {"place", imageOf(errors.handled->place)}};
    return json;
}

/// Earlier versions wrote 1003.0.
int32_t wholeNumberFrom(const Json& json) {
    const auto number = numberFrom<double>(json);
    if (!(number >= INT32_MIN && number <= INT32_MAX)) throw std::invalid_argument("no number of this kind");
    return static_cast<int32_t>(number);
}

ErrorMemory errorsFrom(const Json& json) {
    ErrorMemory errors;
    errors.errorNumber = wholeNumberFrom(json.at("errno"));
    errors.interruptNumber = wholeNumberFrom(json.at("intno"));
    json.at("text").get_to(errors.text);
    errors.place = placeFrom(json.at("place"));
    for (const Json& entry : json.at("retries")) {
        ErrorMemory::Retries retries;
        retries.depth = numberFrom<std::size_t>(entry.at("depth"));
        retries.statement = numberFrom<int32_t>(entry.at("statement"));
        retries.number = numberFrom<int>(entry.at("number"));
        for (const Json& count : entry.at("counts"))
            retries.counts[numberFrom<int>(count.at(0))] = numberFrom<int>(count.at(1));
        errors.retries.push_back(std::move(retries));
    }
    if (!json.contains("handled")) return errors;
    const Json& handled = json.at("handled");
    errors.handled = {numberFrom<std::size_t>(handled.at("depth")), numberFrom<int>(handled.at("number")),
                      handled.at("text").get<std::string>(), placeFrom(handled.at("place"))};
    return errors;
}

} // namespace

Json jsonOf(const CallChain& chain) {
    Json frames = Json::array();
    for (const SavedFrame& frame : chain.frames)
        frames.push_back(imageOf(frame));
    return {{"frames", frames}, {"afterStop", chain.afterStop}, {"errors", imageOf(chain.errors)}};
}

CallChain chainFrom(const Json& json) {
    CallChain chain;
    for (const Json& frame : json.at("frames"))
        chain.frames.push_back(frameFrom(frame));
    json.at("afterStop").get_to(chain.afterStop);
    chain.errors = errorsFrom(json.at("errors"));
    return chain;
}

} // namespace rt
