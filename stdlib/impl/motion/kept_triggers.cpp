// Triggers between two processes (--state): a triggdata keeps its contents, with the names of signals and persistents in place
// of where they lie.

#include "config/json_text.h"
#include "stdlib/impl/motion/triggers.h"

#include "runtime/debug/state_keepers.h"
#include "runtime/host/json_numbers.h"
#include "stdlib/impl/io/signals.h"
#include "stdlib/impl/support/data_names.h"

#include <stdexcept>

namespace rt::lib {
namespace {

using Json = nlohmann::json;
using TriggerKind = TriggerDefinition::Kind;

/// None when there was none.
Handle signalFrom(Controller& controller, const Json& json) {
    const auto name = json.get<std::string>();
    const Handle signal = name.empty() ? 0 : signalNamed(controller.io(), name);
    if (signal == 0 && !name.empty()) throw std::invalid_argument("there is no such signal now");
    return signal;
}

/// Task and name: modules of several tasks may have the same names.
Json dataName(Controller& controller, const void* data) {
    if (data == nullptr) return nullptr;
    const std::string name = nameOfData(controller, data);
    for (const auto& task : controller.tasks())
        if (dataByName(*task, name).data == data) return {task->name(), name};
    throw std::invalid_argument("the persistent has no name");
}

AnyRef dataNamed(Controller& controller, const Json& json) {
    if (json.is_null()) return {};
    const Task* task = controller.findTask(json.at(0).get<std::string>());
    const AnyRef found = task == nullptr ? AnyRef{} : dataByName(*task, json.at(1).get<std::string>());
    if (found.data == nullptr) throw std::invalid_argument("there is no such persistent now");
    return found;
}

Json jsonOf(Controller& controller, const TriggerDefinition& d) {
    return {{"kind", static_cast<int>(d.kind)},
            {"amount", d.place.amount},
            {"fromStart", d.place.fromStart},
            {"inTime", d.place.inTime},
            {"next", d.place.nextMove},
            {"lag", d.place.lag},
            {"delay", d.delay},
            {"signal", signalName(controller.io(), d.signal)},
            {"value", d.value},
            {"rampLength", d.rampLength},
            {"rampInTime", d.rampInTime},
            {"dipLag", d.dipLag},
            {"error", signalName(controller.io(), d.errorSignal)},
            {"relation", d.relation},
            {"stopMove", d.stopMove},
            {"interrupt", d.interrupt},
            {"inhibit", dataName(controller, d.inhibit)},
            {"inhibitValue", dataName(controller, d.inhibitValue)}};
}

TriggerDefinition definitionFrom(Controller& controller, const Json& json) {
    TriggerDefinition d;
    const int kind = numberFrom<int>(json.at("kind"));
    if (kind < 0 || kind > static_cast<int>(TriggerKind::Check)) throw std::invalid_argument("no such kind");
    d.kind = static_cast<TriggerKind>(kind);
    json.at("amount").get_to(d.place.amount);
    json.at("fromStart").get_to(d.place.fromStart);
    json.at("inTime").get_to(d.place.inTime);
    json.at("next").get_to(d.place.nextMove);
    json.at("lag").get_to(d.place.lag);
    d.delay = numberFrom<Time>(json.at("delay"));
    d.signal = signalFrom(controller, json.at("signal"));
    json.at("value").get_to(d.value);
    json.at("rampLength").get_to(d.rampLength);
    json.at("rampInTime").get_to(d.rampInTime);
    json.at("dipLag").get_to(d.dipLag);
    d.errorSignal = signalFrom(controller, json.at("error"));
    json.at("relation").get_to(d.relation);
    json.at("stopMove").get_to(d.stopMove);
    d.interrupt = numberFrom<int>(json.at("interrupt"));
    const AnyRef inhibit = dataNamed(controller, json.at("inhibit"));
    if (inhibit.data != nullptr && inhibit.type->kind != DescKind::Bool)
        throw std::invalid_argument("no bool any more");
    d.inhibit = static_cast<const bool*>(inhibit.data);
    const AnyRef value = dataNamed(controller, json.at("inhibitValue"));
    d.inhibitValue = value.data;
    d.inhibitType = value.type;
    return d;
}

} // namespace

void keepTriggers(Controller& controller, StateKeepers& kept) {
    const auto textOf = [&controller](Handle handle) -> std::string {
        const TriggerDefinition* definition = controller.service<TriggerStore>().find(handle);
        if (definition == nullptr) return {};
        try {
            return rapid::config::textOf(jsonOf(controller, *definition));
        } catch (const std::invalid_argument&) {
            return {}; // made by a module that was loaded: it is not there in the next process
        }
    };
    const auto make = [&controller](const std::string& text) {
        return controller.service<TriggerStore>().intern(
            definitionFrom(controller, rapid::config::parseJson(text)));
    };
    kept.handles["triggdata"] = {textOf, make};
}

} // namespace rt::lib
