#include "tools/rws/digest.h"

#include "config/letter_case.h"
#include "tools/http/crypto.h"
#include "tools/http/url.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace rapidc::rws {

namespace {

constexpr std::chrono::hours kNonceLife{12};
constexpr std::size_t kMostNonces = 4096;  ///< that were answered rightly
constexpr std::size_t kMostAnswers = 1024; ///< without counter, of one nonce
constexpr uint32_t kWindow = 64;
constexpr std::size_t kRandomDigits = 32, kTimeDigits = 8, kSealDigits = 32;

bool sameText(std::string_view a, std::string_view b) {
    return rapid::config::sameName(a, b);
}

/// Takes one value, quoted or not. False when a quote has no end.
bool takeValue(std::string_view& rest, std::string& value) {
    if (!rest.starts_with('"')) {
        const std::size_t end = std::min(rest.find(','), rest.size());
        value = http::trimBlanks(rest.substr(0, end));
        rest.remove_prefix(end);
        return value.find_first_of(" \t\"") == std::string::npos;
    }
    for (std::size_t i = 1; i < rest.size(); ++i) {
        if (rest[i] == '"') {
            rest.remove_prefix(i + 1);
            return true;
        }
        if (rest[i] == '\\' && ++i == rest.size()) return false;
        value += rest[i];
    }
    return false;
}

const std::string& fieldOf(const std::map<std::string, std::string, std::less<>>& fields,
                           std::string_view name) {
    static const std::string kNone;
    const auto found = fields.find(name);
    return found == fields.end() ? kNone : found->second;
}

bool parseHex(std::string_view text, uint32_t& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
    return error == std::errc() && end == text.data() + text.size() && text.size() <= 8;
}

} // namespace

std::map<std::string, std::string, std::less<>> parseAuthorization(std::string_view header,
                                                                   std::string_view scheme) {
    std::map<std::string, std::string, std::less<>> fields;
    if (!rapid::config::beginsWithName(header, scheme)) return {};
    std::string_view rest = header.substr(scheme.size());
    if (!rest.starts_with(' ')) return {};
    rest = http::trimBlanks(rest);
    while (!rest.empty()) {
        const std::size_t equals = rest.find('=');
        if (equals == std::string_view::npos) return {};
        const std::string name = rapid::config::lowerCase(http::trimBlanks(rest.substr(0, equals)));
        rest = http::trimBlanks(rest.substr(equals + 1));
        std::string value;
        if (name.empty() || !takeValue(rest, value) || !fields.emplace(name, std::move(value)).second)
            return {};
        rest = http::trimBlanks(rest);
        if (rest.empty()) break;
        if (!rest.starts_with(',')) return {};
        rest = http::trimBlanks(rest.substr(1));
    }
    return fields;
}

DigestGuard::DigestGuard() : key_(http::randomBytes(32)) {}

std::string DigestGuard::challenge(bool isStale) {
    return fmt::format("Digest realm=\"{}\", domain=\"/\", qop=\"auth\", nonce=\"{}\", opaque=\"{}\", "
                       "algorithm=\"MD5\", stale=\"{}\"",
                       kRealm, newNonce(), http::md5Hex(key_).substr(0, 16), isStale ? "TRUE" : "FALSE");
}

/// Random digits, the time of issue and a seal: so nonces need no memory until they are answered rightly.
std::string DigestGuard::newNonce() const {
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(Clock::now() - start_).count();
    const std::string text = http::randomHex(kRandomDigits / 2) + fmt::format("{:08x}", seconds & 0xFFFFFFFF);
    return text + http::hexOf(http::hmacSha256(key_, text)).substr(0, kSealDigits);
}

