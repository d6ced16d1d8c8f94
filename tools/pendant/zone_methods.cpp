// zones.list, event zones: the world zones of the program.

#include "config/json_text.h"
#include "runtime/io/io_system.h"
#include "stdlib/impl/motion/world_zones.h"
#include "tools/pendant/areas.h"
#include "tools/pendant/hub.h"
#include "tools/pendant/support.h"

#include <chrono>
#include <fmt/format.h>

namespace rapidc::pendant {

namespace {

using rt::lib::WorldZone;
using rt::lib::ZoneShape;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kLookPeriod{250}; // zones change seldom

robot::Vec3 vector(const std::array<double, 3>& values) {
    return {values[0], values[1], values[2]};
}

Json axesJson(const rt::lib::ZoneAxes& axes) {
    Json json = Json::array();
    for (const double axis : axes)
        json.push_back(motion::isConnected(axis) ? rounded(axis, 4) : Json());
    return json;
}

void addShape(const ZoneShape& shape, Json& json) {
    switch (shape.kind) {
    case ZoneShape::Kind::Box:
        json["kind"] = "box";
        json["box"] = {{"from", vectorJson(vector(shape.low))}, {"to", vectorJson(vector(shape.high))}};
        break;
    case ZoneShape::Kind::Cylinder:
        json["kind"] = "cylinder";
        json["cylinder"] = {
            {"centre", vectorJson(vector(shape.low))}, {"radius", shape.radius}, {"height", shape.height}};
        break;
    case ZoneShape::Kind::Sphere:
        json["kind"] = "sphere";
        json["sphere"] = {{"centre", vectorJson(vector(shape.low))}, {"radius", shape.radius}};
        break;
    case ZoneShape::Kind::Joints:
        json["kind"] = "joints";
        json["joints"] = {{"from", axesJson(shape.lowAxes)}, {"to", axesJson(shape.highAxes)}};
        break;
    }
}

class ZoneArea final : public Area {
  public:
    explicit ZoneArea(const Context& context) : controller_(context.controller), hub_(context.hub) {
        service::Observer observer;
        observer.motion = [this] { Hub::guarded([this] { look(); }); };
        observer.changed = [this](service::Change change, const rt::Task*) {
            if (change == service::Change::ProgramPointer) Hub::guarded([this] { look(); });
        };
        observer_ = controller_.observers().add(std::move(observer));
    }
    ~ZoneArea() override { controller_.observers().remove(observer_); }
    ZoneArea(const ZoneArea&) = delete;
    ZoneArea& operator=(const ZoneArea&) = delete;

    void addTo(MethodTable& methods) override {
        methods.add("zones.list", [this](Client&, const Json&) { return Json{{"zones", list()}}; });
    }
    void describe(Json& state) override { state["zones"] = list(); }

  private:
    Json list() const;
    void look();

    service::VirtualController& controller_;
    Hub& hub_;
    service::Observers::Token observer_ = 0;
    Clock::time_point next_;
    Json shown_ = Json::array();
};

Json ZoneArea::list() const {
    Json zones = Json::array();
    const rt::IoSystem& io = controller_.core().io();
    for (const auto& motion : controller_.core().motions()) {
        for (const WorldZone& zone : rt::lib::zonesOf(controller_.core(), *motion).all()) {
            const rt::SignalId signal = zone.action == WorldZone::Action::Stop ? -1 : io.idOf(zone.output);
            Json json{
                {"name", fmt::format("{} {}", zone.stationary ? "wzstationary" : "wztemporary", zone.number)},
                {"unit", motion->unitName()},
                {"active", zone.enabled},
                {"inside", !zone.shape.outside},
                {"stops", zone.action == WorldZone::Action::Stop},
                {"signal", signal < 0 ? std::string() : io.config(signal).name}};
            addShape(zone.shape, json);
            zones.push_back(std::move(json));
        }
    }
    return zones;
}

void ZoneArea::look() {
    if (!hub_.hasClients()) return;
    const Clock::time_point now = Clock::now();
    if (now < next_) return;
    next_ = now + kLookPeriod;
    Json zones = list();
    if (zones == shown_) return;
    shown_ = std::move(zones);
    hub_.broadcast("zones", {{"zones", shown_}});
}

} // namespace

std::unique_ptr<Area> makeZoneArea(const Context& context) {
    return std::make_unique<ZoneArea>(context);
}

} // namespace rapidc::pendant
