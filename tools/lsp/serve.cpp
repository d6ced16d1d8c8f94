#include "tools/lsp/serve.h"

#include "config/json_text.h"
#include "tools/lsp/server.h"
#include "tools/protocol/framing.h"

#include <atomic>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <poll.h>
#include <thread>
#include <unistd.h>

namespace lsp {

namespace {

using Clock = std::chrono::steady_clock;

/// A message that was read; no value: it is not JSON.
using Message = std::optional<Json>;

bool isMessage(const Message& message, const char* method) {
    return message && message->is_object() && message->value("method", Json()) == method;
}

/// Messages on their way from the reader to the worker, and for each request that has no answer yet whether it was
/// cancelled. An edit overtakes requests before it that wait for an answer longer than kPatience, also those that do so only later:
/// the client will ask again, and diagnostics of the new text need not wait for them.
class Inbox {
  public:
    void put(Message message) {
        const std::lock_guard lock(mutex_);
        if (isRequest(message))
            open_.try_emplace(message->at("id").dump());
        else if (isMessage(message, "textDocument/didChange"))
            lastEdit_ = Clock::now();
        messages_.push_back(std::move(message));
        arrived_.notify_one();
    }
    void close() {
        const std::lock_guard lock(mutex_);
        closed_ = true;
        arrived_.notify_one();
    }
    /// Cancels what an edit has overtaken. True: some requests may be due for that after kPatience.
    bool overtake() {
        const std::lock_guard lock(mutex_);
        const Clock::time_point latest = Clock::now() - kPatience;
        bool more = false;
        for (auto& [id, request] : open_) {
            if (request.since > lastEdit_ || request.cancel.requested()) continue;
            if (request.since < latest)
                request.cancel.request(rapid::query::CancelReason::Overtaken);
            else
                more = true;
        }
        return more;
    }
    void cancel(const Json& id) {
        const std::lock_guard lock(mutex_);
        if (const auto request = open_.find(id.dump()); request != open_.end())
            request->second.cancel.request();
    }
    /// Good until done(); null when there is no such request.
    const rapid::query::Cancel* cancelOf(const Json& id) {
        const std::lock_guard lock(mutex_);
        const auto request = open_.find(id.dump());
        return request == open_.end() ? nullptr : &request->second.cancel;
    }
    /// The worker has answered it.
    void done(const Message& message) {
        const std::lock_guard lock(mutex_);
        if (isRequest(message)) open_.erase(message->at("id").dump());
    }
    bool hasMessages() {
        const std::lock_guard lock(mutex_);
        return !messages_.empty() || closed_;
    }
    /// Waits for the next message until `deadline`. False: there is none; `ended` when there will be none any more.
    bool take(Message& message, Clock::time_point deadline, bool& ended) {
        std::unique_lock lock(mutex_);
        arrived_.wait_until(lock, deadline, [&] { return !messages_.empty() || closed_; });
        ended = messages_.empty() && closed_;
        if (messages_.empty()) return false;
        message = std::move(messages_.front());
        messages_.pop_front();
        return true;
    }

    static constexpr std::chrono::milliseconds kPatience{100};

  private:
    struct OpenRequest {
        rapid::query::Cancel cancel;
        Clock::time_point since = Clock::now();
    };

    static bool isRequest(const Message& message) {
        return message && message->is_object() && message->contains("method") && message->contains("id");
    }

    std::mutex mutex_;
    std::condition_variable arrived_;
    std::deque<Message> messages_;
    std::map<std::string, OpenRequest> open_; ///< by id
    Clock::time_point lastEdit_ = Clock::time_point::min();
    bool closed_ = false;
};

Message parse(const std::string& body) {
    Json json = rapid::config::tryParseJson(body);
    if (json.is_discarded()) json = rapid::config::tryParseJson(withoutSingleSurrogates(body));
    if (json.is_discarded()) return {};
    return json;
}

bool isGone(int64_t process) {
    return process > 1 && kill(static_cast<pid_t>(process), 0) != 0 && errno == ESRCH;
}

/// Reads standard input to its end. `client`: the process to watch, once it is known.
class Reader {
  public:
    Reader(Inbox& inbox, const std::atomic<int64_t>& client) : inbox_(inbox), client_(client) {}

