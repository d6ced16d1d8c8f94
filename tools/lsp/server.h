#pragma once
// Server: one conversation with a client. Messages in, messages out; it knows no threads and no files but those of the
// workspace, so that tests and fuzzers can talk to it.

#include "tools/lsp/diagnostics.h"
#include "tools/lsp/state.h"

#include <functional>
#include <string>
#include <string_view>

namespace lsp {

class Server {
  public:
    Server(const rapid::workspace::Environment& environment, State::Send send);

    /// Says whether the client has cancelled a request, before and while it is worked on; null: it cannot be cancelled.
    using CancelOf = std::function<const rapid::query::Cancel*(const Json& id)>;
    void setCancel(CancelOf cancelOf) { cancelOf_ = std::move(cancelOf); }
    /// Options as those of -W, which hold as long as the client has no settings of its own.
    void setWarnings(const std::vector<std::string>& warnings) { state_.workspace.setWarnings(warnings); }
    /// Takes one message.
    void receive(const Json& message);
    /// The body of a frame that is not JSON.
    void receiveGarbage();
    /// Publishes diagnostics when something changed. `interrupted` is asked between programs: it ends this early, with nothing
    /// published, when messages are waiting. `whole`: also what takes long in large programs (the judgement about all of a
    /// program); without it that may be left for the next time.
    void catchUp(bool whole, const std::function<bool()>& interrupted = nullptr);
    /// Whether catchUp has something to do.
    bool isBehind() const;
    /// The last answer was given while the user types, before the rest of the module was checked: the next edit is near.
    bool isTyping() const { return state_.workspace.isSketched(); }
    /// The same, and the check takes so long that it should wait until the user pauses.
    bool isTypingInLarge() const { return state_.workspace.isSlowToComplete(); }

    bool hasEnded() const { return phase_ == Phase::Ended; }
    /// After the end of the conversation: 0 when the client has asked for a shutdown, else 1.
    int exitStatus() const { return wasShutDown_ ? 0 : 1; }
    /// Of the client, which it names in initialize; 0 when it does not.
    int64_t clientProcess() const;

  private:
    enum class Phase : uint8_t { New, Initialized, ShutDown, Ended };

    void request(const Json& id, const std::string& method, const Json& params);
    Json answer(const std::string& method, const Json& params);
    void notification(const std::string& method, const Json& params);
    void begin();
    void endProgress();
    void refuse(const Json& id, int code, const std::string& message) {
        send_(errorResponse(id, code, message));
    }

    State::Send send_;
    State state_;
    Publisher publisher_;
    Phase phase_ = Phase::New;
    bool wasShutDown_ = false;
    bool showsProgress_ = false; ///< the client shows that folders are being read
    CancelOf cancelOf_;
};

} // namespace lsp
