#pragma once
// Digest login of HTTP (RFC 2617 and RFC 2069), as clients of RWS 1.0 do it: MD5, with or without qop=auth.

#include <chrono>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>

namespace rapidc::rws {

/// The parts of an Authorization header after its scheme: names in lower case, quotes removed. Empty when it is not well formed.
std::map<std::string, std::string, std::less<>> parseAuthorization(std::string_view header,
                                                                   std::string_view scheme);

/// Issues nonces and checks answers. Each answer counts once.
class DigestGuard {
  public:
    using Clock = std::chrono::steady_clock;

    DigestGuard();
    /// The realm that clients recognise RWS 1.0 by.
    static constexpr std::string_view kRealm = "validusers@robapi.abb";

    /// The value of WWW-Authenticate. `isStale`: the password was right, only the nonce must be a new one.
    std::string challenge(bool isStale);

    enum class Verdict : uint8_t { Right, Wrong, Stale };
    struct Answer {
        Verdict verdict = Verdict::Wrong;
        std::string user;
    };
    /// `secretOf`: MD5 of "user:realm:password" in hexadecimal digits, "" for an unknown user.
    template <class SecretOf>
    Answer check(std::string_view header, std::string_view method, std::string_view target,
                 const SecretOf& secretOf) {
        const auto fields = parseAuthorization(header, "Digest");
        const auto user = fields.find("username");
        if (user == fields.end()) return {};
        return {judge(fields, method, target, secretOf(user->second)), user->second};
    }

  private:
    using Fields = std::map<std::string, std::string, std::less<>>;
    /// The counters and answers of a nonce that have been used.
    struct Used {
        Clock::time_point last;
        uint32_t highest = 0;          ///< counter value
        uint64_t before = 0;           ///< bit n: highest - 1 - n was used
        std::set<std::string> answers; ///< without counter
    };
    Verdict judge(const Fields& fields, std::string_view method, std::string_view target,
                  const std::string& secret);
    std::string newNonce() const;
    bool isOurs(const std::string& nonce) const;
    bool useCounter(const std::string& nonce, uint32_t counter);
    bool useAnswer(const std::string& nonce, const std::string& answer);
    Used& usedOf(const std::string& nonce);

    const std::string key_;
    const Clock::time_point start_ = Clock::now();
    std::map<std::string, Used> used_; ///< of nonces that were answered rightly
    int64_t floor_ = -1; ///< other nonces issued until then (seconds after the start) are not accepted
};

} // namespace rapidc::rws
