#pragma once
// The state of the server while a client is connected: its documents, the programs they belong to, abilities of the client.
// Every request is a function of it (requests.h).

#include "frontend/query/snapshot.h"
#include "frontend/workspace/workspace.h"
#include "tools/lsp/documents.h"
#include "tools/lsp/positions.h"
#include "tools/lsp/protocol.h"

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace lsp {

/// The module that a request is about.
struct Target {
    std::string path;
    std::shared_ptr<const PositionMap> positions; ///< of its text as it is now
    rapid::workspace::Program* program = nullptr; ///< up to date; null: it is not a module
    const rapid::syntax::SyntaxTree* tree = nullptr;
    const rapid::query::Snapshot* snapshot = nullptr; ///< of the program
    const rapid::query::FileView* view = nullptr;     ///< of the module
    uint32_t offset = 0;                              ///< of params.position; see targetAt

    bool isModule() const { return view != nullptr; }
};

class State {
  public:
    using Send = std::function<void(const Json&)>;
    /// The handler of the client's answer; null when it is an error.
    using Answered = std::function<void(State&, const Json* result)>;

    State(const rapid::workspace::Environment& environment, Send send);
    ~State();
    State(const State&) = delete;
    State& operator=(const State&) = delete;

    const rapid::workspace::Environment& environment;
    rapid::workspace::Workspace workspace;
    Documents documents;
    PositionEncoding encoding = PositionEncoding::Utf16;

    /// The parameters of initialize; an empty object before.
    const Json& initialization() const { return *initialization_; }
    void setInitialization(const Json& params);
    /// Whether the client has a capability, e.g. "textDocument.completion.completionItem.snippetSupport".
    bool can(std::string_view capability) const;
    /// The value of a capability; null when the client does not speak of it.
    const Json* capability(std::string_view path) const;

    void notify(const std::string& method, Json params);
    void request(const std::string& method, Json params, Answered answered);
    void answer(const Json& message);
    /// A line for the client's log; `type` 1 error, 2 warning, 3 information.
    void log(int type, const std::string& text);
    /// The same where the user sees it.
    void show(int type, const std::string& text);

    std::shared_ptr<const PositionMap> positions(const std::shared_ptr<const rapid::SourceFile>& file);
    /// The document of params.textDocument. Throws RequestError when there is no such text.
    Target target(const Json& params);
    /// With the offset of params.position.
    Target targetAt(const Json& params);
    /// The same while the user types there: only routines around the position need to have been checked, which others do not
    /// wait for (Workspace::programAround).
    Target targetWhileTyping(const Json& params);
    Target targetOfPath(const std::string& path);
    /// The program as queries see it, good until it changes.
    const rapid::query::Snapshot& snapshot(const rapid::workspace::Program& program);
    /// Makes the tables of names that the first request about an open document would wait for.
    void prepareNames();
    /// { uri, range } of a place in a file.
    Json location(const std::shared_ptr<const rapid::SourceFile>& file, rapid::SourceRange range);
    /// Of a declaration; those of the library as a readable file. Null when there is no such text.
    Json location(const rapid::query::Location& location);
    /// The URI of the file of a location; "" when there is none.
    std::string uriOf(const rapid::query::Location& location);
    /// TextEdits of a file.
    Json edits(const PositionMap& positions, const std::vector<rapid::TextEdit>& edits) const;
    /// A WorkspaceEdit: edits by path, in the form that the client has.
    Json workspaceEdit(
        const std::vector<std::pair<std::shared_ptr<const rapid::SourceFile>, std::vector<rapid::TextEdit>>>&
            files);

    /// Nothing is published before the settings of the client are known, or it has taken too long to tell them.
    bool settingsKnown = false;
    std::chrono::steady_clock::time_point settingsDeadline;
    /// Some text, file or setting changed since diagnostics were published.
    bool dirty = false;
    /// Of the request that is worked on: handlers give it to their queries. Null: it cannot be cancelled.
    const rapid::query::Cancel* cancel = nullptr;

  private:
    std::string pathOf(const Json& params);
    Target targetIn(const std::string& path, rapid::workspace::Program* program);

    Send send_;
    std::unique_ptr<Json> initialization_;
    std::map<int64_t, Answered> waiting_;
    int64_t lastRequest_ = 0;
    std::map<const rapid::SourceFile*, std::shared_ptr<const PositionMap>> positions_;
    struct KeptSnapshot {
        uint64_t generation = 0;
        std::unique_ptr<rapid::query::Snapshot> snapshot;
        std::shared_ptr<rapid::query::GlobalNames> names; ///< of all snapshots of the program
    };
    std::map<std::string, KeptSnapshot> snapshots_; ///< by root of the program
};

} // namespace lsp
