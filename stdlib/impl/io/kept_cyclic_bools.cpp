// Cyclic bools between two processes (--state): conditions over data and signals, which are known by their names.

#include "config/json_text.h"
#include "runtime/base/text_util.h"
#include "runtime/debug/state_keepers.h"
#include "runtime/host/json_numbers.h"
#include "stdlib/impl/io/cyclic_bools.h"
#include "stdlib/impl/io/signals.h"
#include "stdlib/impl/support/data_names.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <utility>

namespace rt::lib {
namespace {

using Json = nlohmann::json;

/// Module data by name, and the place of a part in them.
Json jsonOfPlace(Controller& controller, const void* address) {
    const GlobalDesc* data = dataAt(controller, address);
    if (data == nullptr) throw std::invalid_argument("data of a routine");
    const std::ptrdiff_t offset = static_cast<const char*>(address) - static_cast<const char*>(data->address);
    return {{"module", data->module}, {"name", data->name}, {"task", data->task}, {"offset", offset}};
}

void* placeFrom(Controller& controller, const Json& json, std::size_t size) {
    const auto name = json.at("name").get<std::string>(), module = json.at("module").get<std::string>();
    const auto task = numberFrom<int32_t>(json.at("task"));
    const auto offset = numberFrom<uint32_t>(json.at("offset"));
    for (const GlobalDesc* data : controller.tables().globals())
        if (data->task == task && sameName(data->name, name) && sameName(data->module, module) &&
            offset + size <= data->type->size)
            return static_cast<char*>(data->address) + offset;
    throw std::invalid_argument("there are no such data now");
}

std::string nameOf(const IoSystem& io, Handle signal) {
    return signal == 0 ? std::string() : io.config(io.idOf(signal)).name;
}

Handle signalFrom(const IoSystem& io, const Json& json) {
    const auto name = json.get<std::string>();
    const Handle signal = name.empty() ? 0 : signalNamed(io, name);
    if (signal == 0 && !name.empty()) throw std::invalid_argument("there is no such signal now");
    return signal;
}

std::size_t sizeOf(Condition::Form form) {
    switch (form) {
    case Condition::Form::Bool: return sizeof(uint8_t);
    case Condition::Form::Num: return sizeof(float);
    case Condition::Form::Dnum: break;
    }
    return sizeof(double);
}

Json jsonOf(Controller& controller, const Condition& condition) {
    Json list = Json::array();
    for (const Condition::Step& step : condition.steps()) {
        Json json{{"kind", static_cast<int>(step.kind)},
                  {"dnum", step.asDnum},
                  {"form", static_cast<int>(step.form)},
                  {"operation", static_cast<int>(step.operation)},
                  {"value", step.value},
                  {"signal", nameOf(controller.io(), step.signal)}};
        if (step.data != nullptr) json["data"] = jsonOfPlace(controller, step.data);
        list.push_back(std::move(json));
    }
    return list;
}

/// As Condition evaluates it: each operator finds its operands.
Condition conditionFrom(Controller& controller, const Json& list) {
    Condition condition;
    int depth = 0;
    for (const Json& json : list) {
        const bool asDnum = json.at("dnum").get<bool>();
        switch (numberFrom<int>(json.at("kind"))) {
        case static_cast<int>(Condition::Kind::Value):
            condition.pushValue(json.at("value").get<double>());
            break;
        case static_cast<int>(Condition::Kind::Data): {
            const int form = numberFrom<int>(json.at("form"));
            if (form < 0 || form > static_cast<int>(Condition::Form::Dnum))
                throw std::invalid_argument("no such form");
            const auto known = static_cast<Condition::Form>(form);
            condition.pushData(placeFrom(controller, json.at("data"), sizeOf(known)), known);
            break;
        }
        case static_cast<int>(Condition::Kind::Signal):
            condition.pushSignal(signalFrom(controller.io(), json.at("signal")), asDnum);
            break;
        case static_cast<int>(Condition::Kind::Operator): {
            const int operation = numberFrom<int>(json.at("operation"));
            if (operation < 0 || operation > static_cast<int>(ConditionOperator::Modulo))
                throw std::invalid_argument("no such operator");
            const auto known = static_cast<ConditionOperator>(operation);
            condition.pushOperator(known, asDnum);
            const bool takesOne = known == ConditionOperator::Not || known == ConditionOperator::Negate;
            depth -= takesOne ? 1 : 2;
            if (depth < 0) throw std::invalid_argument("an operator without operands");
            break;
        }
        default: throw std::invalid_argument("no such kind");
        }
        ++depth;
    }
    if (depth != 1) throw std::invalid_argument("no single value");
    return condition;
}

/// Data of routines do not survive.
bool isKept(const Controller& controller, const CyclicBool& entry) {
    const auto& steps = entry.condition.steps();
    return dataAt(controller, entry.flag) != nullptr &&
           std::all_of(steps.begin(), steps.end(), [&](const Condition::Step& step) {
               return step.data == nullptr || dataAt(controller, step.data) != nullptr;
           });
}

} // namespace

void keepCyclicBools(Controller& controller, StateKeepers& kept) {
    const auto save = [&controller] {
        Json list = Json::array();
        for (const auto& entry : controller.service<CyclicBools>().all()) {
            if (!isKept(controller, *entry)) continue;
            list.push_back({{"name", entry->name},
                            {"flag", jsonOfPlace(controller, entry->flag)},
                            {"output", nameOf(controller.io(), entry->output)},
                            {"task", entry->task},
                            {"condition", jsonOf(controller, entry->condition)}});
        }
        return list;
    };
    const auto load = [&controller](const Json& list) {
        for (const Json& json : list) {
            CyclicBool entry;
            json.at("name").get_to(entry.name);
            entry.flag = static_cast<bool*>(placeFrom(controller, json.at("flag"), sizeof(bool)));
            entry.output = signalFrom(controller.io(), json.at("output"));
            entry.task = numberFrom<uint32_t>(json.at("task"));
            entry.condition = conditionFrom(controller, json.at("condition"));
            if (!controller.service<CyclicBools>().add(controller, std::move(entry)))
                throw std::invalid_argument("too many cyclic bools");
        }
    };
    kept.keepers["cyclicBools"] = {save, load};
}

} // namespace rt::lib