bool DigestGuard::isOurs(const std::string& nonce) const {
    if (nonce.size() != kRandomDigits + kTimeDigits + kSealDigits) return false;
    const std::string text = nonce.substr(0, kRandomDigits + kTimeDigits);
    if (!http::equalSecrets(http::hexOf(http::hmacSha256(key_, text)).substr(0, kSealDigits),
                            nonce.substr(text.size())))
        return false;
    uint32_t issued = 0;
    if (!parseHex(std::string_view(text).substr(kRandomDigits), issued)) return false;
    if (issued <= floor_ && !used_.contains(nonce)) return false;
    return Clock::now() - start_ < std::chrono::seconds(issued) + kNonceLife;
}

DigestGuard::Verdict DigestGuard::judge(const Fields& fields, std::string_view method,
                                        std::string_view target, const std::string& secret) {
    const std::string& qop = fieldOf(fields, "qop");
    const std::string& algorithm = fieldOf(fields, "algorithm");
    const std::string& nonce = fieldOf(fields, "nonce");
    const std::string& response = fieldOf(fields, "response");
    const std::string& uri = fieldOf(fields, "uri"); // some clients leave the query out
    if (secret.empty() || fieldOf(fields, "realm") != kRealm ||
        (uri != target && uri != target.substr(0, target.find('?'))))
        return Verdict::Wrong;
    if (!algorithm.empty() && !sameText(algorithm, "MD5")) return Verdict::Wrong;
    if (!qop.empty() && !sameText(qop, "auth")) return Verdict::Wrong;
    const std::string operation = http::md5Hex(fmt::format("{}:{}", method, uri));
    const std::string& counterText = fieldOf(fields, "nc");
    const std::string expected =
        qop.empty() ? http::md5Hex(fmt::format("{}:{}:{}", secret, nonce, operation))
                    : http::md5Hex(fmt::format("{}:{}:{}:{}:{}:{}", secret, nonce, counterText,
                                               fieldOf(fields, "cnonce"), qop, operation));
    if (!http::equalSecrets(expected, rapid::config::lowerCase(response))) return Verdict::Wrong;
    if (!isOurs(nonce)) return Verdict::Stale;
    uint32_t counter = 0;
    if (qop.empty()) return useAnswer(nonce, expected) ? Verdict::Right : Verdict::Stale;
    if (!parseHex(counterText, counter) || counter == 0) return Verdict::Wrong;
    return useCounter(nonce, counter) ? Verdict::Right : Verdict::Stale;
}

DigestGuard::Used& DigestGuard::usedOf(const std::string& nonce) {
    if (used_.size() >= kMostNonces && !used_.contains(nonce)) {
        const auto oldest = std::min_element(used_.begin(), used_.end(), [](const auto& a, const auto& b) {
            return a.second.last < b.second.last;
        });
        // Its counters would count again, so nothing as old as it is accepted any more.
        uint32_t issued = 0;
        parseHex(std::string_view(oldest->first).substr(kRandomDigits, kTimeDigits), issued);
        floor_ = std::max<int64_t>(floor_, issued);
        used_.erase(oldest);
    }
    Used& used = used_[nonce];
    used.last = Clock::now();
    return used;
}

bool DigestGuard::useCounter(const std::string& nonce, uint32_t counter) {
    Used& used = usedOf(nonce);
    if (counter > used.highest) {
        const uint32_t step = counter - used.highest;
        used.before = step > kWindow ? 0 : (step == kWindow ? 0 : used.before << step);
        if (used.highest > 0 && step <= kWindow) used.before |= uint64_t{1} << (step - 1);
        used.highest = counter;
        return true;
    }
    const uint32_t behind = used.highest - counter;
    if (behind == 0 || behind > kWindow) return false;
    const uint64_t bit = uint64_t{1} << (behind - 1);
    if (used.before & bit) return false;
    used.before |= bit;
    return true;
}

bool DigestGuard::useAnswer(const std::string& nonce, const std::string& answer) {
    Used& used = usedOf(nonce);
    return used.answers.size() < kMostAnswers && used.answers.insert(answer).second;
}

} // namespace rapidc::rws
