#pragma once
// The parts of Subscriptions, for its own files.

#include "tools/rws/subscriptions.h"

#include <deque>

namespace rapidc::rws {

/// From the end of a group to the close of its socket: a client that deletes a group to close the socket gets the reply first.
constexpr std::chrono::milliseconds kUntilClosed{150};

/// A resource that a client requested to subscribe to, as it wrote it.
struct Subscriptions::Requested {
    std::string text;
    int priority = 1;
};

/// The way of the events of a group to its socket. On the network thread, except for its constants.
struct Subscriptions::Outlet {
    uint64_t id = 0, session = 0;
    Dialect dialect = Dialect::V1;
    std::shared_ptr<http::WebSocket> socket;
    uint64_t opening = 0; ///< counts openings, so that the end of an earlier socket does no harm
    bool isTaken = false; ///< RWS 2.0: a socket was admitted; there is no second one
    bool hasEnded = false;
    /// Events while there is no socket, in order; from some number on only the last one of each topic.
    struct Waiting {
        uint64_t topic;
        std::shared_ptr<const std::string> text;
    };
    std::deque<Waiting> waiting;

    void deliver(uint64_t topic, const std::shared_ptr<const std::string>& text);
    void opened(std::shared_ptr<http::WebSocket> opened);
    /// Nothing is delivered from now on.
    void stop();
    void close();
};

/// One subscribed text in one dialect, for all clients that subscribed to it.
struct Subscriptions::Topic {
    explicit Topic(uint64_t topicNumber);
    const uint64_t number; ///< never used twice
    Dialect dialect = Dialect::V1;
    std::string text;
    std::unique_ptr<Watch> watch; ///< controller's thread
    // With the lock:
    Outlets outlets[3]; ///< by priority; never null
    bool isDirty[2] = {false, false};
    Entry latest;
    std::deque<Entry> messages[2]; ///< those that are not merged
};

struct Subscriptions::Group {
    uint64_t id = 0, session = 0;
    std::shared_ptr<Outlet> outlet;
    struct Resource {
        std::shared_ptr<Topic> topic;
        int priority = 1;
    };
    std::map<std::string, Resource> resources; ///< by subscribed text
};

} // namespace rapidc::rws
