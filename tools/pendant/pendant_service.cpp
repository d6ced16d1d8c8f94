#include "tools/pendant/pendant_service.h"

#include "config/json_text.h"
#include "config/letter_case.h"
#include "tools/http/crypto.h"

#include <fmt/format.h>

#include <algorithm>

namespace rapidc::pendant {

namespace {

constexpr int kMostSockets = 32;
constexpr std::size_t kLargestBody =
    std::size_t{64} * 1024; // nothing is sent to a page; bytes that are read and dropped
constexpr std::chrono::seconds kLockTime{1};
constexpr std::size_t kMostLocked = 1000;

constexpr const char* kContentPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; font-src 'self'; "
    "connect-src 'self'; worker-src 'self'; manifest-src 'self'; base-uri 'none'; form-action 'none'; "
    "frame-ancestors 'none'";

http::Response secured(http::Response response) {
    response.headers.emplace_back("Content-Security-Policy", kContentPolicy);
    response.headers.emplace_back("X-Content-Type-Options", "nosniff");
    response.headers.emplace_back("X-Frame-Options", "DENY");
    response.headers.emplace_back("Referrer-Policy", "no-referrer");
    response.headers.emplace_back("Cross-Origin-Opener-Policy", "same-origin");
    response.headers.emplace_back("Cross-Origin-Resource-Policy", "same-origin");
    response.headers.emplace_back("Cache-Control", "no-cache");
    return response;
}

http::Response plain(int status, const std::string& text) {
    return secured(http::Response::text(status, text + "\n"));
}

bool isLoopback(std::string_view peer) {
    return peer.starts_with("127.") || peer == "::1" || peer.starts_with("::ffff:127.");
}

std::string_view pathOf(std::string_view target) {
    return target.substr(0, target.find('?'));
}

} // namespace

/// A socket at /api. It hands requests to the controller's thread.
class PendantService::Socket final : public http::SocketListener {
  public:
    Socket(PendantService& service, std::string peer)
        : service_(service), sockets_(service.sockets_), peer_(std::move(peer)) {}
    ~Socket() override { --*sockets_; }
    Socket(const Socket&) = delete;
    Socket& operator=(const Socket&) = delete;

    void opened(std::shared_ptr<http::WebSocket> socket) override {
        const bool needsLogin = !isLoopback(peer_) && !service_.settings_.password.empty();
        client_ = std::make_shared<Client>(std::move(socket), peer_, needsLogin);
        service_.controller_.post([&hub = service_.hub_, client = client_] { hub.add(client); });
    }

    void received(std::string message, bool isText) override {
        if (!isText) return client_->close(http::CloseCode::ProtocolError, "messages are texts");
        Json request = rapid::config::tryParseJson(message);
        if (!request.is_object())
            return client_->refuse(nullptr, {code::kBadRequest, "The message is not a JSON object"});
        const auto id = request.find("id");
        if (id == request.end() || !id->is_number_unsigned() || id->get<uint64_t>() > (uint64_t{1} << 53))
            return client_->refuse(nullptr, {code::kBadRequest, "id must be a whole number"});
        if (!client_->beginRequest())
            return client_->refuse(*id,
                                   {code::kBusy, "Too many requests wait for an answer", "Send it later"});
        auto shared = std::make_shared<const Json>(std::move(request));
        service_.controller_.post(
            [&hub = service_.hub_, client = client_, shared] { hub.handle(client, shared); });
    }

    void closed() override {
        if (client_)
            service_.controller_.post([&hub = service_.hub_, client = client_] { hub.remove(client); });
    }

