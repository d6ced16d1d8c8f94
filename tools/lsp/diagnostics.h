#pragma once
// Diagnostics of the workspace for the client: pushed when they change, or pulled.

#include "frontend/diag/diagnostic.h"
#include "tools/lsp/state.h"

#include <map>
#include <string>
#include <vector>

namespace lsp {

/// What there is to say of the files of the workspace now, by path; notes of a backup are left out. Good until the workspace
/// changes.
using DiagnosticsByPath = std::map<std::string, std::vector<const rapid::diag::Diagnostic*>>;
DiagnosticsByPath diagnosticsByPath(State& state);

/// Those of one document.
std::vector<const rapid::diag::Diagnostic*> diagnosticsOf(State& state, const std::string& path);

Json toJson(State& state, const rapid::diag::Diagnostic& diagnostic);

class Publisher {
  public:
    /// Sends what has changed since the last time, and all of what is open in another version.
    void publish(State& state);
    /// Open documents of large programs, without a look at all of the program. True: there are none, and publish() takes no time.
    bool publishQuickly(State& state);
    /// The document is sent next time whether it has changed or not.
    void forget(const std::string& path) { sent_[path].hash = 0; }

  private:
    struct Sent {
        uint64_t hash = 0;
        int64_t version = -1; ///< of the document; -1: it is not open
    };
    void send(State& state, const std::string& path,
              const std::vector<const rapid::diag::Diagnostic*>& diagnostics);
    void logOthers(State& state);

    std::map<std::string, Sent> sent_;
    std::string logged_; ///< what is said of no file
};

/// textDocument/diagnostic and workspace/diagnostic
Json pullDiagnostics(State& state, const Json& params);
Json pullWorkspaceDiagnostics(State& state, const Json& params);

} // namespace lsp
