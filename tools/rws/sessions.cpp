#include "tools/rws/sessions.h"

#include "tools/http/crypto.h"

#include <vector>

namespace rapidc::rws {

Sessions::LoggedOn* Sessions::logOn(Dialect dialect, const std::string& user, const std::string& address,
                                    uint64_t connection, const std::string& proof, uint64_t restarts) {
    if (sessions_.size() >= kMost) expire();
    if (sessions_.size() >= kMost) return nullptr;
    const uint64_t number = ++last_;
    LoggedOn& session = sessions_[number];
    session.session = std::make_shared<const Session>(Session{number, dialect, user, address, restarts});
    session.cookie = http::randomHex(16);
    session.abbcx = http::randomHex(8);
    session.proof = proof;
    session.used = session.second = Clock::now();
    cookies_[session.cookie] = number;
    connections_[connection] = number;
    return &session;
}

Sessions::LoggedOn* Sessions::numbered(uint64_t number) {
    const auto found = sessions_.find(number);
    return found == sessions_.end() ? nullptr : &found->second;
}

Sessions::LoggedOn* Sessions::find(std::string_view cookie, Dialect dialect) {
    const auto found = cookies_.find(cookie);
    LoggedOn* session = found == cookies_.end() ? nullptr : numbered(found->second);
    return session != nullptr && session->session->dialect == dialect ? session : nullptr;
}

Sessions::LoggedOn* Sessions::ofConnection(uint64_t connection, std::string_view user,
                                           std::string_view proof) {
    const auto found = connections_.find(connection);
    LoggedOn* session = found == connections_.end() ? nullptr : numbered(found->second);
    const bool isSame = session != nullptr && session->session->user == user && session->proof == proof;
    return isSame ? session : nullptr;
}

Sessions::LoggedOn* Sessions::ofContext(std::string_view abbcx, std::string_view user, Dialect dialect) {
    for (auto& [number, each] : sessions_)
        if (each.abbcx == abbcx && each.session->user == user && each.session->dialect == dialect)
            return &each;
    return nullptr;
}

bool Sessions::countRequest(LoggedOn& session) {
    session.used = Clock::now();
    if (session.used - session.second >= std::chrono::seconds(1)) {
        session.second = session.used;
        session.requests = 0;
    }
    return ++session.requests <= kMostPerSecond;
}

void Sessions::end(uint64_t number) {
    const auto found = sessions_.find(number);
    if (found == sessions_.end()) return;
    cookies_.erase(found->second.cookie);
    sessions_.erase(found);
    ended_(number);
}

template <class Fits> void Sessions::endIf(const Fits& fits) {
    std::vector<uint64_t> numbers;
    for (const auto& [number, session] : sessions_)
        if (fits(session)) numbers.push_back(number);
    for (const uint64_t number : numbers)
        end(number);
}

void Sessions::endBefore(uint64_t restarts) {
    endIf([&](const LoggedOn& each) { return each.session->restarts < restarts; });
}

void Sessions::expire() {
    const auto now = Clock::now();
    endIf([&](const LoggedOn& each) { return each.sockets == 0 && now - each.used > kIdleTime; });
}

} // namespace rapidc::rws
