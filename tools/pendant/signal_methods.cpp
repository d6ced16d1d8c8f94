// signals.*: what pages read, set and simulate, and the changes of those they have subscribed to.

#include "config/json_text.h"
#include "config/letter_case.h"
#include "runtime/io/io_system.h"
#include "tools/pendant/areas.h"
#include "tools/pendant/hub.h"
#include "tools/pendant/support.h"

#include <cmath>
#include <fmt/format.h>
#include <map>
#include <unordered_set>

namespace rapidc::pendant {

namespace {

using rapid::config::sameName;
using service::Change;

constexpr std::size_t kMostNames = 10'000;  // of a subscription
constexpr std::size_t kMostChanges = 4'000; // between two messages; then only the last values are sent
constexpr int kDecimals = 6;

class SignalArea final : public Area {
  public:
    explicit SignalArea(const Context& context) : controller_(context.controller), hub_(context.hub) {
        service::Observer observer;
        observer.signal = [this](rt::SignalId signal, double value) { note(signal, value); };
        observer.changed = [this](Change change, const rt::Task*) {
            if (change == Change::Generation) beginGeneration();
        };
        observer_ = controller_.observers().add(std::move(observer));
    }
    ~SignalArea() override { controller_.observers().remove(observer_); }
    SignalArea(const SignalArea&) = delete;
    SignalArea& operator=(const SignalArea&) = delete;

    void addTo(MethodTable& methods) override;
    void flush() override;
    void forget(const Client& client) override { feeds_.erase(&client); }

  private:
    struct Feed {
        bool all = false;
        std::vector<std::string> names;
        std::unordered_set<rt::SignalId> signals; ///< of the present generation
        std::unordered_set<rt::SignalId> missed;  ///< while the client read too slowly
        bool wants(rt::SignalId signal) const { return all || signals.contains(signal); }
    };
    struct Noted {
        rt::SignalId signal;
        double value;
        rt::Time time;
    };

    rt::IoSystem& io() const { return controller_.core().io(); }
    rt::SignalId find(const std::string& name) const {
        const rt::SignalId signal = io().find(name);
        if (signal < 0) notFound(fmt::format("There is no signal {}", name));
        return signal;
    }
    void note(rt::SignalId signal, double value);
    void beginGeneration();
    void resolve(Feed& feed) const;
    Json entryFor(rt::SignalId signal) const;
    Json list(const Json& params) const;
    Json set(const Json& params);
    Json simulate(const Json& params);
    Json subscribe(const Client& client, const Json& params);
    bool mayWrite(const rt::SignalConfig& config) const;
    Json entryOf(const Noted& noted) const {
        return Json::array({io().config(noted.signal).name, rounded(noted.value, kDecimals),
                            io().isSimulated(noted.signal) ? 1 : 0, rounded(rt::toSeconds(noted.time), 4)});
    }

