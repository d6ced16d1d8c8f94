#include "tools/rws/front_door.h"

#include "config/letter_case.h"
#include "tools/rws/http_reply.h"

#include <fmt/format.h>

namespace rapidc::rws {

namespace {

constexpr const char* kSessionCookie = "-http-session-";
constexpr const char* kContextCookie = "ABBCX";

std::optional<Method> methodOf(const std::string& text) {
    if (text == "GET" || text == "HEAD") return Method::Get; // the server leaves out the body
    if (text == "POST") return Method::Post;
    if (text == "PUT") return Method::Put;
    if (text == "DELETE") return Method::Delete;
    return std::nullopt;
}

bool isLogout(const std::string& path) {
    return rapid::config::sameName(path, "/logout");
}

/// Replies whose form does not matter: files, and the end of a session.
bool hasFreeForm(const std::string& path) {
    constexpr std::string_view kFiles = "/fileservice";
    return isLogout(path) || rapid::config::sameName(std::string_view(path).substr(0, kFiles.size()), kFiles);
}

/// "/rw/rapid/symbol/data/RAPID/T_ROB1/user/reg1;value", as subscriptions and events name it, is read as the resource itself.
void dropSubscribedPart(std::string& path, std::vector<std::string>& segments) {
    if (segments.empty()) return;
    const std::size_t semicolon = segments.back().find(';');
    if (semicolon == std::string::npos || semicolon == 0) return;
    path.erase(path.size() - (segments.back().size() - semicolon));
    segments.back().erase(semicolon);
}

/// curl --digest sends the content of a form or a file only after a challenge, even if a cookie is enough to be logged on.
bool awaitsChallenge(const http::Head& head) {
    return (head.method == "POST" || head.method == "PUT") && head.length == 0 &&
           head.header("authorization").empty() &&
           rapid::config::beginsWithName(head.header("user-agent"), "curl/");
}

/// A handler may throw when it meets what it did not expect: the request is refused, the controller lives on.
Reply callHandler(const Handler& handler, const Request& request) {
    try {
        return handler(request);
    } catch (const std::exception& problem) {
        fmt::print(stderr, "rapidc serve: {}: {}\n", request.path, problem.what());
        return Reply::refuse(ReturnCode::Rejected, fmt::format("the request failed: {}", problem.what()),
                             400);
    }
}

} // namespace

/// One dialect, as the HTTP server sees it.
class FrontDoor::Side final : public http::Service {
  public:
    Side(FrontDoor& door, Dialect dialect) : door_(door), dialect_(dialect) {}

    http::Decision decide(const http::Head& head) override { return door_.decide(dialect_, head); }
    void handle(http::Request request, http::Respond respond) override {
        door_.handle(dialect_, request, respond);
    }
    void connectionEnded(uint64_t connection) override {
        door_.sessions_.connectionEnded(connection);
        if (door_.settings_.connectionEnded) door_.settings_.connectionEnded(connection);
    }
    http::Response refusal(int status, const std::string& reason) override {
        return errorResponse(status, reason, Form::Xhtml, {dialect_, "", "/"});
    }

