#include "tools/rws/users.h"

#include "config/letter_case.h"
#include "tools/rws/rapid_support.h"
#include "tools/rws/request_values.h"
#include "tools/rws/state_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

namespace rapidc::rws {

namespace {

constexpr std::size_t kLongest = 80; // bytes of what a client says about its user

struct Grant {
    const char *name, *display, *text;
};
/// Both users have all of them (serve-contract 8).
constexpr Grant kGrants[] = {
    {"UAS_FULL_ACCESS", "Full access", "Full access to the controller"},
    {"UAS_MANAGE_SETTINGS", "Manage UAS settings", "Change users, grants and roles"},
    {"UAS_RAPID_EXECUTE", "Execute program", "Start and stop programs, move the program pointer"},
    {"UAS_RAPID_MODPOS", "Perform ModPos and HotEdit", "Modify positions"},
    {"UAS_RAPID_CURRVALUE", "Modify current value", "Change values of RAPID data"},
    {"UAS_RAPID_DEBUG", "Program debug", "Set breakpoints and step"},
    {"UAS_RAPID_LOADPROGRAM", "Load program", "Load and unload programs and modules"},
    {"UAS_RAPID_EDIT", "Edit RAPID code", "Change the text of modules"},
    {"UAS_IO_WRITE", "I/O write access", "Set and simulate signals"},
    {"UAS_CFG_WRITE", "Modify configuration", "Change system parameters"},
    {"UAS_CONTROLLER_PROPERTIES_WRITE", "Modify controller properties", "Change name, identity and time"},
    {"UAS_CTRL_PANEL_WRITE", "Control panel", "Motors, mode and speed"},
    {"UAS_SPEED_DECREASE", "Decrease of production speed", "Lower the speed in automatic mode"},
    {"UAS_BACKUP", "Backup and save", "Write backups"},
    {"UAS_RESTORE", "Restore a backup", "Read backups"},
    {"UAS_FTP_READ", "Read access to controller disks", "Read files"},
    {"UAS_FTP_WRITE", "Write access to controller disks", "Write files"},
    {"UAS_REMOTE_LOGIN", "Remote login", "Log on from another computer"},
    {"UAS_REMOTE_WARMSTART", "Remote warm start", "Restart the controller from another computer"},
    {"UAS_REMOTE_START_STOP_IN_AUTO", "Remote start and stop in auto",
     "Start and stop from another computer"},
};

} // namespace

Users::Person Users::personOf(const Session& session) const {
    const auto found = people_.find(session.number);
    Person person;
    if (found != people_.end()) person = found->second;
    if (person.alias.empty()) person.alias = session.user;
    if (person.application.empty()) person.application = "RobotWebServices";
    if (person.location.empty()) person.location = session.address;
    return person;
}

void Users::subscribe(Subscribables& subscribables) {
    subscribables.add({"/users/rmmp", "", false, std::nullopt,
                       [this](const Request&, const Changed& changed, Subscription& out) {
                           const auto read = [this] {
                               const auto holder =
                                   privileged_.empty() ? names_.end() : names_.find(*privileged_.begin());
                               const bool isHeld = holder != names_.end();
                               Entry entry;
                               entry.type = "user-rmmp-ev";
                               entry.title = "rmmp";
                               entry.value("userid", isHeld ? std::to_string(holder->first) : "0")
                                   .value("alias", isHeld ? holder->second : "")
                                   .value("privilege", isHeld ? "modify" : "none");
                               return entry;
                           };
                           return watchState(observers_, {service::Change::Interval}, read, changed, out);
                       }});
}

void Users::addTo(Router& router, Subscribables& subscribables) {
    subscribe(subscribables);
    router.getBoth("/users", [this](const Request& request) { return list(request); });
    router.postBoth("/users", [this](const Request& request) {
        Reply reply = registerPerson(request);
        if (request.dialect == Dialect::V1 && reply.status == 200) reply.status = 201;
        return reply;
    });
    router.action("/users", "set-locale", [this](const Request& request) { return registerPerson(request); });
    router.action("/users", "impersonate", [](const Request&) {
        return Reply::refuse(ReturnCode::Rejected, "A client cannot take the place of another user");
    });
    router.post(Dialect::V2, "/users/register",
                [this](const Request& request) { return registerPerson(request); });
    for (const char* locale : {"local", "remote"}) // the path says where the person is
        router.post(Dialect::V2, std::string("/users/register/") + locale,
                    [this, locale](const Request& request) {
                        Request placed = request;
                        placed.form.add("ulocale", locale);
                        return registerPerson(placed);
                    });
    router.get(Dialect::V2, "/users/login-info",
               [this](const Request& request) { return loginInfo(request); });
    router.getBoth("/users/rmmp", [this](const Request& request) { return privilege(request); });
    router.postBoth("/users/rmmp", [this](const Request& request) { return requestPrivilege(request); });
    router.getBoth("/users/rmmp/poll", [this](const Request& request) { return poll(request); });
    addOrder(router, "/users/rmmp", "cancel", "cancel", [this](const Request& request) {
        privileged_.erase(request.session->number);
        return Reply::done();
    });
    router.action("/users/rmmp", "set", [this](const Request& request) { return setPrivilege(request); });
    addGrants(router);
}

void Users::addGrants(Router& router) {
    const auto held = [](const Request& request) {
        const bool old = request.dialect == Dialect::V1;
        Document document;
        for (const Grant& grant : kGrants)
            document.add(old ? "user-grant" : "uas-grant", grant.name)
                .value("grantname", grant.name)
                .value("description", grant.text);
        return Reply::of(std::move(document));
    };
    router.getBoth("/users/grants", held);
    router.get(Dialect::V2, "/uas/user/grants", held);
    router.get(Dialect::V2, "/uas/grants", [](const Request&) {
        Document document;
        for (const Grant& grant : kGrants)
            document.add("grant-info", grant.name)
                .value("grant-name", grant.name)
                .value("display-name", grant.display)
                .value("grant-description", grant.text);
        return Reply::of(std::move(document));
    });
    router.get(Dialect::V2, "/users/grant-exists", [](const Request& request) {
        const std::string name = request.query.text("grant");
        const auto* found = std::find_if(std::begin(kGrants), std::end(kGrants), [&](const Grant& grant) {
            return rapid::config::sameName(grant.name, name);
        });
        if (found == std::end(kGrants)) return badParameter("grant", "the name of a grant of /uas/grants");
        Document document;
        document.add("user-grant-status", found->name).value("status", "true");
        return Reply::of(std::move(document));
    });
    router.get(Dialect::V2, "/uas/user/password-change-allow", [](const Request&) {
        Document document;
        document.add("uas-password-change-allow", "password-change-allow").value("status", "false");
        return Reply::of(std::move(document));
    });
    router.post(Dialect::V2, "/uas/user/password", [](const Request&) {
        return Reply::refuse(ReturnCode::Rejected, "Passwords are options of rapidc serve", 403);
    });
    router.get(Dialect::V2, "/uas/ldap", [](const Request&) {
        Document document;
        for (const char* part :
             {"enabled", "searchpassword", "configuration", "settings", "certificate", "verify"})
            document.add(fmt::format("uas-ldap-{}-li", part), part).self = fmt::format("/uas/ldap/{}", part);
        return Reply::of(std::move(document));
    });
    router.get(Dialect::V2, "/uas/ldap/{name}", [](const Request&) {
        return Reply::refuse(ReturnCode::NoGrant, "Option is missing: LDAP", 403);
    });
    router.get(Dialect::V2, "/uas/users/{user}/roles", [](const Request& request) {
        if (!rapid::config::sameName(request.parameter("user"), request.session->user))
            return Reply::refuse(ReturnCode::NotFound, "There is no such user");
        Document document;
        document.add("user-role", "Administrator").value("rolename", "Administrator");
        return Reply::of(std::move(document));
    });
    router.get(Dialect::V2, "/uas", [](const Request&) {
        return folder({{"uas-grants-li", "grants"}, {"uas-user-li", "user/grants"}});
    });
}

/// One entry for each session of the controller.
Reply Users::list(const Request& request) const {
    Document document;
    auto sessions = sessions_;
    sessions.emplace(request.session->number, request.session);
    for (const auto& [number, session] : sessions) {
        const Person person = personOf(*session);
        document.add("user-li", session->user)
            .value("user-name", session->user)
            .value("user-alias", person.alias)
            .value("user-locale", person.locale)
            .value("user-application", person.application)
            .value("user-location", person.location);
    }
    const auto link = [&](const char* type, const char* title) { document.add(type, title).self = title; };
    link("user-grants-li", "grants");
    link("user-rmmp-li", "rmmp");
    if (request.dialect == Dialect::V2) link("user-login-info-li", "login-info");
    return Reply::of(std::move(document));
}

/// With a body, because clients take no 204 (controller.md 8).
Reply Users::registerPerson(const Request& request) {
    Person person = personOf(*request.session);
    const auto take = [&](const char* name, std::string& into) {
        if (request.form.has(name)) into = request.form.text(name);
        return into.size() <= kLongest;
    };
    const bool fits = take("username", person.alias) && take("application", person.application) &&
                      take("location", person.location) && take("ulocale", person.locale);
    if (!fits) return badParameter("username, application or location", "at most 80 characters");
    if (!rapid::config::sameName(person.locale, "local")) person.locale = "remote";
    people_[request.session->number] = person;
    Document document;
    document.add("user-registration", request.session->user)
        .value("user-name", request.session->user)
        .value("user-alias", person.alias)
        .value("user-locale", person.locale)
        .value("user-application", person.application)
        .value("user-location", person.location);
    return Reply::of(std::move(document));
}

Reply Users::loginInfo(const Request& request) const {
    const Person person = personOf(*request.session);
    Document document;
    document.add("user-login-info", "login-info")
        .value("uas-id", std::to_string(request.session->number))
        .value("user-name", request.session->user)
        .value("user-alias", person.alias)
        .value("user-locale", person.locale)
        .value("user-application", person.application)
        .value("user-location", person.location);
    return Reply::of(std::move(document));
}

Reply Users::requestPrivilege(const Request& request) {
    const std::string level = request.form.text("privilege");
    constexpr const char* kLevels[] = {"modify", "exec", "exclusive"};
    if (std::none_of(std::begin(kLevels), std::end(kLevels),
                     [&](const char* each) { return rapid::config::sameName(each, level); }))
        return badParameter("privilege", "modify or exec");
    grantPrivilege(*request.session);
    return Reply::done(202);
}

/// Grants the privilege to the user with that number, or withdraws it, as an operator does on the FlexPendant.
Reply Users::setPrivilege(const Request& request) {
    const std::string level = request.form.text("privilege");
    const auto is = [&](const char* each) { return rapid::config::sameName(each, level); };
    if (!is("modify") && !is("exec") && !is("deny")) return badParameter("privilege", "modify, exec or deny");
    const auto number = wholeIn(request.form.text("uid"), 1, std::numeric_limits<int64_t>::max());
    const auto session = number ? sessions_.find(static_cast<uint64_t>(*number)) : sessions_.end();
    if (session == sessions_.end()) return badParameter("uid", "the userid of GET /users/rmmp");
    if (is("deny"))
        privileged_.erase(session->first);
    else
        grantPrivilege(*session->second);
    return Reply::done();
}

void Users::grantPrivilege(const Session& session) {
    privileged_.insert(session.number);
    names_[session.number] = session.user;
}

Reply Users::privilege(const Request& request) const {
    const bool isMine = mayModify(request.session->number);
    const auto holder = isMine                ? names_.find(request.session->number)
                        : privileged_.empty() ? names_.end()
                                              : names_.find(*privileged_.begin());
    const bool isHeld = holder != names_.end();
    Document document;
    document.add("user-rmmp", "rmmp")
        .value("userid", isHeld ? std::to_string(holder->first) : "0")
        .value("alias", isHeld ? holder->second : "")
        .value("privilege", isHeld ? "modify" : "none")
        .value("rmmpheldbyme", boolText(isMine));
    return Reply::of(std::move(document));
}

Reply Users::poll(const Request& request) const {
    const bool isMine = mayModify(request.session->number);
    Document document;
    document.add("user-rmmp-poll", "poll")
        .value("code", isMine ? "2" : "0")
        .value("status", isMine ? "GRANTED" : "NO SUCH REQUEST");
    return Reply::of(std::move(document));
}

void Users::sessionBegan(std::shared_ptr<const Session> session) {
    const uint64_t number = session->number;
    sessions_[number] = std::move(session);
}

void Users::sessionEnded(uint64_t session) {
    sessions_.erase(session);
    people_.erase(session);
    names_.erase(session);
    privileged_.erase(session);
}

} // namespace rapidc::rws
