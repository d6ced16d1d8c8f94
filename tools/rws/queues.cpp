#include "tools/rws/queues.h"
#include "tools/rws/request_values.h"

#include "config/letter_case.h"
#include "runtime/value/value_text.h"
#include "tools/rws/rapid_support.h"
#include "tools/service/data_path.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>

namespace rapidc::rws {

namespace {

using rapid::config::lowerCase;
using rapid::config::sameName;

constexpr std::size_t kMostQueues = 100, kMostQueuedMessages = 1000;
constexpr std::size_t kLargestMessage = 65536; // bytes
constexpr std::size_t kLongestName = 80;
constexpr double kLongestWait = 10; // s; a worker waits meanwhile

/// The value of a message as RAPID text.
std::string valueText(const rt::lib::Message& message) {
    service::FoundData found;
    found.data = const_cast<char*>(message.bytes.data());
    found.type = message.element;
    for (const int32_t dim : message.dimensions)
        if (dim > 0) found.dims.push_back(dim);
    return valueOf(found).value_or("");
}

/// The fields of the form are numbers, those of replies words.
std::string typeText(const std::string& number) {
    return number == "0" ? "IPC_SEND" : "IPC_PACKAGE";
}

} // namespace

/// A subscription to the messages of a queue.
class Queues::Listening final : public Watch {
  public:
    Listening(std::shared_ptr<Queue> queue, uint64_t number) : queue_(std::move(queue)), number_(number) {}
    ~Listening() override { queue_->listeners.erase(number_); }
    Listening(const Listening&) = delete;
    Listening& operator=(const Listening&) = delete;

