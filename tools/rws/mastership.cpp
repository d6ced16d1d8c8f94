#include "tools/rws/mastership.h"

#include <algorithm>
#include <random>

namespace rapidc::rws {

using service::Change;

const Mastership::Holder* Mastership::holder(Domain domain) const {
    const auto& held = holders_[static_cast<std::size_t>(domain)];
    return held ? &*held : nullptr;
}

bool Mastership::isHeldBy(Domain domain, uint64_t session) const {
    const Holder* held = holder(domain);
    return held != nullptr && held->session == session;
}

bool Mastership::isFree(const std::vector<Domain>& domains, uint64_t session) const {
    return std::all_of(domains.begin(), domains.end(),
                       [&](Domain domain) { return holder(domain) == nullptr || isHeldBy(domain, session); });
}

bool Mastership::request(const std::vector<Domain>& domains, const Request& request) {
    const Session& session = *request.session;
    if (!isFree(domains, session.number)) return false;
    bool isNew = false;
    for (const Domain domain : domains) {
        std::optional<Holder>& held = slot(domain);
        isNew = isNew || !held;
        const int id = held ? held->id : 0;
        const uint64_t connection = session.dialect == Dialect::V1 ? request.connection : 0;
        held = Holder{session.number, connection, id, session.user, session.address};
    }
    if (isNew) observers_.changed(Change::Mastership);
    return true;
}

int Mastership::requestWithId(const std::vector<Domain>& domains, const Request& request) {
    if (!this->request(domains, request)) return 0;
    int id = slot(domains.front())->id;
    std::random_device random;
    while (id == 0)
        id = static_cast<int>(random() & 0x7FFFFFFF);
    for (const Domain domain : domains)
        slot(domain)->id = id;
    return id;
}

bool Mastership::release(const std::vector<Domain>& domains, uint64_t session) {
    if (!isFree(domains, session)) return false;
    drop([&](Domain domain, const Holder&) {
        return std::find(domains.begin(), domains.end(), domain) != domains.end();
    });
    return true;
}

bool Mastership::releaseWithId(const std::vector<Domain>& domains, int id) {
    const bool fits = id != 0 && std::all_of(domains.begin(), domains.end(), [&](Domain domain) {
                          return holder(domain) != nullptr && holder(domain)->id == id;
                      });
    if (!fits) return false;
    drop([&](Domain domain, const Holder&) {
        return std::find(domains.begin(), domains.end(), domain) != domains.end();
    });
    return true;
}

void Mastership::releaseAll() {
    drop([](Domain, const Holder&) { return true; });
}

void Mastership::sessionEnded(uint64_t session) {
    for (std::optional<Holder>& held : holders_)
        if (held && held->session == session && held->id != 0) held->session = 0;
    drop([&](Domain, const Holder& held) { return held.session == session; });
}

void Mastership::connectionClosed(uint64_t connection) {
    drop([&](Domain, const Holder& held) { return held.connection == connection && held.connection != 0; });
}

template <class Ends> void Mastership::drop(Ends ends) {
    bool changed = false;
    for (const Domain domain : {Domain::Cfg, Domain::Rapid, Domain::Motion}) {
        std::optional<Holder>& held = slot(domain);
        if (!held || !ends(domain, *held)) continue;
        held.reset();
        changed = true;
    }
    if (changed) observers_.changed(Change::Mastership);
}

} // namespace rapidc::rws
