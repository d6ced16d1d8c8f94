#pragma once
// Subscribables: what clients can subscribe to. Parts of the controller add them; subscriptions.h groups them for clients. Used on the
// controller's thread only.

#include "tools/rws/message.h"
#include "tools/rws/path_pattern.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rapidc::rws {

/// One resource to which a client listens; destroying it ends the listening.
class Watch {
  public:
    virtual ~Watch() = default;
};

/// A watch calls it when the resource has changed, with the entry that an event carries (class, values), complete.
using Changed = std::function<void(Entry)>;

struct Subscription {
    std::vector<Entry> initial; ///< the same entries that events have; may be empty (event log)
    std::unique_ptr<Watch> watch;
};

struct Subscribable {
    std::string pattern;              ///< as of a Route: "/rw/iosystem/signals/{name*}"
    std::string resource;             ///< after the semicolon: "state"; "" = none is needed
    bool highPriority = false;        ///< priority 2 is allowed
    std::optional<Dialect> only = {}; ///< none: both
    /// Begins to listen. A Failure when there is no such thing (the request's path parameters say which).
    std::function<std::optional<Failure>(const Request& request, const Changed& changed, Subscription& out)>
        open = {};
};

class Subscribables {
  public:
    void add(Subscribable subscribable);
    const std::vector<Subscribable>& all() const { return all_; }
    /// The one that "/path;resource" names (decoded), with request.path, segments and parameters filled; null when there is none.
    /// A subscribable without resource also answers to "/a/NAME;NAME".
    const Subscribable* find(std::string_view text, Request& request) const;

  private:
    std::vector<Subscribable> all_;
    std::vector<PathPattern> patterns_; ///< of each
};

} // namespace rapidc::rws
