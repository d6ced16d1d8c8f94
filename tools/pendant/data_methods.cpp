// data.*: data of the program: looking, changing, watching.

#include "config/json_text.h"
#include "config/letter_case.h"
#include "runtime/debug/debug_data.h"
#include "runtime/debug/debugger.h"
#include "tools/pendant/areas.h"
#include "tools/pendant/hub.h"
#include "tools/pendant/support.h"
#include "tools/service/data_path.h"
#include "tools/service/data_watches.h"
#include "tools/service/symbols.h"

#include <fmt/format.h>
#include <map>
#include <set>

namespace rapidc::pendant {

namespace {

using service::DataPath;
using service::FoundData;

constexpr std::size_t kMostPaths = 500;
constexpr std::size_t kLongestValue = std::size_t{256} * 1024; // bytes of a value that is sent or taken

const char* nameOfDataKind(service::SymbolType type) {
    switch (type) {
    case service::SymbolType::Constant: return "const";
    case service::SymbolType::Persistent: return "pers";
    default: return "var";
    }
}

std::string withoutRoot(const std::string& url) {
    return url.starts_with("RAPID/") ? url.substr(6) : url;
}

/// The names of "T_ROB1/Module/name".
std::vector<std::string> namesIn(const std::string& path) {
    std::vector<std::string> names{""};
    for (const char c : path)
        c == '/' ? names.push_back("") : names.back().push_back(c);
    return names;
}

class DataArea final : public Area {
  public:
    explicit DataArea(const Context& context)
        : controller_(context.controller), hub_(context.hub), watches_(context.controller) {
        service::Observer observer;
        observer.changed = [this](service::Change change, const rt::Task*) {
            if (change != service::Change::Generation && change != service::Change::Modules) return;
            for (auto& [path, watched] : watched_)
                changed_.insert(path); // the value may be gone, or there now
            if (!watched_.empty()) hub_.wake();
        };
        observer_ = controller_.observers().add(std::move(observer));
    }
    ~DataArea() override { controller_.observers().remove(observer_); }
    DataArea(const DataArea&) = delete;
    DataArea& operator=(const DataArea&) = delete;

    void addTo(MethodTable& methods) override;
    void flush() override;
    void forget(const Client& client) override { unwatch(client); }

  private:
    struct Watched {
        service::DataWatches::Token token = 0;
        std::set<const Client*> clients;
    };

    /// Null when there is nothing.
    Json valueAt(const std::string& path);
    Json read(const std::string& path);
    Json readAll(const std::vector<std::string>& paths);
    Json list(const Json& params);
    Json write(const Json& params);
    Json watch(const Client& client, const Json& params);
    void unwatch(const Client& client);
    Json stack(const Json& params);

