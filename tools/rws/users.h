#pragma once
// People at clients: who is logged on, their grants, and the privilege to modify in manual mode (RMMP).

#include "tools/rws/router.h"
#include "tools/rws/subscribable.h"
#include "tools/service/observers.h"

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>

namespace rapidc::rws {

class Users {
  public:
    /// The observers must outlive it.
    explicit Users(service::Observers& observers) : observers_(observers) {}
    void addTo(Router& router, Subscribables& subscribables);
    /// The session has the privilege to modify in manual mode.
    bool mayModify(uint64_t session) const { return privileged_.contains(session); }
    void sessionBegan(std::shared_ptr<const Session> session);
    void sessionEnded(uint64_t session);

  private:
    /// Data of a user as its client gave them (POST /users).
    struct Person {
        std::string alias, application, location, locale = "remote";
    };
    Reply registerPerson(const Request& request);
    Reply list(const Request& request) const;
    Reply loginInfo(const Request& request) const;
    Reply requestPrivilege(const Request& request);
    Reply setPrivilege(const Request& request);
    void grantPrivilege(const Session& session);
    Reply privilege(const Request& request) const;
    Reply poll(const Request& request) const;
    void addGrants(Router& router);
    void subscribe(Subscribables& subscribables);
    Person personOf(const Session& session) const;

    service::Observers& observers_;
    std::map<uint64_t, std::shared_ptr<const Session>> sessions_; ///< of both dialects, by number
    std::map<uint64_t, Person> people_;                           ///< by session
    std::map<uint64_t, std::string> names_;
    std::set<uint64_t> privileged_;
};

} // namespace rapidc::rws
