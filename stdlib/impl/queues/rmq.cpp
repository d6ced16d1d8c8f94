// Manual 1.10: the instructions of RAPID message queues.

#include "stdlib/impl/interrupts/ordering.h"
#include "stdlib/impl/queues/message_queue.h"
#include "stdlib/impl/support/deadline.h"
#include "stdlib/impl/support/fail.h"

#include "natives/message_queues.h"
#include "stdlib_constants.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>

using namespace rt;
using lib::MessageQueue;
using lib::MessageQueues;
using lib::QueueMode;

namespace {

MessageQueues& queuesOf(TaskCore* task) {
    return MessageQueues::of(taskOf(task).controller());
}

MessageQueue& ownQueue(TaskCore* task) {
    MessageQueues& queues = queuesOf(task);
    return *queues.find(queues.slotOf(taskOf(task)));
}

/// Not recoverable: the instruction does not belong to the way this task reads its queue, or not into a trap.
Status misused(TaskCore* task, std::string_view instruction, std::string_view why) {
    return taskOf(task).fatal(static_cast<int>(EventId::QueueMisused),
                              fmt::format("{} {}", instruction, why));
}

Status checkWaiting(TaskCore* task, std::string_view instruction) {
    if (taskOf(task).interrupts().inTrap())
        return misused(task, instruction, "cannot be used in a trap routine.");
    return kOk;
}

Status timedOut(TaskCore* task) {
    return lib::fail(task, err::ERR_RMQ_TIMEOUT, "no message came in time");
}

/// The queue of a slot; null and ERR_RMQ_INVALID raised.
MessageQueue* receiver(TaskCore* task, Handle slot, Status& status) {
    MessageQueue* queue = queuesOf(task).find(slot);
    if (queue != nullptr) return queue;
    status = lib::fail(task, err::ERR_RMQ_INVALID, "the slot is not connected; use RMQFindSlot first");
    return nullptr;
}

Status send(TaskCore* task, Handle slot, const void* data, const TypeDesc* type, const float* userDefined) {
    Status status = kOk;
    MessageQueue* target = receiver(task, slot, status);
    if (target == nullptr) return status;
    MessageQueues& queues = queuesOf(task);
    const float number = userDefined != nullptr ? *userDefined : 0;
    switch (queues.send(*target, lib::makeMessage(data, *type, queues.slotOf(taskOf(task)), number))) {
    case MessageQueues::Sent::Ok: return kOk;
    case MessageQueues::Sent::TooLarge:
        return lib::fail(task, err::ERR_RMQ_MSGSIZE,
                         fmt::format("the message is longer than the {} bytes that {} takes (RmqMaxMsgSize)",
                                     target->maxSize, target->name));
    case MessageQueues::Sent::Full: break;
    }
    return lib::fail(task, err::ERR_RMQ_FULL,
                     fmt::format("{} holds {} messages already, the maximum (RmqMaxNoOfMsg)", target->name,
                                 target->maxMessages));
}

const lib::Message* messageOf(TaskCore* task, Handle handle, Status& status) {
    const lib::Message* message = queuesOf(task).kept(handle);
    if (message == nullptr)
        status =
            lib::fail(task, err::ERR_RMQ_NOMSG, "the variable holds no message; get one with RMQGetMessage");
    return message;
}

/// The first message of the queue into the variable; there must be one. It leaves the queue also when it is not valid.
Status take(TaskCore* task, MessageQueue& queue, Handle* variable) {
    MessageQueues& queues = queuesOf(task);
    lib::Message message = std::move(queue.messages.front());
    queue.messages.pop_front();
    if (!queues.isValid(message))
        return lib::fail(task, err::ERR_RMQ_INVMSG,
                         "the message comes from a client that does not exist, or exists no more");
    *variable = queues.keep(std::move(message));
    return kOk;
}

} // namespace

