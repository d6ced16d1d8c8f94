#include "tools/pendant/pendant_service.h"
#include "unit/temporary_folder.h"

#include "tools/service/breakpoint_list.h"
#include "tools/service/configuration_store.h"
#include "tools/service/event_journal.h"
#include "tools/service/file_volumes.h"
#include "tools/service/manual_motion.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

using namespace rapidc;
using namespace rapidc::pendant;

namespace {

/// The browser's end of a socket.
class Browser final : public http::WebSocket {
  public:
    void send(std::shared_ptr<const std::string> text) override {
        const std::lock_guard lock(mutex_);
        messages_.push_back(*text);
        arrived_.notify_all();
    }
    void close(http::CloseCode code, std::string) override {
        const std::lock_guard lock(mutex_);
        closed_ = static_cast<int>(code);
    }
    std::size_t waitingBytes() const override { return waiting.load(); }

    /// The answer to the request with that id; null after ten seconds without one.
    Json answer(int id) {
        std::unique_lock lock(mutex_);
        for (std::size_t i = 0;; ++i) {
            if (!arrived_.wait_for(lock, std::chrono::seconds(10), [&] { return messages_.size() > i; }))
                return nullptr;
            Json message = Json::parse(messages_[i]);
            if (message.value("id", Json()) == Json(id)) return message;
        }
    }
    std::size_t count(const std::string& event) {
        const std::lock_guard lock(mutex_);
        std::size_t found = 0;
        for (const std::string& each : messages_)
            found += Json::parse(each).value("event", "") == event ? 1 : 0;
        return found;
    }
    int closed() {
        const std::lock_guard lock(mutex_);
        return closed_;
    }

    std::atomic<std::size_t> waiting{0};

  private:
    std::mutex mutex_;
    std::condition_variable arrived_;
    std::deque<std::string> messages_;
    int closed_ = 0;
};

/// A stopped controller with the service of its page; "network" is the thread of the test.
class Served {
  public:
    Served() {
        folder_.write("Waiting.modx",
                      "MODULE Waiting\n  PROC main()\n    WaitTime 1;\n  ENDPROC\nENDMODULE\n");
        service::Settings settings;
        settings.inputs.paths = {(folder_.path / "Waiting.modx").string()};
        settings.programStart = false;
        controller_ = std::make_unique<service::VirtualController>(std::move(settings));
        REQUIRE(controller_->open() == rt::ExitStatus::Ended);
        journal_ = std::make_unique<service::EventJournal>(*controller_);
        manual_ = std::make_unique<service::ManualMotion>(*controller_);
        configuration_ = std::make_unique<service::ConfigurationStore>(*controller_, folder_.path.string());
        breakpoints_ = std::make_unique<service::BreakpointList>(*controller_);
        const Shared shared{*controller_, *journal_, *breakpoints_, *manual_, *configuration_, volumes_};
        service = std::make_unique<PendantService>(
            shared, PendantSettings{.files = fallbackPage(), .password = "secret", .address = "0.0.0.0"});
        service->setPort(8080);
        thread_ = std::thread([this] { controller_->run(); });
    }
    ~Served() {
        controller_->shutDown();
        thread_.join();
        service.reset(); // before what it uses
    }
    Served(const Served&) = delete;
    Served& operator=(const Served&) = delete;

    http::Head head(const std::string& peer, const std::string& host, bool isSocket = true) const {
        http::Head head;
        head.method = "GET";
        head.target = isSocket ? "/api" : "/";
        head.headers = {{"Host", host}};
        if (isSocket) head.headers.emplace_back("Upgrade", "websocket");
        head.peer = peer;
        return head;
    }
    std::shared_ptr<http::SocketListener> open(const std::string& peer,
                                               const std::shared_ptr<Browser>& browser) const {
        http::Decision decision = service->decide(head(peer, "192.168.1.4:8080"));
        REQUIRE(decision.upgrade);
        decision.upgrade->listener->opened(browser);
        return decision.upgrade->listener;
    }

    std::unique_ptr<PendantService> service;

  private:
    TemporaryFolder folder_;
    std::unique_ptr<service::VirtualController> controller_;
    std::unique_ptr<service::EventJournal> journal_;
    std::unique_ptr<service::BreakpointList> breakpoints_;
    std::unique_ptr<service::ManualMotion> manual_;
    service::FileVolumes volumes_;
    std::unique_ptr<service::ConfigurationStore> configuration_;
    std::thread thread_;
};

} // namespace

TEST_CASE("pendant: a page on another computer needs the password (contract 7)", "[pendant]") {
    const Served served;
    const auto browser = std::make_shared<Browser>();
    const auto socket = served.open("192.168.1.9", browser);
    socket->received(R"({"id":1,"method":"state"})", true);
    CHECK(browser->answer(1).at("error").at("code") == "login");
    socket->received(R"({"id":2,"method":"hello"})", true);
    CHECK(browser->answer(2).at("error").at("code") == "login");
    socket->received(R"({"id":3,"method":"hello","params":{"password":"robotics"}})", true);
    CHECK(browser->answer(3).at("error").at("code") == "login");
    // the right one counts once a second has passed
    socket->received(R"({"id":4,"method":"hello","params":{"password":"secret"}})", true);
    CHECK(browser->answer(4).at("error").at("message") == "The password was wrong: wait a second");
    // from another computer it counts at once
    const auto second = std::make_shared<Browser>();
    const auto other = served.open("192.168.1.10", second);
    other->received(R"({"id":1,"method":"hello","params":{"password":"secret"}})", true);
    CHECK(second->answer(1).at("result").at("loginNeeded") == true);
    other->received(R"({"id":2,"method":"state"})", true);
    CHECK(second->answer(2).at("result").contains("panel"));
}

TEST_CASE("pendant: a page on this computer needs no password", "[pendant]") {
    const Served served;
    for (const char* peer : {"127.0.0.1", "::1", "::ffff:127.0.0.1"}) {
        const auto browser = std::make_shared<Browser>();
        const auto socket = served.open(peer, browser);
        socket->received(R"({"id":1,"method":"hello"})", true);
        CHECK(browser->answer(1).at("result").at("loginNeeded") == false);
        socket->closed();
    }
}

TEST_CASE(
    "pendant: with --listen any address of the computer is its name, but no name of others (contract 17)",
    "[pendant]") {
    const Served served;
    for (const char* host : {"192.168.1.4:8080", "localhost:8080", "[fe80::1]:8080", "127.0.0.1:8080"})
        CHECK_FALSE(served.service->decide(served.head("10.0.0.1", host, false)).answer);
    for (const char* host : {"evil.example:8080", "192.168.1.4:81", "192.168.1.4", ""}) {
        const http::Decision decision = served.service->decide(served.head("10.0.0.1", host, false));
        REQUIRE(decision.answer);
        CHECK(decision.answer->status == 403);
    }
}

TEST_CASE("pendant: panel notifications come after a change, binary messages close the socket", "[pendant]") {
    const Served served;
    const auto browser = std::make_shared<Browser>();
    const auto socket = served.open("127.0.0.1", browser);
    socket->received(R"({"id":1,"method":"hello"})", true);
    socket->received(R"({"id":2,"method":"panel.speed","params":{"percent":50}})", true);
    CHECK(browser->answer(2).at("result").at("speed") == 50);
    served.service->tick();
    socket->received(R"({"id":3,"method":"state"})", true); // after the flush, which was posted before
    CHECK(browser->answer(3).at("result").at("panel").at("speed") == 50);
    CHECK(browser->count("panel") == 1);
    socket->received("x", false);
    CHECK(browser->closed() == 1002);
}
