#pragma once
// A controller that executes a program on a thread of its own, and the resources around RAPID, without HTTP.

#include "tools/rws/path_pattern.h"
#include "tools/rws/rapid_services.h"
#include "unit/temporary_folder.h"

#include <chrono>
#include <future>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace rapidc::rws {

using FieldList = std::vector<std::pair<std::string, std::string>>;

inline constexpr const char* kProgram = R"(MODULE Main1
   RECORD part
      string name;
      pos place;
   ENDRECORD
   CONST num size := 3;
   PERS num count := 5;
   PERS string text := "abc";
   VAR bool flag := TRUE;
   LOCAL VAR num list{size} := [1,2,3];
   VAR num grid{2,3} := [[1,2,3],[4,5,6]];
   VAR part one := ["x",[1,2,3]];
   PERS robtarget p10 := [[600,0,500],[1,0,0,0],[0,0,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
   PROC main()
      VAR num inner;
      inner := 1;
      count := inner + 4;
      work;
      Stop;
   ENDPROC
   PROC work()
      flag := FALSE;
      flag := TRUE;
   ENDPROC
   FUNC num twice(num value)
      RETURN 2 * value;
   ENDFUNC
ENDMODULE
)";

inline const FieldList kModules{{"Main1.mod", kProgram}};
inline constexpr Dialect kOld = Dialect::V1, kNew = Dialect::V2;

inline std::string dataPath(Dialect dialect, const std::string& symbol) {
    return dialect == kOld ? "/rw/rapid/symbol/data/RAPID/" + symbol
                           : "/rw/rapid/symbol/RAPID/" + symbol + "/data";
}
inline std::string propertiesPath(Dialect dialect, const std::string& symbol) {
    return dialect == kOld ? "/rw/rapid/symbol/properties/RAPID/" + symbol
                           : "/rw/rapid/symbol/RAPID/" + symbol + "/properties";
}

class ServedController {
  public:
    /// `modules`: name of the file and text.
    explicit ServedController(const FieldList& modules, bool programStart = false, int robotWare = 7) {
        service::Settings settings;
        for (const auto& [name, text] : modules) {
            folder_.write(name, text);
            settings.inputs.paths.push_back((folder_.path / name).string());
        }
        std::filesystem::create_directory(folder_.path / "home");
        settings.options.home = (folder_.path / "home").string();
        settings.programStart = programStart;
        settings.robotWare = robotWare;
        settings.options.realtime = true;
        settings.options.seed = 1;
        controller_ = std::make_unique<service::VirtualController>(std::move(settings));
        opened_ = controller_->open() == rt::ExitStatus::Ended;
        if (!opened_) return;
        services_ = std::make_unique<RapidServices>(*controller_);
        services_->addTo(router_, subscribables_);
        thread_ = std::thread([this] { controller_->run(); });
    }
    ~ServedController() {
        if (thread_.joinable()) {
            controller_->shutDown();
            thread_.join();
        }
    }
    ServedController(const ServedController&) = delete;
    ServedController& operator=(const ServedController&) = delete;

    bool opened() const { return opened_; }
    /// The folder of $HOME.
    std::filesystem::path home() const { return folder_.path / "home"; }
    void writeHome(const std::string& name, const std::string& text) const {
        folder_.write("home/" + name, text);
    }
    RapidServices& services() { return *services_; }
    service::VirtualController& controller() { return *controller_; }

    /// `target`: a path with a query, as clients write it, decoded.
    Reply call(Dialect dialect, Method method, const std::string& target, const FieldList& form = {},
               uint64_t session = 1) {
        Request request = requestOf(dialect, method, target, session);
        for (const auto& [name, value] : form)
            request.form.add(name, value);
        const Router::Match match = router_.find(request);
        if (match.route == nullptr)
            return Reply::refuse(ReturnCode::NotFound, "no route", match.pathKnown ? 405 : 404);
        if (match.route->where == Where::Disk) return match.route->handler(request);
        std::promise<Reply> reply;
        controller_->post([&] { reply.set_value(match.route->handler(request)); });
        return reply.get_future().get();
    }
    Reply get(Dialect dialect, const std::string& target, uint64_t session = 1) {
        return call(dialect, Method::Get, target, {}, session);
    }
    Reply post(Dialect dialect, const std::string& target, const FieldList& form = {}, uint64_t session = 1) {
        return call(dialect, Method::Post, target, form, session);
    }
    /// The value of a span of the first entry (with that class, when one is given); "?" when there is none.
    std::string read(Dialect dialect, const std::string& target, const std::string& span,
                     const std::string& type = {}) {
        const Reply reply = get(dialect, target);
        return spanOf(reply, span, type);
    }
    static std::string spanOf(const Reply& reply, const std::string& span, const std::string& type = {}) {
        if (!reply.document) return "?";
        for (const Entry& entry : reply.document->entries) {
            if (!type.empty() && entry.type != type) continue;
            for (const auto& [name, value] : entry.values)
                if (name == span) return value;
        }
        return "?";
    }
    /// Executes something on the controller's thread and waits for it.
    template <class Work> void onController(Work work) {
        std::promise<void> done;
        controller_->post([&] {
            work();
            done.set_value();
        });
        done.get_future().get();
    }
    /// Until the span has this value, at most ten seconds.
    bool waitFor(Dialect dialect, const std::string& target, const std::string& span,
                 const std::string& value) {
        for (int i = 0; i < 1000; ++i) {
            if (read(dialect, target, span) == value) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        return false;
    }
    Subscribables& subscribables() { return subscribables_; }

    Request requestOf(Dialect dialect, Method method, const std::string& target, uint64_t session) const {
        Request request;
        request.dialect = dialect;
        request.method = method;
        const std::size_t mark = target.find('?');
        request.path = target.substr(0, mark);
        request.segments = splitPath(request.path);
        if (mark != std::string::npos) {
            std::string query = target.substr(mark + 1);
            while (!query.empty()) {
                const std::string one = query.substr(0, query.find('&'));
                query.erase(0, std::min(one.size() + 1, query.size()));
                const std::size_t sign = one.find('=');
                request.query.add(one.substr(0, sign), sign == std::string::npos ? "" : one.substr(sign + 1));
            }
        }
        request.action = request.query.text("action");
        auto made = std::make_shared<Session>();
        made->number = session;
        made->dialect = dialect;
        made->user = "Default User";
        made->address = "127.0.0.1";
        request.session = made;
        request.connection = session;
        return request;
    }

  private:
    TemporaryFolder folder_;
    std::unique_ptr<service::VirtualController> controller_;
    std::unique_ptr<RapidServices> services_;
    Router router_;
    Subscribables subscribables_;
    std::thread thread_;
    bool opened_ = false;
};

} // namespace rapidc::rws
