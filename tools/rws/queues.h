#pragma once
// /rw/dipc: message queues of clients, and those of RAPID tasks (RMQ_T_ROB1). A message of a task to a queue of a client is text: "num;5".

#include "stdlib/impl/queues/message_queue.h"
#include "tools/rws/router.h"
#include "tools/rws/subscribable.h"
#include "tools/service/virtual_controller.h"

#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace rapidc::rws {

class Queues {
  public:
    explicit Queues(service::VirtualController& controller);
    ~Queues();
    Queues(const Queues&) = delete;
    Queues& operator=(const Queues&) = delete;

    void addTo(Router& router, Subscribables& subscribables);

  private:
    struct Message {
        std::string data, userdef, type, command, from;
        std::string slot; ///< of the sender
    };
    struct Queue {
        std::string name, user; ///< who made it
        std::string slot;       ///< its identity for tasks (rmqslot)
        std::size_t mostMessages = 0, mostBytes = 0;
        std::deque<Message> messages;
        std::map<uint64_t, std::function<void(const Message&)>>
            listeners; ///< used on the controller's thread only
    };
    class Listening;

    Reply list(const Request& request);
    Reply create(const Request& request);
    Reply send(const Request& request);
    Reply sendToTask(const Request& request, rt::lib::MessageQueue& queue);
    Reply information(const Request& request);
    /// On a worker: may wait for a message.
    Reply read(const Request& request);
    Reply remove(const Request& request);
    std::optional<Failure> subscribe(const Request& request, const Changed& changed, bool withMessage,
                                     Subscription& out);
    /// False: it is full.
    bool put(const std::string& name, Message message);
    std::shared_ptr<Queue> find(const std::string& name);
    /// The queues of clients become known to the tasks.
    void registerQueue(Queue& queue);
    std::string slotOf(const std::string& name);
    bool deliver(const std::string& name, const rt::lib::Message& message);
    rt::lib::MessageQueues& rapidQueues() { return rt::lib::MessageQueues::of(controller_.core()); }

    service::VirtualController& controller_;
    service::Observers::Token observer_ = 0;
    std::mutex mutex_; ///< of all below, except listeners
    std::condition_variable arrived_;
    std::map<std::string, std::shared_ptr<Queue>> queues_; ///< by name in lower case
    uint64_t lastListener_ = 0;
};

} // namespace rapidc::rws
