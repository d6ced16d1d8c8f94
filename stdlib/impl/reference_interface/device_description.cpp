#include "stdlib/impl/reference_interface/device_description.h"

#include "runtime/base/text_util.h"
#include "stdlib/impl/reference_interface/xml_text.h"
#include "stdlib/impl/system/whole_file.h"

#include <fmt/format.h>

#include <cmath>

namespace rt::lib {
namespace {

std::string readFile(Controller& controller, const std::string& path, std::string_view rootName,
                     XmlElement& root) {
    std::string bytes;
    std::string problem = readWhole(controller, path, bytes);
    if (problem.empty()) problem = readXml(bytes, root);
    if (problem.empty() && !sameName(root.name, rootName))
        problem = fmt::format("its root is <{}>, expected <{}>", root.name, rootName);
    return problem.empty() ? problem : fmt::format("{}: {}", path, problem);
}

/// Settings.xml: <Clients><Client Convention="CDP" Name="..." Path="GSI/..."/></Clients>.
std::string folderOf(const XmlElement& settings, std::string_view device, std::string& folder) {
    const XmlElement* clients = settings.find("Clients");
    for (const XmlElement& client : clients != nullptr ? clients->children : std::vector<XmlElement>()) {
        if (!sameName(client.attribute("Name"), device)) continue;
        folder = client.attribute("Path");
        if (folder.empty()) folder = "GSI/" + client.attribute("Name");
        while (folder.ends_with('/'))
            folder.pop_back();
        return {};
    }
    return fmt::format("HOME:/GSI/Settings.xml: no Client has the Name \"{}\"", device);
}

bool isTrue(std::string_view text) {
    return sameName(text, "TRUE") || text == "1";
}

bool wholeNumber(const std::string& text, double least, double most, double& number) {
    return parseNumber(text, number) && number >= least && number <= most && std::trunc(number) == number;
}

std::string readNetwork(const XmlElement& description, ReferenceDescription& out) {
    const XmlElement* network = description.find("Network");
    const XmlElement* channel = network != nullptr ? network->find("Channel") : nullptr;
    if (channel == nullptr) return "it has no <Network> with a <Channel>";
    if (!net::parseIp(network->attribute("Address"), out.address.ip) || out.address.ip == net::kAnyAddress)
        return fmt::format("Address of <Network> is \"{}\"; write an address such as \"192.168.125.10\"",
                           network->attribute("Address"));
    double port = 0;
    if (!wholeNumber(channel->attribute("Port"), 1, UINT16_MAX, port))
        return "Port of <Channel> must be a number from 1 to 65535";
    out.address.port = static_cast<uint16_t>(port);
    const std::string protocol = channel->attribute("Protocol");
    if (!sameName(protocol, "UDP") && !sameName(protocol, "TCP"))
        return fmt::format("Protocol of <Channel> is \"{}\", expected Udp or Tcp", protocol);
    out.datagrams = sameName(protocol, "UDP");
    return {};
}

std::string readSettings(const XmlElement& description, ReferenceDescription& out) {
    const XmlElement* settings = description.find("Settings");
    if (settings == nullptr) return {};
    double number = 0;
    if (const XmlElement* timeout = settings->find("TimeOut")) {
        if (!wholeNumber(timeout->text, 1, 1e7, number)) return "<TimeOut> must be a time in ms";
        out.timeout = std::max(kReferenceTick, static_cast<Time>(number) * (kSecond / 1000));
    }
    if (const XmlElement* lost = settings->find("MaxLost")) {
        if (!wholeNumber(lost->text, 0, 1e9, number)) return "<MaxLost> must be a number of messages";
        out.maxLost = static_cast<int>(number);
    }
    const XmlElement* dryRun = settings->find("DryRun");
    out.isSupervised = dryRun != nullptr && !isTrue(dryRun->text);
    return {};
}

std::string aliasOf(const XmlElement& element) {
    const std::string alias = element.attribute("Alias");
    return alias.empty() ? element.attribute("Name") : alias;
}

std::string readFields(const XmlElement& configuration, const std::string& type,
                       ReferenceProperty& property) {
    const XmlElement* records = configuration.find("Records");
    for (const XmlElement& record : records != nullptr ? records->children : std::vector<XmlElement>()) {
        if (!sameName(record.attribute("Name"), type)) continue;
        for (const XmlElement& field : record.children) {
            if (!sameName(field.name, "Field")) continue;
            property.fields.push_back({field.attribute("Name"), aliasOf(field), field.attribute("Type"),
                                       sameName(field.attribute("Link"), "INTERN")});
        }
        return {};
    }
    return fmt::format("property \"{}\" has the Type \"{}\", but no Record has that Name", property.name,
                       type);
}

void readModes(const XmlElement& configuration, ReferenceDescription& out) {
    const XmlElement* enums = configuration.find("Enums");
    for (const XmlElement& one : enums != nullptr ? enums->children : std::vector<XmlElement>())
        for (const XmlElement& member : one.children)
            out.operationModes[member.attribute("Name")] = aliasOf(member);
}

std::string readProperties(const XmlElement& configuration, ReferenceDescription& out) {
    const XmlElement* properties = configuration.find("Properties");
    if (properties == nullptr || properties->children.empty()) return "it has no <Properties>";
    for (const XmlElement& element : properties->children) {
        ReferenceProperty property;
        property.name = element.attribute("Name");
        property.tag = aliasOf(element);
        const std::string flag = element.attribute("Flag");
        property.isSent = !sameName(flag, "READONLY");
        property.isReceived = !sameName(flag, "WRITEONLY");
        if (property.name.empty()) return "a <Property> has no Name";
        if (std::string problem = readFields(configuration, element.attribute("Type"), property);
            !problem.empty())
            return problem;
        out.properties.push_back(std::move(property));
    }
    return {};
}

} // namespace

const ReferenceProperty* ReferenceDescription::find(std::string_view data) const {
    for (const ReferenceProperty& property : properties)
        if (sameName(property.name, data)) return &property;
    return nullptr;
}

std::string readDescription(Controller& controller, std::string_view device, ReferenceDescription& out) {
    XmlElement settings, description, configuration;
    std::string folder;
    std::string problem = readFile(controller, "HOME:/GSI/Settings.xml", "Settings", settings);
    if (problem.empty()) problem = folderOf(settings, device, folder);
    if (!problem.empty()) return problem;
    const std::string descriptionFile = fmt::format("HOME:/{}/Description.xml", folder);
    const std::string configurationFile = fmt::format("HOME:/{}/Configuration.xml", folder);
    problem = readFile(controller, descriptionFile, "Description", description);
    if (problem.empty()) problem = readFile(controller, configurationFile, "Configuration", configuration);
    if (!problem.empty()) return problem;
    out.name = std::string(device);
    problem = readNetwork(description, out);
    if (problem.empty()) problem = readSettings(description, out);
    if (!problem.empty()) return fmt::format("{}: {}", descriptionFile, problem);
    readModes(configuration, out);
    problem = readProperties(configuration, out);
    return problem.empty() ? problem : fmt::format("{}: {}", configurationFile, problem);
}

} // namespace rt::lib