  private:
    PendantService& service_;
    const std::shared_ptr<std::atomic<int>> sockets_; ///< outlives the service
    const std::string peer_;
    std::shared_ptr<Client> client_;
};

PendantService::PendantService(const Shared& shared, PendantSettings settings)
    : controller_(shared.controller), settings_(std::move(settings)), hub_(shared) {
    hub_.setPasswordCheck([this](const Client& client, const std::string& password) {
        return checkPassword(client, password);
    });
}

PendantService::~PendantService() = default;

void PendantService::tick() {
    hub_.tick();
}

/// A name of another owner could lead here: only addresses, localhost, and the port of the page.
bool PendantService::isOwnHost(const http::Head& head) const {
    if (head.count("Host") != 1 || !hasSafeHost(head)) return false;
    const std::string_view host = head.header("Host");
    const std::string port = fmt::format(":{}", port_);
    const bool hasPort = host.ends_with(port) || (port_ == 80 && host.find(':') == std::string_view::npos);
    if (!hasPort) return false;
    if (!isLoopback(settings_.address)) return true; // any address of this computer may be meant
    const std::string_view name = host.substr(0, host.size() - (host.ends_with(port) ? port.size() : 0));
    return rapid::config::sameName(name, "localhost") || name == "127.0.0.1" || name == "[::1]" ||
           name == settings_.address;
}

http::Decision PendantService::decide(const http::Head& head) {
    http::Decision decision;
    decision.bodyLimit = kLargestBody;
    const std::string_view path = pathOf(head.target);
    if (!isOwnHost(head))
        decision.answer = plain(403, fmt::format("This page is at http://{}:{}/", settings_.address, port_));
    else if (!hasOwnOrigin(head))
        decision.answer = plain(403, "Requests of other pages are refused");
    else if (path == "/api" && head.asksForSocket())
        return decideSocket(head);
    else if (path == "/api")
        decision.answer = plain(426, "This address is a WebSocket");
    else if (head.method != "GET" && head.method != "HEAD")
        decision.answer = plain(405, "Only GET is possible here");
    return decision;
}

http::Decision PendantService::decideSocket(const http::Head& head) {
    http::Decision decision;
    decision.bodyLimit = kLargestBody;
    if (!head.header("Sec-WebSocket-Protocol").empty()) {
        decision.answer = plain(400, "This WebSocket has no subprotocol");
        return decision;
    }
    if (sockets_->fetch_add(1) >= kMostSockets) {
        --*sockets_;
        decision.answer = plain(503, "Too many pages are open");
        return decision;
    }
    decision.upgrade = http::Upgrade{{}, {}, std::make_shared<Socket>(*this, head.peer)};
    return decision;
}

void PendantService::handle(http::Request request, http::Respond respond) {
    const std::string_view path = pathOf(request.target);
    const auto found = std::find_if(settings_.files.begin(), settings_.files.end(),
                                    [&](const PageFile& file) { return file.path == path; });
    if (found == settings_.files.end()) return respond(plain(404, "There is no such file"));
    const bool takesGzip = request.header("Accept-Encoding").find("gzip") != std::string_view::npos;
    const bool sendsGzip = found->isCompressed && takesGzip;
    http::Response response = http::Response::text(
        200, sendsGzip ? std::string(found->bytes) : plainBytes(*found), std::string(found->type));
    if (found->isCompressed) response.headers.emplace_back("Vary", "Accept-Encoding");
    if (sendsGzip) response.headers.emplace_back("Content-Encoding", "gzip");
    respond(secured(std::move(response)));
}

http::Response PendantService::refusal(int status, const std::string& reason) {
    return plain(status, reason);
}

std::string PendantService::checkPassword(const Client& client, const std::string& password) {
    const auto now = std::chrono::steady_clock::now();
    const auto locked = locked_.find(client.peer());
    if (locked != locked_.end() && now < locked->second) return "The password was wrong: wait a second";
    if (http::equalSecrets(http::sha256(password), http::sha256(settings_.password))) return {};
    if (locked_.size() >= kMostLocked) locked_.clear();
    locked_[client.peer()] = now + kLockTime;
    return "The password is wrong";
}

} // namespace rapidc::pendant
