#pragma once
// RAPID message queues (manual 1.10): a queue for each task, messages that carry a value of any type, interrupts on
// reception. Decisions where the manual is silent: README.md.

#include "runtime/host/controller.h"
#include "runtime/sched/wait_queue.h"

#include <array>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace rt {
struct StateKeepers;
}

namespace rt::lib {

/// Which way a task reads its queue (parameter RmqMode). Open: not configured, either way.
enum class QueueMode : uint8_t { Open, Interrupt, Synchronous };

/// Sender of a message that names a client which does not exist.
inline constexpr Handle kNoSuchClient = -1;

struct Message {
    const TypeDesc* element = nullptr;      ///< of the value, or of the elements of an array
    std::array<int32_t, 3> dimensions = {}; ///< all 0: no array
    std::vector<char> bytes;
    Handle sender = 0; ///< queue identity
    float userDefined = 0;

    const char* typeName() const { return element->baseName; }
    /// Length of "type;value" as text, which is how messages travel.
    std::size_t size() const;
};

struct MessageQueue {
    std::string name;     ///< "RMQ_T_ROB1"
    Task* task = nullptr; ///< null: of a client outside the controller
    QueueMode mode = QueueMode::Open;
    bool exists = true; ///< false: RmqType None
    std::size_t maxMessages = 5, maxSize = 400;
    std::deque<Message> messages;
    WaitQueue arrived;
    std::map<std::string, int> orders; ///< interrupt numbers by type name (IRMQMessage)
    /// RMQSendWait in progress: what it waits for, and the answer when it has come.
    Handle answerFrom = 0;
    std::string answerType;
    std::unique_ptr<Message> answer;
    /// Of a client outside: takes its messages.
    std::function<bool(Message)> deliver;
};

/// The queues of a controller, and the messages that variables of its programs hold.
class MessageQueues {
  public:
    /// The service of this controller, with a queue for each of its tasks.
    static MessageQueues& of(Controller& controller);

    /// Queue identity of a task; queues count from 1.
    Handle slotOf(const Task& task) const;
    /// Null for 0 and for a value that is not an identity.
    MessageQueue* find(Handle slot);
    /// The sender is none, or a client that exists; otherwise reading the message raises ERR_RMQ_INVMSG.
    bool isValid(const Message& message) { return message.sender == 0 || find(message.sender) != nullptr; }
    /// Without regard to case; 0 when there is no such queue.
    Handle findByName(std::string_view name) const;

    /// The tasks find a queue of a client outside by this name; `deliver` is false when it is full. False: the name is taken.
    bool addOutside(std::string name, std::size_t maxSize, std::function<bool(Message)> deliver);
    void removeOutside(std::string_view name);
    /// The queues of tasks lose their messages, and the interrupts that report them: the controller restarts.
    void emptyAll();
    const std::vector<std::unique_ptr<MessageQueue>>& all() const { return queues_; }

    enum class Sent : uint8_t { Ok, TooLarge, Full };
    /// Delivers to the waiting RMQSendWait, to the queue (posting the interrupt ordered for the type), or, when a task
    /// in interrupt mode has not ordered one, to no task: an event reports it.
    Sent send(MessageQueue& target, Message message);

    /// Keeps a message for a variable of type rmqmessage; the newest kKept of a controller.
    Handle keep(Message message);
    /// Null when the variable holds none.
    const Message* kept(Handle handle) const;

  private:
    static constexpr std::size_t kKept = 1000;
    void makeQueues(Controller& controller);

    std::vector<std::unique_ptr<MessageQueue>> queues_;
    std::map<Handle, Message> kept_;
    Handle lastKept_ = 0;
};

/// IRMQMessage: messages of this type raise the interrupt of the task from now on.
void orderMessages(Task& task, int number, const std::string& type);
/// Messages in queues, messages and queues that variables hold, between two processes (--state).
void keepMessages(Controller& controller, StateKeepers& kept);

/// The type of the elements of an array, the type itself otherwise.
const TypeDesc& elementType(const TypeDesc& type);
std::array<int32_t, 3> dimensionsOf(const TypeDesc& type);
Message makeMessage(const void* data, const TypeDesc& type, Handle sender, float userDefined);

} // namespace rt::lib
