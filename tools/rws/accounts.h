#pragma once
// Accounts: the users of the controller and the proofs of their passwords. No password is kept. Used on the network thread only.

#include "tools/rws/digest.h"

#include <chrono>
#include <map>
#include <string>
#include <string_view>

namespace rapidc::rws {

class Accounts {
  public:
    using Clock = std::chrono::steady_clock;

    /// 'Default User' and 'Admin' with this password.
    explicit Accounts(const std::string& password);

    /// Header Authorization of HTTP basic: the user, "" when it is refused.
    /// `isBusy`: too many wrong passwords were tried within a second, so this one was not checked.
    std::string checkBasic(std::string_view authorization, bool& isBusy);
    /// Header Authorization of HTTP digest (MD5; with qop=auth or, as RFC 2069 has it, without). `stale`: the nonce is not valid any
    /// more, so the client may try again with a new one.
    std::string checkDigest(std::string_view authorization, std::string_view method, std::string_view target,
                            bool& stale);
    /// The nonce that an answer of HTTP digest names, "" without one.
    static std::string digestNonce(std::string_view authorization);
    /// Value of WWW-Authenticate with a new nonce.
    std::string digestChallenge(bool stale);
    static std::string basicChallenge();

  private:
    struct User {
        std::string salt, derived; ///< of the password, for basic
        std::string ha1;           ///< of name, realm and password, for digest
        std::string verified;      ///< proof of the header accepted last, so that it is derived once
    };
    bool mayTry();
    std::string derive(const std::string& password, const std::string& salt);

    std::map<std::string, User, std::less<>> users_;
    DigestGuard digest_;
    std::string key_; ///< of the proofs
    static constexpr Clock::duration kMostCredit = std::chrono::milliseconds(500);
    Clock::time_point lastTry_;
    Clock::duration credit_ = kMostCredit; ///< time that deriving may take
};

} // namespace rapidc::rws
