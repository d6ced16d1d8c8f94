// Message queues between two processes (--state): a message is kept with the name and the components of its type, and given
// back when the program still has that type.

#include "config/json_text.h"
#include "stdlib/impl/queues/message_queue.h"

#include "runtime/debug/call_chain.h"
#include "runtime/debug/state_keepers.h"
#include "runtime/host/json_numbers.h"
#include "runtime/value/value_text.h"

#include <stdexcept>

namespace rt::lib {
namespace {

using Json = nlohmann::json;

constexpr uint64_t kLargest = 1 << 20; // bytes, elements of a dimension; far more than a queue takes

Json jsonOf(Controller& controller, const Message& message) {
    std::string value;
    (void)valueToImage(message.bytes.data(), *message.element, message.bytes.size() / message.element->size,
                       controller.service<StateKeepers>(), value); // messages hold values only
    const MessageQueue* sender = MessageQueues::of(controller).find(message.sender);
    return {{"type", message.typeName()},
            {"components", describeType(*message.element)},
            {"dimensions", message.dimensions},
            {"value", value},
            {"sender", sender == nullptr ? "" : sender->name},
            {"userDefined", message.userDefined}};
}

bool fits(const TypeDesc& type, const std::string& name, const std::string& components) {
    return name == type.baseName && describeType(type) == components;
}

/// The type among those that `type` consists of; null: it is not there.
const TypeDesc* within(const TypeDesc& type, const std::string& name, const std::string& components) {
    if (fits(type, name, components)) return &type;
    if (type.kind != DescKind::Record && type.kind != DescKind::Array) return nullptr;
    const uint32_t parts = type.kind == DescKind::Array ? 1 : type.count;
    for (uint32_t i = 0; i < parts; ++i)
        if (const TypeDesc* found = within(*type.fields[i], name, components)) return found;
    return nullptr;
}

/// A type of the program, which some of its data have; null when there is none.
const TypeDesc* typeNamed(const ProgramTables& tables, const std::string& name,
                          const std::string& components) {
    for (const GlobalDesc* data : tables.globals())
        if (const TypeDesc* found = within(*data->type, name, components)) return found;
    for (const RoutineEntry* routine : tables.routines()) {
        for (uint32_t i = 0; routine->desc != nullptr && i < routine->desc->localCount; ++i) {
            const TypeDesc* type = routine->desc->locals[i].type;
            if (type == nullptr) continue;
            if (const TypeDesc* found = within(*type, name, components)) return found;
        }
    }
    return nullptr;
}

Message messageFrom(Controller& controller, const Json& json) {
    Message message;
    message.element = typeNamed(controller.tables(), json.at("type").get<std::string>(),
                                json.at("components").get<std::string>());
    if (message.element == nullptr) throw std::invalid_argument("the program has no such type now");
    uint64_t elements = 1;
    for (std::size_t i = 0; i < message.dimensions.size(); ++i) {
        const auto dimension = numberFrom<int64_t>(json.at("dimensions").at(i));
        if (dimension < 0 || static_cast<uint64_t>(dimension) > kLargest)
            throw std::invalid_argument("no message is that large");
        message.dimensions[i] = static_cast<int32_t>(dimension);
        if (dimension > 0) elements *= static_cast<uint64_t>(dimension);
    }
    const auto value = json.at("value").get<std::string>();
    if (elements > kLargest || elements * message.element->size > kLargest)
        throw std::invalid_argument("no message is that large");
    message.bytes.resize(elements * message.element->size);
    if (!imageToValue(value, message.bytes.data(), *message.element, elements,
                      controller.service<StateKeepers>()))
        throw std::invalid_argument("no value of this type");
    message.sender = MessageQueues::of(controller).findByName(json.at("sender").get<std::string>());
    json.at("userDefined").get_to(message.userDefined);
    return message;
}

Json saveQueues(Controller& controller) {
    Json all = Json::object();
    MessageQueues& queues = MessageQueues::of(controller);
    for (const auto& task : controller.tasks()) {
        const MessageQueue& queue = *queues.find(queues.slotOf(*task));
        for (const Message& message : queue.messages)
            all[queue.name].push_back(jsonOf(controller, message));
    }
    return all;
}

void loadQueues(Controller& controller, const Json& all) {
    MessageQueues& queues = MessageQueues::of(controller);
    for (const auto& [name, messages] : all.items()) {
        MessageQueue* queue = queues.find(queues.findByName(name));
        if (queue == nullptr) throw std::invalid_argument("there is no such queue now");
        for (const Json& message : messages)
            queue->messages.push_back(messageFrom(controller, message));
    }
}

} // namespace

void keepMessages(Controller& controller, StateKeepers& kept) {
    kept.keepers["messageQueues"] = {[&controller] { return saveQueues(controller); },
                                     [&controller](const Json& json) { loadQueues(controller, json); }};
    kept.handles["rmqslot"] = {
        [&controller](Handle handle) {
            const MessageQueue* queue = MessageQueues::of(controller).find(handle);
            return queue == nullptr ? std::string() : queue->name;
        },
        [&controller](const std::string& name) { return MessageQueues::of(controller).findByName(name); }};
    kept.handles["rmqmessage"] = {[&controller](Handle handle) {
                                      const Message* message = MessageQueues::of(controller).kept(handle);
                                      return message == nullptr
                                                 ? std::string()
                                                 : rapid::config::textOf(jsonOf(controller, *message));
                                  },
                                  [&controller](const std::string& text) {
                                      return MessageQueues::of(controller)
                                          .keep(messageFrom(controller, rapid::config::parseJson(text)));
                                  }};
}

} // namespace rt::lib
