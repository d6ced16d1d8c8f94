#pragma once
// Sessions: who is logged on, by cookie or by connection (serve-contract 12 to 14). Used on the network thread only.

#include "tools/rws/message.h"

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace rapidc::rws {

class Sessions {
  public:
    using Clock = std::chrono::steady_clock;
    static constexpr std::size_t kMost = 70;
    static constexpr std::chrono::minutes kIdleTime{5};
    /// Requests in a second of the clock before some are refused. A session may send 300 in any second, and 1,000 are too many also when
    /// two seconds of the clock share them.
    static constexpr int kMostPerSecond = 450;

    /// `ended`: called with the number of each session that ends.
    explicit Sessions(std::function<void(uint64_t)> ended) : ended_(std::move(ended)) {}

    struct LoggedOn {
        std::shared_ptr<const Session> session;
        std::string cookie, abbcx; ///< values of the cookies
        std::string proof;         ///< as it was logged on
        Clock::time_point used;
        Clock::time_point second; ///< the beginning of the present second,
        int requests = 0;         ///< and the requests in it
        int sockets = 0;          ///< open event sockets keep a session alive
    };

    /// Null: there are kMost.
    /// `proof`: the nonce of its digest, which identifies the client among those that share a connection; "" with basic.
    /// `restarts`: of the controller up to now.
    LoggedOn* logOn(Dialect dialect, const std::string& user, const std::string& address, uint64_t connection,
                    const std::string& proof, uint64_t restarts = 0);
    /// The session of a cookie; null when there is none of this dialect.
    LoggedOn* find(std::string_view cookie, Dialect dialect);
    /// The session that was logged on over this connection with this proof, for clients without cookies; null when there is
    /// none.
    LoggedOn* ofConnection(uint64_t connection, std::string_view user, std::string_view proof);
    /// The session of the cookie ABBCX, for clients that return this cookie alone and log on with each request; null when this user has
    /// none of this dialect.
    LoggedOn* ofContext(std::string_view abbcx, std::string_view user, Dialect dialect);
    LoggedOn* numbered(uint64_t number);
    /// Counts a request; false: there are too many.
    static bool countRequest(LoggedOn& session);
    void end(uint64_t number);
    /// Ends those that were logged on before the controller had restarted so often.
    void endBefore(uint64_t restarts);
    void connectionEnded(uint64_t connection) { connections_.erase(connection); }
    /// Ends those that were idle too long.
    void expire();

  private:
    template <class Fits> void endIf(const Fits& fits);

    std::function<void(uint64_t)> ended_;
    std::map<uint64_t, LoggedOn> sessions_;                ///< by number
    std::map<std::string, uint64_t, std::less<>> cookies_; ///< cookie -> number
    std::map<uint64_t, uint64_t> connections_;             ///< connection -> number
    uint64_t last_ = 0;
};

} // namespace rapidc::rws
