#include "stdlib/impl/queues/message_queue.h"

#include "config/letter_case.h"
#include "runtime/value/value_text.h"
#include "stdlib/impl/interrupts/ordering.h"

#include <algorithm>
#include <cctype>
#include <utility>

namespace rt::lib {
namespace {

// Parameters of a task in SYS.cfg, with the limits of the documentation.
constexpr double kFewestMessages = 1, kMostMessages = 10;
constexpr double kSmallestSize = 400, kLargestSize = 3000;

std::size_t limited(const CfgInstance& task, std::string_view name, std::size_t otherwise, double least,
                    double most) {
    double value = 0;
    return task.number(name, value) ? static_cast<std::size_t>(std::clamp(value, least, most)) : otherwise;
}

void configure(MessageQueue& queue, const CfgInstance& task) {
    queue.exists = !rapid::config::sameName(task.text("RmqType"), "None");
    const std::string mode = task.text("RmqMode");
    if (rapid::config::sameName(mode, "Interrupt")) queue.mode = QueueMode::Interrupt;
    if (rapid::config::sameName(mode, "Synchronous")) queue.mode = QueueMode::Synchronous;
    queue.maxMessages = limited(task, "RmqMaxNoOfMsg", queue.maxMessages, kFewestMessages, kMostMessages);
    queue.maxSize = limited(task, "RmqMaxMsgSize", queue.maxSize, kSmallestSize, kLargestSize);
}

} // namespace

MessageQueues& MessageQueues::of(Controller& controller) {
    auto& queues = controller.service<MessageQueues>();
    if (queues.queues_.empty()) queues.makeQueues(controller);
    return queues;
}

void MessageQueues::makeQueues(Controller& controller) {
    for (const auto& task : controller.tasks()) {
        auto queue = std::make_unique<MessageQueue>();
        queue->name = "RMQ_" + task->name();
        queue->task = task.get();
        for (const CfgInstance* instance : controller.instances("SYS", "CAB_TASKS")) {
            if (rapid::config::sameName(instance->text("Name"), task->name())) configure(*queue, *instance);
        }
        queues_.push_back(std::move(queue));
    }
}

Handle MessageQueues::slotOf(const Task& task) const {
    for (std::size_t i = 0; i < queues_.size(); ++i)
        if (queues_[i]->task == &task) return static_cast<Handle>(i) + 1;
    return 0;
}

MessageQueue* MessageQueues::find(Handle slot) {
    if (slot < 1 || slot > static_cast<Handle>(queues_.size())) return nullptr;
    MessageQueue* queue = queues_[static_cast<std::size_t>(slot - 1)].get();
    return queue->task != nullptr || queue->exists ? queue : nullptr;
}

Handle MessageQueues::findByName(std::string_view name) const {
    for (std::size_t i = 0; i < queues_.size(); ++i)
        if (queues_[i]->exists && rapid::config::sameName(queues_[i]->name, name))
            return static_cast<Handle>(i) + 1;
    return 0;
}

bool MessageQueues::addOutside(std::string name, std::size_t maxSize, std::function<bool(Message)> deliver) {
    if (findByName(name) != 0) return false;
    auto queue = std::make_unique<MessageQueue>();
    queue->name = std::move(name);
    queue->maxSize = maxSize;
    queue->deliver = std::move(deliver);
    queues_.push_back(std::move(queue));
    return true;
}

/// Its slot is not given to another queue: programs may keep it.
void MessageQueues::removeOutside(std::string_view name) {
    for (const auto& queue : queues_)
        if (queue->task == nullptr && rapid::config::sameName(queue->name, name)) queue->exists = false;
}

void MessageQueues::emptyAll() {
    for (const auto& queue : queues_) {
        if (queue->task == nullptr) continue;
        queue->messages.clear();
        for (const auto& [type, number] : queue->orders)
            queue->task->interrupts().forgetQueued(number);
    }
}

MessageQueues::Sent MessageQueues::send(MessageQueue& target, Message message) {
    if (message.size() > target.maxSize) return Sent::TooLarge;
    if (target.deliver) return target.deliver(std::move(message)) ? Sent::Ok : Sent::Full;
    if (target.answerFrom == message.sender && target.answerFrom != 0 && !target.answer &&
        target.answerType == message.typeName()) {
        target.answer = std::make_unique<Message>(std::move(message));
        target.arrived.notifyAll();
        return Sent::Ok;
    }
    const auto order = target.orders.find(message.typeName());
    if (target.mode == QueueMode::Interrupt && order == target.orders.end()) {
        target.task->report(EventId::MessageDiscarded, {target.name, message.typeName()});
        return Sent::Ok;
    }
    if (target.messages.size() >= target.maxMessages) return Sent::Full;
    target.messages.push_back(std::move(message));
    if (order != target.orders.end()) target.task->interrupts().post(order->second);
    target.arrived.notifyAll();
    return Sent::Ok;
}

Handle MessageQueues::keep(Message message) {
    kept_.emplace(++lastKept_, std::move(message));
    if (kept_.size() > kKept) kept_.erase(kept_.begin());
    return lastKept_;
}

const Message* MessageQueues::kept(Handle handle) const {
    const auto found = kept_.find(handle);
    return found == kept_.end() ? nullptr : &found->second;
}

void orderMessages(Task& task, int number, const std::string& type) {
    MessageQueues& queues = MessageQueues::of(task.controller());
    MessageQueue& own = *queues.find(queues.slotOf(task));
    const auto disarm = [&own, type, number] {
        if (const auto order = own.orders.find(type); order != own.orders.end() && order->second == number)
            own.orders.erase(order);
    };
    // Messages wait in the queue while the program is stopped, and so does the interrupt that reports them.
    task.interrupts().order(number, disarm, false, true, {kMessageOrder, type, {}});
    own.orders[type] = number;
}

const TypeDesc& elementType(const TypeDesc& type) {
    return type.kind == DescKind::Array ? *type.fields[0] : type;
}

std::array<int32_t, 3> dimensionsOf(const TypeDesc& type) {
    if (type.kind != DescKind::Array) return {};
    return {type.dims[0], type.dims[1], type.dims[2]};
}

Message makeMessage(const void* data, const TypeDesc& type, Handle sender, float userDefined) {
    const char* bytes = static_cast<const char*>(data);
    return {&elementType(type), dimensionsOf(type), {bytes, bytes + type.size}, sender, userDefined};
}

std::size_t Message::size() const {
    std::size_t length = std::string_view(typeName()).size() + 1;
    for (std::size_t at = 0; at < bytes.size(); at += element->size)
        length += valueToText(bytes.data() + at, *element).size() + 1; // brackets and commas of an array
    return length;
}

} // namespace rt::lib
