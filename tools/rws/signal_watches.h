#pragma once
// SignalWatches: the signals that clients listen to. One observer of the controller serves all of them, so that a change costs the
// listeners of that signal alone.

#include "tools/rws/subscribable.h"
#include "tools/service/virtual_controller.h"

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

namespace rapidc::rws {

class SignalWatches {
  public:
    explicit SignalWatches(service::VirtualController& controller);
    ~SignalWatches();
    SignalWatches(const SignalWatches&) = delete;
    SignalWatches& operator=(const SignalWatches&) = delete;

    /// Calls `changed` after each change of the signal's value or state until the watch ends. The watch may outlive this object.
    std::unique_ptr<Watch> watch(rt::SignalId signal, Changed changed);

    /// The li of events and initial values.
    static Entry entryOf(const rt::IoSystem& io, rt::SignalId signal);

  private:
    struct Listener {
        std::string name; ///< of the signal: numbers change with the generation of the controller
        Changed changed;
    };
    struct Table {
        std::map<uint64_t, Listener> listeners;
        std::unordered_map<rt::SignalId, std::vector<uint64_t>> bySignal;
        uint64_t last = 0;
        void remove(uint64_t number);
    };
    class OneWatch;

    void tell(rt::SignalId signal);
    /// The signals of the new generation have other numbers and values.
    void beginGeneration();

    service::VirtualController& controller_;
    std::shared_ptr<Table> table_ = std::make_shared<Table>();
    service::Observers::Token token_;
};

} // namespace rapidc::rws