    service::VirtualController& controller_;
    Hub& hub_;
    service::DataWatches watches_;
    service::Observers::Token observer_ = 0;
    std::map<std::string, Watched> watched_; ///< by path as clients wrote it
    std::set<std::string> changed_;
};

Json DataArea::read(const std::string& path) {
    const auto fail = [&](const std::string& why) { return Json{{"path", path}, {"error", why}}; };
    const std::optional<DataPath> names = DataPath::read(path);
    if (!names) return fail("it is not a path TASK/MODULE/NAME");
    const FoundData found = findData(controller_, *names);
    if (found.data == nullptr) return fail(found.problem);
    std::optional<std::string> value = valueOf(found);
    if (!value) return fail(fmt::format("data of type {} have no value", found.type->name));
    if (value->size() > kLongestValue) return fail("the value is too long: ask for an element");
    return {{"path", path}, {"value", std::move(*value)}, {"type", found.type->name}, {"dims", found.dims}};
}

Json DataArea::valueAt(const std::string& path) {
    const Json found = read(path);
    const auto value = found.find("value");
    return value == found.end() ? Json() : *value;
}

Json DataArea::readAll(const std::vector<std::string>& paths) {
    Json values = Json::array();
    for (const std::string& path : paths)
        values.push_back(read(path));
    return {{"values", std::move(values)}};
}

Json DataArea::list(const Json& params) {
    const rt::Task& task = taskOf(controller_, params);
    service::SymbolQuery query;
    query.block = "RAPID/" + task.name();
    if (has(params, "module")) query.block += "/" + moduleOf(controller_, params).module.name;
    query.types = {service::SymbolType::Constant, service::SymbolType::Variable,
                   service::SymbolType::Persistent};
    query.skipPredefined = true;
    query.dataType = textOr(params, "type", "");
    const std::string filter = textOr(params, "filter", "");
    if (!filter.empty())
        query.matches = [&filter](const std::string& name) { return matchesFilter(name, filter); };
    const auto start = static_cast<std::size_t>(wholeOr(params, "start", 0, 0, INT32_MAX));
    const auto count = static_cast<std::size_t>(wholeOr(params, "count", 500, 1, 5000));
    std::vector<service::SymbolInfo> found;
    (void)service::Symbols(controller_).search(query, found);
    Json data = Json::array();
    std::size_t total = 0;
    for (const service::SymbolInfo& each : found) {
        const std::string path = withoutRoot(each.url);
        const std::vector<std::string> names = namesIn(path);
        if (names.size() != 3 || total++ < start || data.size() >= count)
            continue; // data of routines are in data.stack
        data.push_back({{"path", path},
                        {"module", names[1]},
                        {"name", each.name},
                        {"type", each.dataType},
                        {"kind", nameOfDataKind(each.type)},
                        {"dims", each.dims},
                        {"local", each.isLocal},
                        {"readOnly", each.isReadOnly},
                        {"line", each.begin.line}});
    }
    return {{"data", std::move(data)}, {"total", total}};
}

Json DataArea::write(const Json& params) {
    const std::string path = textOf(params, "path"), value = textOf(params, "value");
    if (value.size() > kLongestValue) throw RequestError{code::kTooLarge, "The value is too long"};
    const std::optional<DataPath> names = DataPath::read(path);
    if (!names) badRequest(fmt::format("{} is not a path TASK/MODULE/NAME", path));
    const FoundData found = findData(controller_, *names);
    if (found.data == nullptr) notFound(found.problem);
    if (found.isConstant)
        throw RequestError{code::kRefused, fmt::format("{} is a constant", path),
                           "Change its declaration in the module"};
    if (found.isProtected) throw RequestError{code::kRefused, fmt::format("{} belongs to the system", path)};
    if (const std::string problem = assign(found, value); !problem.empty())
        badRequest(fmt::format("{}: {}", path, problem));
    controller_.core().scheduler().lookAtData(); // watches and interrupts see it now
    return {{"value", valueAt(path)}};
}

Json DataArea::watch(const Client& client, const Json& params) {
    const std::vector<std::string> paths = textsOf(params, "paths", kMostPaths);
    unwatch(client);
    for (const std::string& path : paths) {
        const std::optional<DataPath> names = DataPath::read(path);
        if (!names) continue; // the answer says so
        Watched& watched = watched_[path];
        watched.clients.insert(&client);
        if (watched.token == 0)
            watched.token =
                watches_.add(*names, [this, path](const std::string&) { // perhaps on the fibre of a task
                    changed_.insert(path);
                    hub_.wake();
                });
    }
    return readAll(paths);
}

void DataArea::unwatch(const Client& client) {
    for (auto each = watched_.begin(); each != watched_.end();) {
        Watched& watched = each->second;
        watched.clients.erase(&client);
        const auto next = std::next(each);
        if (watched.clients.empty()) {
            watches_.remove(watched.token);
            watched_.erase(each);
        }
        each = next;
    }
}

void DataArea::flush() {
    std::map<std::string, Json> values;
    for (const std::string& path : std::exchange(changed_, {}))
        if (watched_.contains(path)) values[path] = valueAt(path);
    for (const auto& client : hub_.clients()) {
        Json news = Json::array();
        for (const auto& [path, value] : values) {
            if (!watched_[path].clients.contains(client.get())) continue;
            if (client->isCongested())
                changed_.insert(path), hub_.wake(); // again later, with the value of then
            else
                news.push_back(Json::array({path, value}));
        }
        if (!news.empty()) client->send(Hub::notification("data", news));
    }
}

Json DataArea::stack(const Json& params) {
    const rt::Task& task = taskOf(controller_, params);
    if (task.isExecuting())
        throw RequestError{code::kRefused, fmt::format("Task {} is executing", task.name()), "Stop it first"};
    rt::Debugger& debugger = controller_.core().debugger();
    const std::vector<rt::DebugFrame> chain = debugger.frames(task);
    Json frames = Json::array();
    for (const rt::DebugFrame& frame : chain)
        frames.push_back(
            {{"module", frame.place.module}, {"routine", frame.place.routine}, {"line", frame.place.line}});
    Json data = Json::array();
    const auto number = static_cast<std::size_t>(wholeOr(params, "frame", 0, 0, 10'000));
    if (number < chain.size())
        for (const rt::DebugVariable& each : debugger.locals(chain[number]))
            data.push_back({{"name", each.name},
                            {"type", rt::typeName(each)},
                            {"value", each.data == nullptr ? Json() : Json(rt::valueText(each))}});
    return {{"frames", std::move(frames)}, {"data", std::move(data)}};
}

void DataArea::addTo(MethodTable& methods) {
    methods.add("data.list", [this](Client&, const Json& params) { return list(params); });
    methods.add("data.read", [this](Client&, const Json& params) {
        return readAll(textsOf(params, "paths", kMostPaths));
    });
    methods.add("data.write", [this](Client&, const Json& params) { return write(params); });
    methods.add("data.watch", [this](Client& client, const Json& params) { return watch(client, params); });
    methods.add("data.stack", [this](Client&, const Json& params) { return stack(params); });
}

} // namespace

std::unique_ptr<Area> makeDataArea(const Context& context) {
    return std::make_unique<DataArea>(context);
}

} // namespace rapidc::pendant
