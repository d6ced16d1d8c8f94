#include "tools/rws/accounts.h"

#include "config/letter_case.h"
#include "tools/http/crypto.h"
#include "tools/http/url.h"

#include <charconv>
#include <fmt/format.h>
#include <optional>

namespace rapidc::rws {

namespace {

constexpr const char* kRealm = "validusers@robapi.abb"; // clients look for "robapi"
constexpr int kIterations = 100'000;
constexpr std::chrono::minutes kNonceLife{10};
constexpr std::size_t kMostNonces = 10'000, kMostCounters = 100'000;

using Parameters = std::map<std::string, std::string, std::less<>>;

/// name=value or name="value", separated by commas. None: not of this form.
std::optional<Parameters> parametersOf(std::string_view text) {
    Parameters result;
    while (!(text = http::trimBlanks(text)).empty()) {
        const std::size_t equals = text.find('=');
        if (equals == std::string_view::npos) return std::nullopt;
        const std::string name =
            rapid::config::lowerCase(std::string(http::trimBlanks(text.substr(0, equals))));
        text = http::trimBlanks(text.substr(equals + 1));
        std::string value;
        if (!text.empty() && text.front() == '"') {
            std::size_t i = 1;
            for (; i < text.size() && text[i] != '"'; ++i) {
                if (text[i] == '\\' && i + 1 < text.size()) ++i;
                value += text[i];
            }
            if (i >= text.size()) return std::nullopt;
            text = http::trimBlanks(text.substr(i + 1));
            if (!text.empty() && text.front() != ',') return std::nullopt;
        } else {
            const std::size_t end = std::min(text.find(','), text.size());
            value = std::string(http::trimBlanks(text.substr(0, end)));
            text.remove_prefix(end);
        }
        if (!text.empty()) text.remove_prefix(1); // the comma
        if (!result.emplace(name, std::move(value)).second) return std::nullopt;
    }
    return result;
}

std::optional<std::string_view> afterScheme(std::string_view header, std::string_view scheme) {
    if (header.size() <= scheme.size() || header[scheme.size()] != ' ' ||
        !rapid::config::sameName(header.substr(0, scheme.size()), scheme))
        return std::nullopt;
    return header.substr(scheme.size() + 1);
}

/// Whether the uri of an answer is the target of its request.
bool isSameTarget(std::string_view uri, std::string_view target) {
    if (uri == target) return true;
    const auto a = http::parseTarget(uri), b = http::parseTarget(target);
    return a && b && a->path == b->path && a->query == b->query;
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

std::string Accounts::checkBasic(std::string_view authorization) {
    const auto encoded = afterScheme(authorization, "basic");
    const auto text = encoded ? http::decodeBase64(http::trimBlanks(*encoded)) : std::nullopt;
    if (!text) return {};
    const std::size_t colon = text->find(':');
    if (colon == std::string::npos) return {};
    const auto found = users_.find(std::string_view(*text).substr(0, colon));
    const std::string password = text->substr(colon + 1);
    if (found == users_.end()) { // takes as long as a wrong password
        (void)http::derivePassword(password, key_, kIterations);
        return {};
    }
    User& user = found->second;
    const std::string proof = http::hmacSha256(key_, *text);
    if (!user.verified.empty() && http::equalSecrets(proof, user.verified)) return found->first;
    if (!http::equalSecrets(http::derivePassword(password, user.salt, kIterations), user.derived)) return {};
    user.verified = proof;
    return found->first;
}

void Accounts::dropOldNonces() {
    const auto now = Clock::now();
    std::erase_if(nonces_, [&](const auto& item) { return now - item.second.made > kNonceLife; });
    if (nonces_.size() >= kMostNonces) nonces_.clear(); // clients get a new one with "stale"
}

std::string Accounts::digestChallenge(bool stale) {
    if (nonces_.size() % 1000 == 999) dropOldNonces();
    const std::string nonce = http::randomHex(16);
    nonces_[nonce].made = Clock::now();
    return fmt::format(R"(Digest realm="{}", nonce="{}", qop="auth", algorithm=MD5, opaque="{}"{})", kRealm,
                       nonce, http::randomHex(8), stale ? ", stale=true" : "");
}

std::string Accounts::checkDigest(std::string_view authorization, std::string_view method,
                                  std::string_view target, bool& stale) {
    stale = false;
    const auto text = afterScheme(authorization, "digest");
    const auto given = text ? parametersOf(*text) : std::nullopt;
    if (!given) return {};
    const auto value = [&](std::string_view name) {
        const auto found = given->find(name);
        return found == given->end() ? std::string() : found->second;
    };
    const auto user = users_.find(value("username"));
    if (user == users_.end() || value("realm") != kRealm || !isSameTarget(value("uri"), target)) return {};
    if (given->contains("algorithm") && !rapid::config::sameName(value("algorithm"), "MD5")) return {};
    const std::string qop = value("qop"), count = value("nc");
    const std::string ha2 = http::md5Hex(fmt::format("{}:{}", method, value("uri")));
    const std::string middle = qop.empty()
                                   ? value("nonce")
                                   : fmt::format("{}:{}:{}:{}", value("nonce"), count, value("cnonce"), qop);
    const std::string expected = http::md5Hex(fmt::format("{}:{}:{}", user->second.ha1, middle, ha2));
    if (!http::equalSecrets(rapid::config::lowerCase(value("response")), expected)) return {};
    const auto nonce = nonces_.find(value("nonce"));
    stale = nonce == nonces_.end() || Clock::now() - nonce->second.made > kNonceLife;
    if (stale) return {};
    if (qop.empty()) return user->first;
    uint32_t number = 0;
    const auto [end, problem] = std::from_chars(count.data(), count.data() + count.size(), number, 16);
    if (qop != "auth" || problem != std::errc() || end != count.data() + count.size() || count.size() != 8)
        return {};
    if (nonce->second.counters.size() >= kMostCounters || !nonce->second.counters.insert(number).second) {
        stale = true; // a counter works once
        return {};
    }
    return user->first;
}

} // namespace rapidc::rws
