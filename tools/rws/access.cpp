#include "tools/rws/access.h"

#include "config/letter_case.h"

namespace rapidc::rws {

std::optional<Failure> Access::refusal(const Request& request, Domain domain) const {
    const uint64_t session = request.session->number;
    const bool isManual = controller_.panel().mode != service::OperatingMode::Auto;
    if (isManual && domain != Domain::Motion && !users_.mayModify(session))
        return Failure{ReturnCode::NoGrant,
                       "In manual mode, changes need the privilege that POST /users/rmmp gives"};
    const bool isMine = mastership_.isHeldBy(domain, session);
    if (isMine && (request.dialect == Dialect::V1 || controller_.settings().robotWare < 8))
        return std::nullopt;
    const bool isOthers = !isMine && mastership_.holder(domain) != nullptr;
    if (request.dialect == Dialect::V2 && controller_.settings().robotWare >= 8)
        return stations_.refusal(session, isMine, isOthers);
    if (isOthers) return Failure{ReturnCode::HeldByOther, "Another client holds the mastership"};
    const bool isImplicit = rapid::config::sameName(request.query.text("mastership"), "implicit");
    if (request.dialect == Dialect::V1 || isImplicit) return std::nullopt;
    return Failure{ReturnCode::NoMastership, domain == Domain::Motion
                                                 ? "Request the mastership of motion first"
                                                 : "Request the mastership of edit first"};
}

Handler Access::guarded(Domain domain, Handler handler) const {
    return [this, domain, handler = std::move(handler)](const Request& request) {
        if (const std::optional<Failure> failure = refusal(request, domain)) return Reply::refuse(*failure);
        return handler(request);
    };
}

Handler Access::shared(Domain domain, Handler handler) const {
    return [this, domain, handler = std::move(handler)](const Request& request) {
        const std::optional<Failure> failure = refusal(request, domain);
        const bool isKeptOut = failure && failure->code != ReturnCode::NoMastership;
        return isKeptOut ? Reply::refuse(*failure) : handler(request);
    };
}

} // namespace rapidc::rws
