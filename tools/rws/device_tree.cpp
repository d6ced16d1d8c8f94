#include "tools/rws/device_tree.h"

#include "config/text_util.h"
#include "tools/rws/request_values.h"
#include "tools/service/system_facts.h"

#include <fmt/format.h>

#include <functional>

namespace rapidc::rws {

namespace {

using rapid::config::sameName;

constexpr const char* kDevices = "/rw/devices";

/// A part of the controller: those inside it, or its properties.
struct Node {
    std::string id, name;
    std::vector<Node> parts = {};
    std::vector<std::pair<std::string, std::string>> properties = {};
};

Node treeOf(service::VirtualController& controller) {
    const service::SystemFacts facts = service::systemFacts(controller);
    const service::RobotWareVersion version = service::robotWareVersion(controller.settings().robotWare);
    Node units{"MECHANICAL_UNITS", "Mechanical Units"};
    for (const auto& unit : controller.core().units().all())
        units.parts.push_back({unit->name,
                               unit->name,
                               {},
                               {{"Name", unit->name},
                                {"Kind", unit->isRobot ? "Robot" : "External axes"},
                                {"Active", unit->isActive ? "Yes" : "No"}}});
    Node computer{"COMPUTER_SYSTEM",
                  "Computer System",
                  {},
                  {{"Controller", "Virtual Controller"}, {"System", facts.name}, {"System ID", facts.id}}};
    Node hardware{"HW_DEVICES",
                  "Hardware devices",
                  {{"CONTROLLER", "Controller", {std::move(computer)}}, std::move(units)}};
    Node software{"SW_RESOURCES",
                  "Software resources",
                  {{"SYSTEM", "System", {}, {{"RobotWare", version.name}, {"Version", version.version}}},
                   {"RAPID", "RAPID", {}, {{"Tasks", fmt::format("{}", controller.core().tasks().size())}}}}};
    return {"devices", "Devices", {std::move(hardware), std::move(software)}};
}

/// RWS 1.0 has the parts inside one entry, RWS 2.0 beside each other.
Reply show(const Request& request, const Node& node, const std::string& path) {
    Document document;
    std::vector<Entry> entries;
    for (const Node& part : node.parts) {
        Entry entry;
        entry.type = "dev-id-li";
        entry.title = part.id;
        entry.self = fmt::format("{}/{}", path, escapedSegment(part.id));
        entry.value("name", part.name);
        entries.push_back(std::move(entry));
    }
    for (const auto& [name, value] : node.properties) {
        Entry entry;
        entry.type = "dev-prop-li";
        entry.title = name;
        entry.value("name", name).value("value", value);
        entries.push_back(std::move(entry));
    }
    if (request.dialect == Dialect::V2) {
        document.entries = std::move(entries);
        return Reply::of(std::move(document));
    }
    Entry& whole = document.add("dev-group", node.id);
    whole.value("name", node.name);
    whole.nestedName = node.properties.empty() ? "devices" : "properties";
    whole.nested = std::move(entries);
    return Reply::of(std::move(document));
}

const Node* partOf(const Node& node, const std::string& id) {
    for (const Node& part : node.parts)
        if (sameName(part.id, id)) return &part;
    return nullptr;
}

/// Nodes whose name or identifier contains the text.
void collect(const Node& node, const std::string& text, const std::string& path, Document& document) {
    for (const Node& part : node.parts) {
        const std::string own = fmt::format("{}/{}", path, escapedSegment(part.id));
        if (rapid::config::containsName(part.id, text) || rapid::config::containsName(part.name, text)) {
            Entry& entry = document.add("dev-id-li", part.id);
            entry.self = own;
            entry.value("name", part.name);
        }
        collect(part, text, own, document);
    }
}

} // namespace

void addDeviceTree(Router& router, service::VirtualController& controller) {
    router.getBoth(kDevices, [&controller](const Request& request) {
        return show(request, treeOf(controller), kDevices);
    });
    router.getBoth(std::string(kDevices) + "/{path*}", [&controller](const Request& request) {
        const Node root = treeOf(controller);
        const Node* node = &root;
        std::string path = kDevices;
        for (const std::string& id : splitPath(request.parameter("path"))) {
            node = partOf(*node, id);
            if (node == nullptr)
                return Reply::refuse(ReturnCode::NotFound,
                                     fmt::format("the controller has no part {}", request.parameter("path")));
            path += "/" + escapedSegment(node->id);
        }
        return show(request, *node, path);
    });
    const Handler search = [&controller](const Request& request) {
        std::string text = fieldOf(request, "property");
        if (text.empty())
            return Reply::refuse(ReturnCode::BadParameter,
                                 "property is missing; expected: the path or a part of the name of a device");
        text = splitPath(text).empty() ? text : splitPath(text).back();
        Document document;
        collect(treeOf(controller), text, kDevices, document);
        return Reply::of(std::move(document));
    };
    router.post(Dialect::V2, std::string(kDevices) + "/search", search);
    router.action(kDevices, "search", search);
}

} // namespace rapidc::rws