    service::VirtualController& controller_;
    Hub& hub_;
    service::Observers::Token observer_ = 0;
    std::map<const Client*, Feed> feeds_;
    std::vector<Noted> noted_;
    std::unordered_set<rt::SignalId> crowd_; ///< more changes than noted_ takes
};

void SignalArea::note(rt::SignalId signal, double value) {
    if (feeds_.empty()) return;
    if (noted_.size() < kMostChanges)
        noted_.push_back({signal, value, controller_.core().scheduler().now()});
    else
        crowd_.insert(signal);
    hub_.wake();
}

/// Signals have other numbers and values now.
void SignalArea::beginGeneration() {
    noted_.clear();
    crowd_.clear();
    for (auto& [client, feed] : feeds_) {
        resolve(feed);
        feed.missed = feed.signals;
    }
    hub_.wake();
}

void SignalArea::resolve(Feed& feed) const {
    feed.signals.clear();
    feed.missed.clear();
    for (const std::string& name : feed.names)
        if (const rt::SignalId signal = io().find(name); signal >= 0) feed.signals.insert(signal);
}

void SignalArea::flush() {
    const std::vector<Noted> noted = std::exchange(noted_, {});
    const auto crowd = std::exchange(crowd_, {});
    for (const auto& client : hub_.clients()) {
        const auto found = feeds_.find(client.get());
        if (found == feeds_.end()) continue;
        Feed& feed = found->second;
        for (const rt::SignalId signal : crowd)
            if (feed.wants(signal)) feed.missed.insert(signal);
        if (client->isCongested()) {
            for (const Noted& each : noted)
                if (feed.wants(each.signal)) feed.missed.insert(each.signal);
            if (!feed.missed.empty()) hub_.wake(); // again later
            continue;
        }
        Json changes = Json::array();
        for (const Noted& each : noted)
            if (feed.wants(each.signal)) changes.push_back(entryOf(each));
        for (const rt::SignalId signal : std::exchange(feed.missed, {}))
            changes.push_back(entryOf({signal, io().value(signal), controller_.core().scheduler().now()}));
        if (!changes.empty()) client->send(Hub::notification("signal", changes));
    }
}

/// A level of EIO_ACCESS says in which mode the pendant, which is a local client, may write.
bool SignalArea::mayWrite(const rt::SignalConfig& config) const {
    if (sameName(config.access, "ReadOnly") || sameName(config.access, "Internal")) return false;
    for (const rt::CfgInstance* level : controller_.core().instances("EIO", "EIO_ACCESS")) {
        if (!sameName(level->text("Name"), config.access)) continue;
        const bool automatic = controller_.panel().mode == service::OperatingMode::Auto;
        const rt::CfgAttribute* local = level->find(automatic ? "LocalAuto" : "LocalManual");
        return local != nullptr && !sameName(local->text(), "ReadOnly") &&
               level->flag(automatic ? "LocalAuto" : "LocalManual");
    }
    return true;
}

Json SignalArea::entryFor(rt::SignalId signal) const {
    const rt::SignalConfig& config = io().config(signal);
    return {{"name", config.name},
            {"type", rt::signalTypeName(config.type)},
            {"value", rounded(io().value(signal), kDecimals)},
            {"simulated", io().isSimulated(signal)},
            {"device", config.device},
            {"label", config.label},
            {"category", config.category},
            {"min", rounded(config.minValue, kDecimals)},
            {"max", rounded(config.maxValue, kDecimals)},
            {"writable", mayWrite(config) && (!rt::isInput(config.type) || config.device.empty() ||
                                              io().isSimulated(signal))}};
}

Json SignalArea::list(const Json& params) const {
    const std::string filter = textOr(params, "filter", ""), type = textOr(params, "type", "");
    const std::string device = textOr(params, "device", "");
    const auto start = static_cast<std::size_t>(wholeOr(params, "start", 0, 0, INT32_MAX));
    const auto count = static_cast<std::size_t>(wholeOr(params, "count", 500, 1, 5000));
    Json signals = Json::array();
    std::size_t total = 0;
    for (std::size_t i = 0; i < io().size(); ++i) {
        const auto signal = static_cast<rt::SignalId>(i);
        const rt::SignalConfig& config = io().config(signal);
        if (!matchesFilter(config.name, filter) && !matchesFilter(config.label, filter)) continue;
        if (!type.empty() && !sameName(rt::signalTypeName(config.type), type)) continue;
        if (!device.empty() && !sameName(config.device, device)) continue;
        if (total++ >= start && signals.size() < count) signals.push_back(entryFor(signal));
    }
    return {{"signals", std::move(signals)}, {"total", total}};
}

Json SignalArea::set(const Json& params) {
    const rt::SignalId signal = find(textOf(params, "name"));
    const rt::SignalConfig& config = io().config(signal);
    const double value = numberOf(params, "value");
    if (!mayWrite(config))
        throw RequestError{code::kRefused,
                           fmt::format("The access level {} of {} does not let this page write it",
                                       config.access, config.name),
                           "Change Access in EIO.cfg, or the operating mode"};
    if (rt::isInput(config.type) && !config.device.empty() && !io().isSimulated(signal))
        throw RequestError{code::kRefused,
                           fmt::format("{} is an input of device {}", config.name, config.device),
                           "Simulate it first"};
    const bool isWhole = value == std::floor(value);
    if ((rt::isDigital(config.type) && value != 0 && value != 1) || (rt::isGroup(config.type) && !isWhole))
        badRequest(
            fmt::format("{} is not a value of {} ({})", value, config.name, rt::signalTypeName(config.type)));
    switch (io().setByClient(signal, value)) {
    case rt::IoResult::Ok: return {};
    case rt::IoResult::NotWritable:
        throw RequestError{code::kRefused, fmt::format("A cross connection sets {}", config.name),
                           "Simulate it first"};
    default:
        badRequest(fmt::format("{} is outside the range {} to {} of {}", value, config.minValue,
                               config.maxValue, config.name));
    }
}

Json SignalArea::simulate(const Json& params) {
    const rt::SignalId signal = find(textOf(params, "name"));
    const bool on = flagOf(params, "on");
    const rt::SignalConfig& config = io().config(signal);
    if (!mayWrite(config))
        throw RequestError{code::kRefused,
                           fmt::format("The access level {} of {} does not let this page simulate it",
                                       config.access, config.name),
                           "Change Access in EIO.cfg, or the operating mode"};
    if (io().isSimulated(signal) == on) return {};
    io().simulate(signal, on);
    controller_.observers().signal(signal, io().value(signal)); // its state is another one
    return {};
}

Json SignalArea::subscribe(const Client& client, const Json& params) {
    Feed feed;
    feed.all = flagOr(params, "all", false);
    if (!feed.all) feed.names = textsOf(params, "names", kMostNames);
    Json signals = Json::array();
    for (const std::string& name : feed.names)
        signals.push_back(entryFor(find(name)));
    for (std::size_t i = 0; feed.all && i < io().size(); ++i)
        signals.push_back(entryFor(static_cast<rt::SignalId>(i)));
    resolve(feed);
    if (!feed.all && feed.names.empty())
        feeds_.erase(&client);
    else
        feeds_[&client] = std::move(feed);
    return {{"signals", std::move(signals)}};
}

void SignalArea::addTo(MethodTable& methods) {
    methods.add("signals.list", [this](Client&, const Json& params) { return list(params); });
    methods.add("signals.set", [this](Client&, const Json& params) { return set(params); });
    methods.add("signals.simulate", [this](Client&, const Json& params) { return simulate(params); });
    methods.add("signals.subscribe",
                [this](Client& client, const Json& params) { return subscribe(client, params); });
}

} // namespace

std::unique_ptr<Area> makeSignalArea(const Context& context) {
    return std::make_unique<SignalArea>(context);
}

} // namespace rapidc::pendant
