#include "tools/rws/mastership_resources.h"
#include "tools/rws/request_values.h"

#include "config/letter_case.h"
#include "tools/rws/rapid_support.h"
#include "tools/rws/state_watch.h"

#include <algorithm>

namespace rapidc::rws {

namespace {

using NamedDomains = std::pair<const char*, std::vector<Domain>>;

const std::vector<NamedDomains>& domainsOf(Dialect dialect) {
    static const std::vector<NamedDomains> kOld{
        {"cfg", {Domain::Cfg}}, {"motion", {Domain::Motion}}, {"rapid", {Domain::Rapid}}};
    static const std::vector<NamedDomains> kNew{{"edit", {Domain::Cfg, Domain::Rapid}},
                                                {"motion", {Domain::Motion}}};
    return dialect == Dialect::V1 ? kOld : kNew;
}

/// The domain that the path names; without a name all of them. Empty: there is no such domain.
std::vector<Domain> asked(const Request& request) {
    const std::string& name = request.parameter("domain");
    std::vector<Domain> all;
    // Clients that know RobotWare 6 use its names in both dialects.
    const bool isOldName = rapid::config::sameName(name, "cfg") || rapid::config::sameName(name, "rapid");
    for (const auto& [known, domains] : domainsOf(isOldName ? Dialect::V1 : request.dialect)) {
        if (name.empty() || rapid::config::sameName(known, name))
            all.insert(all.end(), domains.begin(), domains.end());
    }
    return all;
}

Reply noMastershipDomain(const Request& request) {
    return Reply::refuse(ReturnCode::NotFound, request.dialect == Dialect::V1
                                                   ? "The domains are cfg, motion and rapid"
                                                   : "The domains are edit and motion");
}

Reply heldByOther() {
    return Reply::refuse(ReturnCode::HeldByOther, "Requested resource is held by someone else");
}

} // namespace

Handler MastershipResources::before8(Handler handler) const {
    return [this, handler = std::move(handler)](const Request& request) {
        if (request.dialect == Dialect::V2 && controller_.settings().robotWare >= 8)
            return Reply::refuse(
                ReturnCode::Rejected,
                "RobotWare 8 has control stations in place of mastership: /rw/controlstation", 410);
        return handler(request);
    };
}

void MastershipResources::addTo(Router& router, Subscribables& subscribables) {
    const std::string all = "/rw/mastership", one = "/rw/mastership/{domain}";
    router.getBoth(all, before8([this](const Request& request) { return list(request); }));
    router.getBoth(one, before8([this](const Request& request) { return show(request); }));
    for (const std::string& pattern : {all, one}) {
        addOrder(router, pattern, "request", "request",
                 before8([this](const Request& request) { return this->request(request); }));
        addOrder(router, pattern, "release", "release",
                 before8([this](const Request& request) { return release(request); }));
    }
    router.post(Dialect::V2, one + "/request-with-id",
                before8([this](const Request& request) { return requestWithId(request); }));
    router.post(Dialect::V2, one + "/release-with-id",
                before8([this](const Request& request) { return releaseWithId(request); }));
    router.post(Dialect::V2, all + "/watchdog", before8([](const Request&) { return Reply::done(); }));
    subscribables.add(
        {one,
         "",
         false,
         {},
         [this](const Request& request, const Changed& changed, Subscription& out) -> std::optional<Failure> {
             const std::vector<Domain> domains = asked(request);
             const bool gone = request.dialect == Dialect::V2 && controller_.settings().robotWare >= 8;
             if (domains.empty() || gone) return Failure{ReturnCode::NotFound, "There is no such mastership"};
             const std::string& name = request.parameter("domain");
             return watchState(
                 controller_.observers(), {service::Change::Mastership},
                 [this, name, domains] { // sessions share the event: it does not say whether it is theirs
                     return holderEntry("msh-resource-ev", name, domains);
                 },
                 changed, out);
         }});
}

Entry MastershipResources::holderEntry(const char* type, const std::string& name,
                                       const std::vector<Domain>& domains) const {
    const Mastership::Holder* holder = nullptr;
    for (const Domain domain : domains)
        if (const Mastership::Holder* found = mastership_.holder(domain)) holder = found;
    Entry entry;
    entry.type = type;
    entry.title = name;
    entry.value("mastership", holder ? "remote" : "nomaster")
        .value("uid", holder ? std::to_string(holder->session) : "")
        .value("application", holder ? "RobotWebServices" : "")
        .value("location", holder ? holder->address : "")
        .value("alias", holder ? holder->user : "");
    return entry;
}

Entry MastershipResources::entryOf(const char* type, const Request& request, const std::string& name,
                                   const std::vector<Domain>& domains) const {
    const uint64_t session = request.session ? request.session->number : 0;
    const bool isMine = std::all_of(domains.begin(), domains.end(),
                                    [&](Domain domain) { return mastership_.isHeldBy(domain, session); });
    Entry entry = holderEntry(type, name, domains);
    entry.value("mastershipheldbyme", isMine ? "TRUE" : "FALSE");
    return entry;
}

Reply MastershipResources::list(const Request& request) const {
    Document document;
    for (const auto& [name, domains] : domainsOf(request.dialect)) {
        Entry entry = entryOf("msh-resource-li", request, name, domains);
        entry.self = name;
        document.entries.push_back(std::move(entry));
    }
    return Reply::of(std::move(document));
}

Reply MastershipResources::show(const Request& request) const {
    const std::vector<Domain> domains = asked(request);
    if (domains.empty()) return noMastershipDomain(request);
    Document document;
    document.entries.push_back(entryOf("msh-resource", request, request.parameter("domain"), domains));
    return Reply::of(std::move(document));
}

Reply MastershipResources::request(const Request& request) {
    const std::vector<Domain> domains = asked(request);
    if (domains.empty()) return noMastershipDomain(request);
    return mastership_.request(domains, request) ? Reply::done() : heldByOther();
}

Reply MastershipResources::release(const Request& request) {
    const std::vector<Domain> domains = asked(request);
    if (domains.empty()) return noMastershipDomain(request);
    return mastership_.release(domains, request.session->number) ? Reply::done() : heldByOther();
}

Reply MastershipResources::requestWithId(const Request& request) {
    const std::vector<Domain> domains = asked(request);
    if (domains.empty()) return noMastershipDomain(request);
    const int id = mastership_.requestWithId(domains, request);
    if (id == 0) return heldByOther();
    Document document;
    document.add("msh-resource", request.parameter("domain")).value("mastership-id", std::to_string(id));
    return Reply::of(std::move(document));
}

Reply MastershipResources::releaseWithId(const Request& request) {
    const std::vector<Domain> domains = asked(request);
    if (domains.empty()) return noMastershipDomain(request);
    // The reply of request-with-id spells it with a hyphen.
    const char* field = request.form.has("mastership-id") ? "mastership-id" : "mastershipid";
    const auto id = wholeIn(request.form.text(field), 1, INT32_MAX);
    if (!id || !mastership_.releaseWithId(domains, static_cast<int>(*id)))
        return badParameter("mastershipid", "the id that request-with-id gave");
    return Reply::done();
}

} // namespace rapidc::rws