  private:
    FrontDoor& door_;
    Dialect dialect_;
};

FrontDoor::FrontDoor(FrontDoorSettings settings, const Router& router)
    : settings_(std::move(settings)), router_(router), accounts_(settings_.password),
      sessions_([this](uint64_t number) {
          if (settings_.sessionEnded) settings_.sessionEnded(number);
      }) {
    settings_.password.clear();
    for (const Dialect dialect : {Dialect::V1, Dialect::V2})
        sides_[static_cast<std::size_t>(dialect)] = std::make_unique<Side>(*this, dialect);
}

FrontDoor::~FrontDoor() = default;

http::Service& FrontDoor::service(Dialect dialect) {
    return *sides_[static_cast<std::size_t>(dialect)];
}

void FrontDoor::countSockets(uint64_t session, int change) {
    Sessions::LoggedOn* found = sessions_.numbered(session);
    if (found == nullptr) return;
    found->sockets += change;
    found->used = Sessions::Clock::now();
}

void FrontDoor::endSessions() {
    settings_.postToNetwork([this, restarts = ++restarts_] { sessions_.endBefore(restarts); });
}

// ---- Before the body -----------------------------------------------------------------------------------------------

http::Decision FrontDoor::decide(Dialect dialect, const http::Head& head) {
    auto visit = std::make_shared<Visit>();
    http::Decision decision;
    decision.answer = admit(dialect, head, *visit);
    if (decision.answer) {
        for (const auto& cookie : visit->cookies)
            decision.answer->headers.push_back(cookie);
        return decision;
    }
    if (head.asksForSocket()) {
        int status = 404;
        decision.upgrade =
            sockets_ == nullptr ? std::nullopt : sockets_->upgrade(head, visit->path, visit->session, status);
        if (!decision.upgrade)
            decision.answer = errorResponse(status, "there is no event socket to open here", Form::Xhtml,
                                            contextOf(dialect, head, visit->path));
        return decision;
    }
    decision.context = std::move(visit);
    return decision;
}

/// None: RWS 2.0 has no form that the client accepts.
std::optional<Form> FrontDoor::askedForm(Dialect dialect, const http::Head& head, const Visit& visit) {
    if (dialect == Dialect::V2) return acceptedForm(head.header("accept"), visit.path);
    const auto json = std::find_if(visit.query.begin(), visit.query.end(), [](const auto& field) {
        return rapid::config::sameName(field.first, "json");
    });
    return json != visit.query.end() && json->second == "1" ? Form::Json : Form::Xhtml;
}

/// The response that ends a request before its body; none: it may continue.
std::optional<http::Response> FrontDoor::admit(Dialect dialect, const http::Head& head, Visit& visit) {
    const RenderContext plain = contextOf(dialect, head, "/");
    const auto refuse = [&](int status, const char* why) {
        return errorResponse(status, why, visit.form.value_or(Form::Xhtml), plain);
    };
    auto target = http::parseTarget(head.target);
    if (!target) return refuse(400, "the address is not well formed");
    visit.path = std::move(target->path);
    visit.segments = std::move(target->segments);
    visit.query = std::move(target->query);
    if (methodOf(head.method) == Method::Get && !hasFreeForm(visit.path))
        dropSubscribedPart(visit.path, visit.segments);
    const bool hasAction = std::any_of(visit.query.begin(), visit.query.end(), [](const auto& field) {
        return rapid::config::sameName(field.first, "action");
    });
    const bool changes =
        methodOf(head.method) != Method::Get || head.asksForSocket() || hasAction || isLogout(visit.path);
    if (changes && !http::hasOwnOrigin(head))
        return refuse(403, "pages of other servers may not change anything here");
    const bool asksForMethods = head.method == "OPTIONS";
    // Chosen before anything is refused, so that an error has the form that the client reads.
    visit.form = askedForm(dialect, head, visit);
    if (!asksForMethods && !methodOf(head.method)) return refuse(501, "the method is not supported");
    if (auto response = logOn(dialect, head, visit)) return response;
    if (dialect == Dialect::V1 || head.asksForSocket() || asksForMethods) return std::nullopt;
    if (visit.form == Form::Xhtml && asksForNewestMessages(visit.path, visit.query))
        visit.form = Form::TypedXhtml;
    // The App SDK leaves it to the browser for requests that change something.
    if (!visit.form && head.method != "GET" && head.method != "HEAD" &&
        acceptsAnything(head.header("accept")))
        visit.form = Form::Xhtml;
    if (!visit.form && !hasFreeForm(visit.path))
        return refuse(406, "Accept must name application/hal+json;v=2.0 or application/xhtml+xml;v=2.0");
    const bool hasContent = head.method == "POST" || head.method == "PUT";
    if (hasContent && !isAcceptedContent(head, visit.path))
        return refuse(415, "Content-Type must be application/x-www-form-urlencoded;v=2.0");
    return std::nullopt;
}

std::optional<http::Response> FrontDoor::logOn(Dialect dialect, const http::Head& head, Visit& visit) {
    const std::string cookie(head.cookie(kSessionCookie));
    sessions_.endBefore(restarts_);
    Sessions::LoggedOn* session = sessions_.find(cookie, dialect);
    if (session != nullptr && dialect == Dialect::V1 && awaitsChallenge(head))
        return challenge(dialect, false);
    const bool logsOn = session == nullptr;
    if (logsOn) {
        if (head.asksForSocket()) {
            http::Response response = challenge(dialect, false);
            return response;
        }
        bool stale = false, isBusy = false;
        const std::string_view authorization = head.header("authorization");
        const std::string user = dialect == Dialect::V1
                                     ? accounts_.checkDigest(authorization, head.method, head.target, stale)
                                     : accounts_.checkBasic(authorization, isBusy);
        if (isBusy)
            return errorResponse(503, "too many wrong passwords at a time: try again",
                                 visit.form.value_or(Form::Xhtml), contextOf(dialect, head, visit.path));
        if (user.empty()) return challenge(dialect, stale);
        // Clients of one process may share a connection: one that keeps cookies logs on for itself.
        const std::string proof =
            dialect == Dialect::V1 ? Accounts::digestNonce(authorization) : std::string();
        const std::string_view context = head.cookie(kContextCookie);
        if (!context.empty()) session = sessions_.ofContext(context, user, dialect);
        if (session == nullptr && cookie.empty())
            session = sessions_.ofConnection(head.connection, user, proof);
        if (session == nullptr) {
            session = sessions_.logOn(dialect, user, head.peer, head.connection, proof, restarts_);
            if (session == nullptr)
                return errorResponse(503, "too many sessions: log one off", visit.form.value_or(Form::Xhtml),
                                     contextOf(dialect, head, visit.path));
            if (settings_.sessionBegan) settings_.sessionBegan(session->session);
        }
    }
    // Clients take the cookies of an event socket from the reply that names it.
    if (logsOn || rapid::config::sameName(visit.path, "/subscription")) {
        visit.cookies.emplace_back("Set-Cookie",
                                   fmt::format("{}={}; path=/; httponly", kSessionCookie, session->cookie));
        visit.cookies.emplace_back("Set-Cookie",
                                   fmt::format("{}={}; path=/; httponly", kContextCookie, session->abbcx));
    }
    if (!Sessions::countRequest(*session))
        return errorResponse(503, "too many requests within a second", visit.form.value_or(Form::Xhtml),
                             contextOf(dialect, head, visit.path));
    visit.session = session->session;
    return std::nullopt;
}

http::Response FrontDoor::challenge(Dialect dialect, bool stale) {
    http::Response response = errorResponse(401, "log on first", Form::Xhtml, {dialect, "", "/"});
    response.headers.emplace_back("WWW-Authenticate", dialect == Dialect::V1
                                                          ? accounts_.digestChallenge(stale)
                                                          : Accounts::basicChallenge());
    return response;
}

// ---- After the body ------------------------------------------------------------------------------------------------

void FrontDoor::handle(Dialect dialect, http::Request& from, const http::Respond& respond) {
    const auto visit = std::static_pointer_cast<Visit>(from.context);
    if (!visit)
        return respond(errorResponse(400, "the request is not complete", Form::Xhtml, {dialect, "", "/"}));
    Request request;
    if (from.method == "OPTIONS") return respond(withHeaders(methodsOf(dialect, *visit), visit->cookies));
    if (auto response = complete(dialect, from, *visit, request)) return respond(std::move(*response));
    const RenderContext context{dialect, request.base, request.path};
    const Form form = visit->form.value_or(Form::Xhtml);
    if (isLogout(visit->path)) {
        sessions_.end(visit->session->number);
        http::Response response = responseTo(Reply::done(), form, context);
        return respond(std::move(response));
    }
    const Router::Match match = router_.find(request);
    if (match.route == nullptr && match.methodKnown) {
        const Reply reply = Reply::refuse(ReturnCode::BadParameter,
                                          fmt::format("there is no action '{}' here", request.action));
        return respond(withHeaders(responseTo(reply, form, context), visit->cookies));
    }
    if (match.route == nullptr) {
        Reply reply =
            Reply::refuse(ReturnCode::NotFound, fmt::format("there is no resource {}", request.path),
                          match.pathKnown ? 405 : 404);
        return respond(withHeaders(responseTo(reply, form, context), visit->cookies));
    }
    execute(*match.route, std::move(request), visit, respond);
}

/// The answer to OPTIONS: what a path takes.
http::Response FrontDoor::methodsOf(Dialect dialect, const Visit& visit) const {
    std::string allowed;
    for (const auto& [method, name] : {std::pair{Method::Get, "GET"}, std::pair{Method::Post, "POST"},
                                       std::pair{Method::Put, "PUT"}, std::pair{Method::Delete, "DELETE"}})
        if (router_.has(dialect, method, visit.segments)) allowed += std::string(name) + ",";
    if (allowed.empty())
        return errorResponse(404, "there is no resource " + visit.path, visit.form.value_or(Form::Xhtml),
                             {dialect, "", visit.path});
    http::Response response;
    response.status = 204;
    response.headers.emplace_back("Allow", allowed + "OPTIONS");
    return response;
}

std::optional<http::Response> FrontDoor::complete(Dialect dialect, http::Request& from, const Visit& visit,
                                                  Request& request) const {
    request.dialect = dialect;
    request.method = *methodOf(from.method);
    request.path = visit.path;
    request.segments = visit.segments;
    request.contentType = http::mediaTypeOf(from.header("content-type"));
    request.base = contextOf(dialect, from, visit.path).base;
    request.session = visit.session;
    request.connection = from.connection;
    for (const auto& [name, value] : visit.query) {
        if (dialect == Dialect::V1 && name == "action") request.action = value;
        request.query.add(name, value);
    }
    // PUT brings a form or the bytes of a file.
    const bool isFile =
        request.method == Method::Put &&
        (hasFreeForm(request.path) || request.contentType != "application/x-www-form-urlencoded");
    const bool isForm = !isFile && !from.body.empty();
    if (isForm) {
        const auto fields = http::parseFields(from.body);
        if (!fields)
            return errorResponse(400, "the form is not well formed", visit.form.value_or(Form::Xhtml),
                                 {dialect, request.base, request.path});
        for (const auto& [name, value] : *fields)
            request.form.add(name, value);
    }
    request.body = std::move(from.body);
    return std::nullopt;
}

void FrontDoor::execute(const Route& route, Request request, const std::shared_ptr<Visit>& visit,
                        const http::Respond& respond) {
    auto work = [this, &route, request = std::move(request), visit, respond] {
        const RenderContext context{request.dialect, request.base, request.path};
        if (hasEnded(*request.session)) { // the controller has restarted since
            return settings_.postToNetwork(
                [this, dialect = request.dialect, respond] { respond(challenge(dialect, false)); });
        }
        const auto reply = std::make_shared<Reply>(callHandler(route.handler, request));
        settings_.postToNetwork([context, reply, visit, respond] {
            if (!visit->form && reply->document) // of a folder: its form matters
                *reply = Reply::refuse(
                    ReturnCode::BadParameter,
                    "Accept must name application/hal+json;v=2.0 or application/xhtml+xml;v=2.0", 406);
            respond(
                withHeaders(responseTo(*reply, visit->form.value_or(Form::Xhtml), context), visit->cookies));
        });
    };
    if (route.where == Where::Controller)
        settings_.postToController(std::move(work));
    else if (!workers_.post(std::move(work)))
        respond(errorResponse(503, "too many requests wait for the disk", Form::Xhtml, {}));
}

} // namespace rapidc::rws