  private:
    std::shared_ptr<Queue> queue_;
    uint64_t number_;
};

Queues::Queues(service::VirtualController& controller) : controller_(controller) {
    service::Observer observer;
    observer.changed = [this](service::Change change, const rt::Task*) {
        if (change != service::Change::Restart && change != service::Change::Generation) return;
        const std::lock_guard lock(mutex_);
        if (change == service::Change::Restart) queues_.clear(); // as on a controller that begins again
        for (const auto& [name, queue] : queues_)
            registerQueue(*queue);
    };
    observer_ = controller_.observers().add(std::move(observer));
}

Queues::~Queues() {
    controller_.observers().remove(observer_);
}

void Queues::addTo(Router& router, Subscribables& subscribables) {
    const std::string all = "/rw/dipc", one = "/rw/dipc/{queue}";
    router.getBoth(all, [this](const Request& request) { return list(request); });
    const Handler create = [this](const Request& request) { return this->create(request); };
    const Handler send = [this](const Request& request) { return this->send(request); };
    for (const char* action : {"create", "dipc-create"})
        router.action(all, action, create);
    for (const char* action : {"send", "dipc-send"})
        router.action(one, action, send);
    router.post(Dialect::V2, all, create);
    router.post(Dialect::V2, one, send);
    router.post(Dialect::V2, one + "/send", send);
    const Handler information = [this](const Request& request) { return this->information(request); };
    router.get(Dialect::V1, one, information);
    router.get(Dialect::V2, one + "/information", information);
    const Handler read = [this](const Request& request) { return this->read(request); };
    for (const char* action : {"read", "dipc-read"})
        router.add(Dialect::V1, {Method::Get, one, action, read, Where::Disk});
    router.add(Dialect::V2, {Method::Get, one, {}, read, Where::Disk});
    router.addBoth({Method::Delete, one, {}, [this](const Request& request) { return remove(request); }});
    for (const bool withMessage : {true, false})
        subscribables.add(
            {one, withMessage ? "" : "nomessage", false, std::nullopt,
             [this, withMessage](const Request& request, const Changed& changed, Subscription& out) {
                 return subscribe(request, changed, withMessage, out);
             }});
}

std::shared_ptr<Queues::Queue> Queues::find(const std::string& name) {
    const std::lock_guard lock(mutex_);
    const auto found = queues_.find(lowerCase(name));
    return found == queues_.end() ? nullptr : found->second;
}

void Queues::registerQueue(Queue& queue) {
    const std::string name = queue.name;
    (void)rapidQueues().addOutside(name, queue.mostBytes, [this, name](const rt::lib::Message& message) {
        return deliver(name, message);
    });
    queue.slot = slotOf(name);
}

bool Queues::deliver(const std::string& name, const rt::lib::Message& message) {
    const rt::lib::MessageQueue* sender = rapidQueues().find(message.sender);
    return put(name, {fmt::format("{};{}", message.typeName(), valueText(message)),
                      rt::formatNum(message.userDefined), "1", "111", sender != nullptr ? sender->name : "",
                      std::to_string(message.sender)});
}

bool Queues::put(const std::string& name, Message message) {
    const std::shared_ptr<Queue> queue = find(name);
    if (!queue) return false;
    {
        const std::lock_guard lock(mutex_);
        if (queue->messages.size() >= queue->mostMessages) {
            if (queue->listeners.empty()) return false;
            queue->messages.pop_front(); // those who listen have got it
        }
        queue->messages.push_back(message);
    }
    arrived_.notify_all();
    for (const auto& [number, listener] : queue->listeners)
        listener(message);
    return true;
}

Reply Queues::list(const Request& request) {
    Document document;
    if (request.dialect == Dialect::V1)
        document.add("dipc-info-li", "info").value("max-body-size", "444").value("max-pkg-size", "5000");
    const auto add = [&](const std::string& name, std::size_t messages, std::size_t bytes) {
        Entry& entry = document.add("dipc-queue-li", name);
        entry.self = "dipc/" + name;
        entry.value("queue-name", name)
            .value("queue-size", std::to_string(messages))
            .value("queue-max-msg-size", std::to_string(bytes));
    };
    for (const auto& queue : rapidQueues().all())
        if (queue->task != nullptr && queue->exists) add(queue->name, queue->maxMessages, queue->maxSize);
    const std::lock_guard lock(mutex_);
    for (const auto& [name, queue] : queues_)
        add(queue->name, queue->mostMessages, queue->mostBytes);
    return Reply::of(std::move(document));
}

Reply Queues::create(const Request& request) {
    const auto number = [&](std::initializer_list<const char*> names, int64_t otherwise, int64_t most) {
        for (const char* name : names)
            if (request.form.has(name)) return wholeIn(request.form.text(name), 1, most);
        return std::optional(otherwise);
    };
    auto queue = std::make_shared<Queue>();
    queue->name = request.form.text("dipc-queue-name");
    queue->user = request.session->user;
    const bool isName = !queue->name.empty() && queue->name.size() <= kLongestName &&
                        queue->name.find_first_of("/\\\"<> ") == std::string::npos;
    if (!isName) return badParameter("dipc-queue-name", "a name of at most 80 characters");
    // the size of a queue is given in messages or in bytes
    const auto bytes = number({"dipc-max-msg-size", "dipc-max-size"}, 444, kLargestMessage);
    const auto size = number({"dipc-max-number-of-messages", "dipc-queue-size"}, 10, INT32_MAX);
    if (!bytes) return badParameter("dipc-max-msg-size", fmt::format("1 to {} bytes", kLargestMessage));
    if (!size) return badParameter("dipc-queue-size", "a positive number");
    const int64_t messages = *size >= *bytes && *size > 100 ? *size / *bytes : *size;
    queue->mostBytes = static_cast<std::size_t>(*bytes);
    queue->mostMessages = std::clamp<std::size_t>(static_cast<std::size_t>(messages), 1, kMostQueuedMessages);
    if (find(queue->name) || rapidQueues().findByName(queue->name) != 0)
        return badParameter("dipc-queue-name", "a name that no queue has yet");
    {
        const std::lock_guard lock(mutex_);
        if (queues_.size() >= kMostQueues)
            return Reply::refuse(ReturnCode::TooLarge, "There are too many queues");
    }
    registerQueue(*queue);
    const std::lock_guard lock(mutex_);
    queues_[lowerCase(queue->name)] = queue;
    return Reply::done(201);
}

Reply Queues::send(const Request& request) {
    const std::string& name = request.parameter("queue");
    const std::string from = request.form.text("dipc-src-queue-name");
    const std::string type = request.form.text("dipc-msgtype"), command = request.form.text("dipc-cmd");
    if (!request.form.has("dipc-data")) return badParameter("dipc-data", "the message");
    if (!type.empty() && !wholeIn(type, 0, 1000)) return badParameter("dipc-msgtype", "a number");
    if (!command.empty() && !wholeIn(command, 0, INT32_MAX)) return badParameter("dipc-cmd", "a number");
    const std::shared_ptr<Queue> queue = find(name);
    if (!queue) {
        rt::lib::MessageQueues& all = rapidQueues();
        rt::Handle slot = all.findByName(name);
        if (slot == 0) slot = all.findByName("RMQ_" + name);
        if (slot == 0) return Reply::refuse(ReturnCode::NotFound, "There is no queue " + name);
        return sendToTask(request, *all.find(slot));
    }
    Message message{
        request.form.text("dipc-data"), request.form.text("dipc-userdef"), type, command, from, slotOf(from)};
    if (message.data.size() > queue->mostBytes)
        return Reply::refuse(ReturnCode::TooLarge, "The message is too long");
    if (!put(name, std::move(message))) return Reply::refuse(ReturnCode::Rejected, "The queue is full");
    return Reply::done();
}

/// "TYPE;VALUE", as tasks send it.
Reply Queues::sendToTask(const Request& request, rt::lib::MessageQueue& queue) {
    const std::string data = request.form.text("dipc-data");
    const std::size_t semicolon = data.find(';');
    const rt::TypeDesc* type =
        semicolon == std::string::npos ? nullptr : service::typeNamed(controller_, data.substr(0, semicolon));
    if (type == nullptr) return badParameter("dipc-data", "TYPE;VALUE, such as num;5 or string;\"text\"");
    std::vector<char> bytes(type->size);
    if (!rt::sourceToValue(std::string_view(data).substr(semicolon + 1), bytes.data(), *type))
        return badParameter("dipc-data", std::string("a value of type ") + type->name);
    double userDefined = 0;
    const std::string text = request.form.text("dipc-userdef");
    if (!text.empty() && !rt::parseRapidNumber(text, userDefined))
        return badParameter("dipc-userdef", "a number");
    rt::lib::MessageQueues& all = rapidQueues();
    const std::string from = request.form.text("dipc-src-queue-name");
    rt::Handle sender = from.empty() ? 0 : all.findByName(from);
    if (sender == 0 && !from.empty()) sender = rt::lib::kNoSuchClient;
    using Sent = rt::lib::MessageQueues::Sent;
    switch (
        all.send(queue, rt::lib::makeMessage(bytes.data(), *type, sender, static_cast<float>(userDefined)))) {
    case Sent::Ok: return Reply::done();
    case Sent::TooLarge:
        return Reply::refuse(ReturnCode::TooLarge, "The message is too long for " + queue.name);
    case Sent::Full: break;
    }
    return Reply::refuse(ReturnCode::Rejected, queue.name + " is full");
}

Reply Queues::information(const Request& request) {
    const std::string& name = request.parameter("queue");
    Document document;
    const rt::Handle slot = rapidQueues().findByName(name);
    const rt::lib::MessageQueue* rapid = rapidQueues().find(slot);
    const std::shared_ptr<Queue> queue = find(name);
    if (!queue && rapid == nullptr) return Reply::refuse(ReturnCode::NotFound, "There is no queue " + name);
    document.add("dipc-queue", queue ? queue->name : rapid->name)
        .value("queue-name", queue ? queue->name : rapid->name)
        .value("queue-size", std::to_string(queue ? queue->mostMessages : rapid->maxMessages))
        .value("queue-max-msg-size", std::to_string(queue ? queue->mostBytes : rapid->maxSize))
        .value("queue-slot-id", std::to_string(slot));
    return Reply::of(std::move(document));
}

/// A name that no queue has is slot 0, as of a message without sender.
std::string Queues::slotOf(const std::string& name) {
    return std::to_string(rapidQueues().findByName(name));
}

/// Waits for milliseconds at most.
Reply Queues::read(const Request& request) {
    const std::shared_ptr<Queue> queue = find(request.parameter("queue"));
    if (!queue)
        return Reply::refuse(ReturnCode::NotFound,
                             "There is no queue of a client named " + request.parameter("queue"));
    double wait = 0;
    const std::string text = fieldOf(request, request.dialect == Dialect::V1 ? "timeout" : "dipc-timeout");
    if (!text.empty() && (!rt::parseRapidNumber(text, wait) || !(wait >= 0) || !std::isfinite(wait)))
        return badParameter("timeout", "a positive number of milliseconds");
    const std::chrono::duration<double> span(std::min(wait / 1000, kLongestWait));
    std::unique_lock lock(mutex_);
    arrived_.wait_for(lock, span, [&] { return !queue->messages.empty(); });
    Document document;
    if (queue->messages.empty()) return Reply::of(std::move(document));
    const Message message = std::move(queue->messages.front());
    queue->messages.pop_front();
    document.add(request.dialect == Dialect::V1 ? "dipc-read-li" : "dipc-read", queue->name)
        .value("dipc-data", message.data)
        .value("dipc-userdef", message.userdef)
        .value("dipc-msgtype", typeText(message.type))
        .value("dipc-cmd", message.command)
        .value("queue-name", message.from)
        .value("queue-size", std::to_string(queue->mostMessages))
        .value("queue-sid", queue->slot)
        .value("queue-did", message.slot);
    return Reply::of(std::move(document));
}

Reply Queues::remove(const Request& request) {
    const std::string& name = request.parameter("queue");
    const std::shared_ptr<Queue> queue = find(name);
    if (!queue) {
        const bool isTasks = rapidQueues().findByName(name) != 0;
        return isTasks ? Reply::refuse(ReturnCode::Rejected, "The queue of a task cannot be removed")
                       : Reply::refuse(ReturnCode::NotFound, "There is no queue " + name);
    }
    if (queue->user != request.session->user)
        return Reply::refuse(ReturnCode::NoGrant, "Another user has created the queue");
    rapidQueues().removeOutside(name);
    const std::lock_guard lock(mutex_);
    queues_.erase(lowerCase(name));
    return Reply::done();
}

std::optional<Failure> Queues::subscribe(const Request& request, const Changed& changed, bool withMessage,
                                         Subscription& out) {
    const std::shared_ptr<Queue> queue = find(request.parameter("queue"));
    if (!queue) return Failure{ReturnCode::NotFound, "There is no such queue of a client"};
    const uint64_t number = ++lastListener_;
    queue->listeners[number] = [changed, withMessage, slot = queue->slot](const Message& message) {
        Entry entry;
        entry.type = "dipc-msg-ev";
        entry.title = "msg";
        entry.value("dipc-slotid", slot);
        if (withMessage)
            entry.value("dipc-data", message.data)
                .value("dipc-userdef", message.userdef)
                .value("dipc-msgtype", typeText(message.type))
                .value("dipc-cmd", message.command)
                .value("queue-name", message.from);
        changed(std::move(entry));
    };
    out.watch = std::make_unique<Listening>(queue, number);
    return std::nullopt;
}

} // namespace rapidc::rws