extern "C" {

Status rt_RMQFindSlot(TaskCore* task, Handle* Slot, const String* Name) {
    const Handle slot = queuesOf(task).findByName(Name->view());
    if (slot == 0)
        return lib::fail(
            task, err::ERR_RMQ_NAME,
            fmt::format("there is no message queue \"{}\"; a task T_ROB1 has RMQ_T_ROB1", Name->view()));
    *Slot = slot;
    return kOk;
}

Status rt_RMQGetSlotName(TaskCore* task, String* result, Handle* Slot) {
    Status status = kOk;
    if (const MessageQueue* queue = receiver(task, *Slot, status)) result->assign(queue->name);
    return status;
}

Status rt_RMQSendMessage(TaskCore* task, Handle* Slot, void* SendData, const TypeDesc* SendDataType,
                         const float* UserDef) {
    return send(task, *Slot, SendData, SendDataType, UserDef);
}

Status rt_RMQSendWait(TaskCore* task, Handle* Slot, void* SendData, const TypeDesc* SendDataType,
                      const float* UserDef, Handle* Message, void*, const TypeDesc* ReceiveDataTypeType,
                      const float* TimeOut) {
    if (const Status status = checkWaiting(task, "RMQSendWait"); status != kOk) return status;
    MessageQueue& own = ownQueue(task);
    own.answerFrom = *Slot;
    own.answerType = lib::elementType(*ReceiveDataTypeType).baseName;
    own.answer.reset();
    Status status = send(task, *Slot, SendData, SendDataType, UserDef);
    WaitResult result = WaitResult::Done;
    if (status == kOk) {
        const WaitSpec spec{
            {&own.arrived}, [&own] { return own.answer != nullptr; }, lib::deadlineOf(task, TimeOut), 0};
        status = taskOf(task).waitFor(spec, result);
    }
    own.answerFrom = 0;
    const auto answer = std::move(own.answer);
    if (status != kOk) return status;
    if (result == WaitResult::Timeout || !answer) return timedOut(task);
    *Message = queuesOf(task).keep(std::move(*answer));
    return kOk;
}

Status rt_RMQGetMessage(TaskCore* task, Handle* Message) {
    MessageQueue& own = ownQueue(task);
    if (own.mode == QueueMode::Synchronous)
        return misused(task, "RMQGetMessage",
                       "is for tasks in interrupt mode; this one is configured as Synchronous.");
    if (own.messages.empty())
        return lib::fail(task, err::ERR_RMQ_NOMSG, "the message queue of the task is empty");
    return take(task, own, Message);
}

Status rt_RMQReadWait(TaskCore* task, Handle* Message, const float* TimeOut) {
    if (const Status status = checkWaiting(task, "RMQReadWait"); status != kOk) return status;
    MessageQueue& own = ownQueue(task);
    if (own.mode == QueueMode::Interrupt)
        return misused(task, "RMQReadWait",
                       "is for tasks in synchronous mode; this one is configured as Interrupt.");
    WaitResult result = WaitResult::Done;
    const WaitSpec spec{
        {&own.arrived}, [&own] { return !own.messages.empty(); }, lib::deadlineOf(task, TimeOut), 0};
    if (const Status status = taskOf(task).waitFor(spec, result); status != kOk) return status;
    if (result == WaitResult::Timeout) return timedOut(task);
    return take(task, own, Message);
}

Status rt_RMQGetMsgHeader(TaskCore* task, Handle* Message, data::Rmqheader* Header, Handle* SenderId,
                          float* UserDef) {
    Status status = kOk;
    const lib::Message* message = messageOf(task, *Message, status);
    if (message == nullptr) return status;
    if (Header != nullptr) {
        *Header = {};
        Header->datatype.assign(message->typeName());
        float* const sizes[] = {&Header->dim1, &Header->dim2, &Header->dim3};
        for (std::size_t i = 0; i < std::size(sizes) && message->dimensions[i] > 0; ++i) {
            *sizes[i] = static_cast<float>(message->dimensions[i]);
            Header->ndim = static_cast<float>(i + 1);
        }
    }
    if (SenderId != nullptr) *SenderId = message->sender;
    if (UserDef != nullptr) *UserDef = message->userDefined;
    return kOk;
}

Status rt_RMQGetMsgData(TaskCore* task, Handle* Message, void* Data, const TypeDesc* DataType) {
    Status status = kOk;
    const lib::Message* message = messageOf(task, *Message, status);
    if (message == nullptr) return status;
    const TypeDesc& wanted = lib::elementType(*DataType);
    // Two tasks may each declare a record of this name: the layout must be the same, too.
    if (std::string_view(wanted.baseName) != message->typeName() || wanted.size != message->element->size)
        return lib::fail(
            task, err::ERR_RMQ_VALUE,
            fmt::format("the message holds data of type {}, not {}", message->typeName(), wanted.baseName));
    if (lib::dimensionsOf(*DataType) != message->dimensions)
        return lib::fail(task, err::ERR_RMQ_DIM,
                         fmt::format("the {} in the message and the variable have different dimensions",
                                     message->typeName()));
    std::memcpy(Data, message->bytes.data(), message->bytes.size());
    return kOk;
}

Status rt_RMQEmptyQueue(TaskCore* task) {
    ownQueue(task).messages.clear();
    return kOk;
}

Status rt_IRMQMessage(TaskCore* task, void*, const TypeDesc* InterruptDataTypeType, float* Interrupt) {
    InterruptTable& table = taskOf(task).interrupts();
    const int number = lib::numberOf(Interrupt);
    if (!table.isDefined(number)) return lib::unknownInterrupt(task);
    if (ownQueue(task).mode == QueueMode::Synchronous)
        return misused(task, "IRMQMessage",
                       "is for tasks in interrupt mode; this one is configured as Synchronous.");
    const std::string_view type = lib::elementType(*InterruptDataTypeType).baseName;
    lib::orderMessages(taskOf(task), number, std::string(type));
    // Messages that came before the order wait in the queue of a task without mode (decision 20).
    for (const lib::Message& message : ownQueue(task).messages)
        if (message.typeName() == type) table.post(number);
    return kOk;
}
}
