#pragma once
// Mastership: which client may change what. One table for both dialects (serve-contract 37): "edit" of RWS 2.0 is "cfg" and "rapid" of
// RWS 1.0. Write access of RobotWare 8's control stations is all of it.

#include "tools/rws/message.h"
#include "tools/service/observers.h"

#include <array>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

namespace rapidc::rws {

enum class Domain : uint8_t { Cfg, Rapid, Motion };

class Mastership {
  public:
    explicit Mastership(service::Observers& observers) : observers_(observers) {}

    struct Holder {
        uint64_t session = 0;    ///< 0: it has ended, and the mastership was requested with an id
        uint64_t connection = 0; ///< that it ends with (RWS 1.0); 0: none
        int id = 0;              ///< of request-with-id; 0: none
        std::string user, address;
    };
    /// Null: the domain is free.
    const Holder* holder(Domain domain) const;
    bool isHeldBy(Domain domain, uint64_t session) const;
    /// False when another client holds one of the domains; then nothing has changed.
    bool request(const std::vector<Domain>& domains, const Request& request);
    /// The same, until it is released with the id that is returned, also beyond the end of the session. 0: refused.
    int requestWithId(const std::vector<Domain>& domains, const Request& request);
    /// Releases what the session holds. False when another client holds one of the domains; then nothing has changed.
    bool release(const std::vector<Domain>& domains, uint64_t session);
    /// False when the domains are not held with this id.
    bool releaseWithId(const std::vector<Domain>& domains, int id);
    /// Releases everything, what was requested with an id too.
    void releaseAll();
    /// Each ends what belonged to it.
    void sessionEnded(uint64_t session);
    void connectionClosed(uint64_t connection);

  private:
    bool isFree(const std::vector<Domain>& domains, uint64_t session) const;
    template <class Ends> void drop(Ends ends);
    std::optional<Holder>& slot(Domain domain) { return holders_[static_cast<std::size_t>(domain)]; }

    service::Observers& observers_;
    std::array<std::optional<Holder>, 3> holders_;
};

} // namespace rapidc::rws
