#pragma once
// The common part of a debugging session.

#include "tools/rapidc/dap/evaluator.h"
#include "tools/rapidc/dap/messages.h"
#include "tools/rapidc/dap/program.h"

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace rapidc::dap {

/// A routine in progress in the call stack of a task.
struct FramePlace {
    rt::Task* task = nullptr;
    rt::DebugFrame frame;
    std::size_t index = 0; ///< innermost 0
    std::size_t count = 0; ///< of all in the stack
};

struct Context {
    Client& client;
    rt::Inbox& inbox;
    ClientFacts facts;
    std::unique_ptr<Program> program;     ///< null: nothing has been launched, or it has ended
    std::unique_ptr<Evaluator> evaluator; ///< null without debugging
    bool running = false;                 ///< the scheduler works
    rt::Task* stopped = nullptr;          ///< the task whose stop the client knows of
    /// The expression of a child of a variablesReference; throws a Refusal.
    std::function<std::string(int64_t reference, const std::string& name)> expressionOf = {};
    /// The routine in progress that a frameId means, and its place in the call stack, innermost 0; throws a Refusal.
    std::function<FramePlace(int64_t frame)> frameOf = {};
    bool hasEnded = false; ///< a program has been launched before

    /// All of these throw a Refusal when the session is in another state.
    void requireProgram() const;
    rt::Controller& controller() const;
    rt::Debugger& debugger() const;
    /// The task with that number; a thread of the protocol.
    rt::Task& task(int64_t thread) const;
    static int64_t threadOf(const rt::Task& task) { return static_cast<int64_t>(task.index()) + 1; }
    void requireStop() const;

    /// Sources as the protocol describes them; null for a place without a file.
    Json source(const std::string& file) const;
    /// The path in a source of the client.
    std::string pathIn(const Arguments& source) const;
    /// "source", "line" and "column" of a place.
    Json place(const rt::SourcePlace& place) const;
};

/// Answers a request; nothing when it will be answered later. Throws a Refusal.
using Handler = std::function<std::optional<Json>(const Request& request, const Arguments& arguments)>;
using Handlers = std::map<std::string, Handler>;

/// Registers member functions of `owner` as handlers: registrar(handlers, *this)("next", &Owner::stepOver).
template <class Owner> auto registrar(Handlers& handlers, Owner& owner) {
    return [&handlers, &owner](const char* name, Json (Owner::*member)(const Arguments&)) {
        handlers[name] = [&owner, member](const Request&, const Arguments& arguments) {
            return std::optional<Json>((owner.*member)(arguments));
        };
    };
}

} // namespace rapidc::dap
