#include "tools/rws/accounts.h"

#include "config/letter_case.h"
#include "tools/http/crypto.h"
#include "tools/http/url.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace rapidc::rws {

namespace {

constexpr std::string_view kRealm = DigestGuard::kRealm;
constexpr int kIterations = 30'000; // about 10 ms
constexpr int kShare = 10;          // deriving may take a tenth of the time

std::optional<std::string_view> afterScheme(std::string_view header, std::string_view scheme) {
    if (header.size() <= scheme.size() || header[scheme.size()] != ' ' ||
        !rapid::config::sameName(header.substr(0, scheme.size()), scheme))
        return std::nullopt;
    return header.substr(scheme.size() + 1);
}

} // namespace

Accounts::Accounts(const std::string& password) : key_(http::randomBytes(32)) {
    for (const char* name : {"Default User", "Admin"}) {
        User& user = users_[name];
        user.salt = http::randomBytes(16);
        user.derived = http::derivePassword(password, user.salt, kIterations);
        user.ha1 = http::md5Hex(fmt::format("{}:{}:{}", name, kRealm, password));
    }
}

std::string Accounts::basicChallenge() {
    return fmt::format(R"(Basic realm="{}")", kRealm);
}

std::string Accounts::checkBasic(std::string_view authorization, bool& isBusy) {
    isBusy = false;
    const auto encoded = afterScheme(authorization, "basic");
    const auto text = encoded ? http::decodeBase64(http::trimBlanks(*encoded)) : std::nullopt;
    if (!text) return {};
    const std::size_t colon = text->find(':');
    if (colon == std::string::npos) return {};
    const auto found = users_.find(std::string_view(*text).substr(0, colon));
    const std::string password = text->substr(colon + 1);
    const std::string proof = http::hmacSha256(key_, *text);
    if (found != users_.end() && http::equalSecrets(proof, found->second.verified)) return found->first;
    isBusy = !mayTry();
    if (isBusy) return {};
    if (found == users_.end()) { // takes as long as a wrong password
        (void)derive(password, key_);
        return {};
    }
    User& user = found->second;
    if (!http::equalSecrets(derive(password, user.salt), user.derived)) return {};
    user.verified = proof;
    return found->first;
}

/// Deriving a key from a wrong password is slow on purpose, and everyone waits meanwhile: so it has a share of the time, also on a
/// computer that is busy with other things.
bool Accounts::mayTry() {
    const auto now = Clock::now();
    credit_ = std::min(kMostCredit, credit_ + (now - lastTry_) / kShare);
    lastTry_ = now;
    return credit_ > Clock::duration::zero();
}

std::string Accounts::derive(const std::string& password, const std::string& salt) {
    const auto began = Clock::now();
    std::string derived = http::derivePassword(password, salt, kIterations);
    credit_ -= Clock::now() - began;
    return derived;
}

std::string Accounts::digestChallenge(bool stale) {
    return digest_.challenge(stale);
}

std::string Accounts::checkDigest(std::string_view authorization, std::string_view method,
                                  std::string_view target, bool& stale) {
    const auto secretOf = [&](const std::string& name) {
        const auto user = users_.find(name);
        return user == users_.end() ? std::string() : user->second.ha1;
    };
    const DigestGuard::Answer answer = digest_.check(authorization, method, target, secretOf);
    stale = answer.verdict == DigestGuard::Verdict::Stale;
    return answer.verdict == DigestGuard::Verdict::Right ? answer.user : std::string();
}

std::string Accounts::digestNonce(std::string_view authorization) {
    const auto fields = parseAuthorization(authorization, "Digest");
    const auto found = fields.find("nonce");
    return found == fields.end() ? std::string() : found->second;
}

} // namespace rapidc::rws