    void run() {
        constexpr int kWatchMilliseconds = 2000;
        std::string buffer(size_t{1} << 16, '\0');
        while (!broken_) {
            pollfd input{STDIN_FILENO, POLLIN, 0};
            const bool looksSoon = inbox_.overtake();
            const int ready =
                poll(&input, 1, looksSoon ? static_cast<int>(Inbox::kPatience.count()) : kWatchMilliseconds);
            if (ready < 0 && errno != EINTR) break;
            if (ready <= 0) {
                if (isGone(client_)) break;
                continue;
            }
            const ssize_t count = read(STDIN_FILENO, buffer.data(), buffer.size());
            if (count < 0 && (errno == EINTR || errno == EAGAIN)) continue;
            if (count <= 0) break;
            frames_.add(std::string_view(buffer).substr(0, static_cast<size_t>(count)));
            takeMessages();
        }
        inbox_.close();
    }

  private:
    void takeMessages() {
        using Result = protocol::FrameReader::Result;
        std::string body;
        Result result = frames_.next(body);
        for (; result == Result::Message; result = frames_.next(body))
            take(parse(body));
        broken_ = result == Result::Broken;
    }

    void take(Message message) {
        if (isMessage(message, "$/cancelRequest"))
            if (const Json* id = at(*message, "params.id")) return inbox_.cancel(*id);
        inbox_.put(std::move(message));
    }

    Inbox& inbox_;
    const std::atomic<int64_t>& client_;
    protocol::FrameReader frames_{protocol::FrameReader::Stray::Skipped};
    bool broken_ = false;
};

/// Writes frames until the client has closed its end.
class Writer {
  public:
    void send(const Json& message) {
        const std::string bytes = protocol::frame(rapid::config::textOf(message));
        for (size_t sent = 0; sent < bytes.size() && !broken_;) {
            const ssize_t count = ::write(STDOUT_FILENO, bytes.data() + sent, bytes.size() - sent);
            if (count > 0)
                sent += static_cast<size_t>(count);
            else if (count < 0 && errno == EAGAIN)
                waitForRoom();
            else
                broken_ = count == 0 || errno != EINTR;
        }
    }
    bool isBroken() const { return broken_; }

  private:
    static void waitForRoom() {
        pollfd output{STDOUT_FILENO, POLLOUT, 0};
        poll(&output, 1, -1);
    }
    bool broken_ = false;
};

/// Messages in their order; when none is waiting, or when one has been waited for long enough, diagnostics. What takes long
/// waits for a pause. An answer while typing leaves a moment for the next letter, and a longer one where others see the change in a large program.
void work(Server& server, Inbox& inbox, const Writer& writer, std::atomic<int64_t>& client) {
    using std::chrono::milliseconds;
    constexpr milliseconds kLongest(400), kLongestInLarge(10000), kPause(300), kIdle(100), kMoment(15);
    Clock::time_point upToDate = Clock::now(), lastMessage = upToDate;
    const auto waiting = [&inbox] { return inbox.hasMessages(); };
    bool ended = false;
    while (!ended && !server.hasEnded() && !writer.isBroken()) {
        const bool isLarge = server.isTypingInLarge();
        const milliseconds moment = isLarge ? kPause : kMoment;
        const bool isTyping = server.isTyping() && Clock::now() - lastMessage < moment;
        const bool isFree = !waiting() && !isTyping;
        if (server.isBehind() &&
            (isFree || Clock::now() - upToDate > (isLarge ? kLongestInLarge : kLongest))) {
            const bool quiet = Clock::now() - lastMessage >= kPause;
            server.catchUp(quiet, waiting() ? std::function<bool()>() : waiting);
            upToDate = Clock::now();
        }
        Message message;
        const auto deadline = isTyping            ? lastMessage + moment
                              : server.isBehind() ? lastMessage + kPause
                                                  : Clock::now() + kIdle;
        if (!inbox.take(message, deadline, ended)) continue;
        if (!server.isBehind()) upToDate = Clock::now();
        lastMessage = Clock::now();
        if (message)
            server.receive(*message);
        else
            server.receiveGarbage();
        inbox.done(message);
        client = server.clientProcess();
    }
}

} // namespace

int serve(const rapid::workspace::Environment& environment, const std::vector<std::string>& warnings) {
    std::signal(SIGPIPE, SIG_IGN);
    // The reader may sit in read() when this ends; what it needs lives to the end of the process.
    static auto& inbox = *new Inbox;
    static auto& client = *new std::atomic<int64_t>(0);
    static auto& reader = *new Reader(inbox, client);
    Writer writer;
    Server server(environment, [&writer](const Json& message) { writer.send(message); });
    server.setCancel([](const Json& id) { return inbox.cancelOf(id); });
    server.setWarnings(warnings);
    std::thread([] { reader.run(); }).detach();
    work(server, inbox, writer, client);
    return server.exitStatus();
}

} // namespace lsp
