#include "tools/rapidc/serve/serving.h"

#include "tools/http/tls.h"
#include "tools/rws/folders.h"

#include <chrono>
#include <cstdio>
#include <fmt/format.h>

namespace rapidc::serve {

namespace {

constexpr auto kPrompt =
    std::chrono::milliseconds(100); ///< a fourth of the time that common clients wait for an answer
constexpr auto kLongestWait =
    std::chrono::seconds(15); ///< clients that start the controller wait 20 s for its addresses
constexpr int kPromptCommands = 2;

std::string hostOf(const ServeSettings& settings) {
    return settings.address == "0.0.0.0" ? "127.0.0.1" : settings.address;
}

} // namespace

Serving::Serving(const ServeSettings& settings, service::VirtualController& controller)
    : settings_(settings), controller_(controller), rapid_(controller), plant_(controller, rapid_.access()),
      subscriptions_(
          subscribables_, [this](std::function<void()> work) { controller_.post(std::move(work)); },
          [this](std::function<void()> work) { server_.post(std::move(work)); }),
      pendant_({controller, plant_.journal(), rapid_.breakpoints(), plant_.manualMotion(),
                plant_.configuration(), plant_.volumes()},
               {.password = settings.password, .address = settings.address}) {
    rws::addFolders(router_); // first: services may describe their folder themselves
    rapid_.addTo(router_, subscribables_);
    plant_.addTo(router_, subscribables_);
    subscriptions_.addTo(router_);
    rws::FrontDoorSettings door;
    door.password = settings.password;
    door.postToController = [this](std::function<void()> work) { controller_.post(std::move(work)); };
    door.postToNetwork = [this](std::function<void()> work) { server_.post(std::move(work)); };
    door.sessionBegan = [this](std::shared_ptr<const rws::Session> session) {
        controller_.post([this, session = std::move(session)] { rapid_.sessionBegan(session); });
    };
    door.sessionEnded = [this](uint64_t session) {
        controller_.post([this, session] {
            subscriptions_.sessionEnded(session);
            rapid_.sessionEnded(session);
        });
    };
    door.connectionEnded = [this](uint64_t connection) {
        controller_.post([this, connection] { rapid_.connectionClosed(connection); });
    };
    door_ = std::make_unique<rws::FrontDoor>(std::move(door), router_);
    door_->setSockets(&subscriptions_);
    service::Observer observer;
    observer.changed = [this](service::Change change, const rt::Task*) {
        if (change != service::Change::Restart) return;
        rapid_.controllerRestarts();
        door_->endSessions();
    };
    observer_ = controller_.observers().add(std::move(observer));
    subscriptions_.onSockets([this](uint64_t session, int change) { door_->countSockets(session, change); });
}

Serving::~Serving() {
    server_.stop();
    controller_.observers().remove(observer_);
}

std::string Serving::listen(const char* option, http::Endpoint endpoint, uint16_t& port) {
    const std::string problem = server_.listen(endpoint, port);
    return problem.empty() ? problem : fmt::format("{}={}: {}", option, endpoint.port, problem);
}

std::string Serving::open() {
    std::string problem;
    const std::string folder = certificateFolderOf(settings_, problem);
    if (!problem.empty()) return problem;
    auto identity = http::TlsIdentity::make(folder, {settings_.address}, problem);
    if (!identity && settings_.certificateFolder.empty())
        identity = http::TlsIdentity::make("", {settings_.address}, problem);
    if (!identity) return problem;
    plant_.setCertificate(identity->certificate());
    const std::string& address = settings_.address;
    problem =
        listen("--http-port",
               {.address = address, .port = settings_.httpPort, .service = &door_->service(rws::Dialect::V1)},
               httpPort_);
    if (problem.empty())
        problem = listen("--https-port",
                         {.address = address,
                          .port = settings_.httpsPort,
                          .tls = identity,
                          .service = &door_->service(rws::Dialect::V2)},
                         httpsPort_);
    if (problem.empty())
        problem = listen("--web-port", {.address = address, .port = settings_.webPort, .service = &pendant_},
                         webPort_);
    pendant_.setPort(webPort_);
    return problem;
}

void Serving::start() {
    server_.every(std::chrono::seconds(1), [this] { door_->tick(); });
    server_.every(std::chrono::milliseconds(20), [this] {
        subscriptions_.tick();
        announceWhenPrompt();
    });
    server_.every(std::chrono::milliseconds(200), [this] {
        controller_.post([this] { controller_.observers().changed(service::Change::Interval); });
    });
    server_.every(pendant::PendantService::kTick, [this] { pendant_.tick(); });
    const std::string host = hostOf(settings_);
    subscriptions_.setBase(rws::Dialect::V1, fmt::format("http://{}:{}", host, httpPort_));
    subscriptions_.setBase(rws::Dialect::V2, fmt::format("https://{}:{}", host, httpsPort_));
    started_ = std::chrono::steady_clock::now();
    server_.start();
}

void Serving::announceWhenPrompt() {
    if (isAnnounced_) return;
    if (prompt_ >= kPromptCommands || std::chrono::steady_clock::now() - started_ > kLongestWait)
        return announce();
    if (asked_.exchange(true)) return;
    controller_.post([this, posted = std::chrono::steady_clock::now()] {
        prompt_ = std::chrono::steady_clock::now() - posted < kPrompt ? prompt_ + 1 : 0;
        asked_ = false;
    });
}

void Serving::announce() {
    isAnnounced_ = true;
    const std::string host = hostOf(settings_);
    fmt::print("{{\"http\":\"http://{0}:{1}\",\"https\":\"https://{0}:{2}\",\"web\":\"http://{0}:{3}\"}}\n",
               host, httpPort_, httpsPort_, webPort_);
    std::fflush(stdout);
}

} // namespace rapidc::serve
