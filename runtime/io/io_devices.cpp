#include "runtime/io/io_devices.h"

#include "runtime/base/text_util.h"

namespace rt {
namespace {

bool isDeviceType(const std::string& type) {
    return upperCase(type).ends_with("_DEVICE") || sameName(type, "EIO_UNIT");
}
bool isNetworkType(const std::string& type) {
    return sameName(type, "EIO_BUS") || upperCase(type).ends_with("_NETWORK");
}
/// The network that devices of this type belong to when they do not name one: each fieldbus has a fixed one.
std::string networkOfType(const std::string& type) {
    static constexpr std::pair<const char*, const char*> kNetworks[] = {
        {"DEVICENET", "DeviceNet"}, {"ETHERNETIP", "EtherNetIP"}, {"PROFINET", "PROFINET"},
        {"PROFIBUS", "PROFIBUS"},   {"CCLINK", "CCLink"},
    };
    for (const auto& [prefix, network] : kNetworks)
        if (upperCase(type).starts_with(prefix)) return network;
    return {};
}
bool isTrustType(const std::string& type) {
    return upperCase(type).find("TRUST") != std::string::npos;
}

} // namespace

void IoDevices::configure(const CfgFile& file) {
    for (const CfgSection& section : file.sections) {
        for (const CfgInstance& instance : section.instances) {
            const std::string name = instance.text("Name");
            if (name.empty()) continue;
            if (isDeviceType(section.type)) {
                Device& device = deviceFor(name);
                device.network = instance.text("Network", instance.text("Bus", networkOfType(section.type)));
                device.trustLevel = instance.text("TrustLevel", instance.text("UnitTrustLevel"));
            } else if (isNetworkType(section.type)) {
                networks_.try_emplace(upperCase(name), false);
                networkNames_.try_emplace(upperCase(name), name);
            } else if (isTrustType(section.type)) {
                denyDeactivation_[upperCase(name)] = instance.flag("DenyDeactivate");
            }
        }
    }
}

void IoDevices::addDevice(std::string_view name) {
    if (!name.empty()) deviceFor(name);
}

std::vector<std::string> IoDevices::deviceNames() const {
    std::vector<std::string> names;
    for (const auto& [key, device] : devices_)
        names.push_back(device.name);
    return names;
}

std::vector<std::string> IoDevices::networkNames() const {
    std::map<std::string, std::string> names = networkNames_;
    for (const auto& [key, device] : devices_)
        names.try_emplace(upperCase(networkOf(device.name)), networkOf(device.name));
    std::vector<std::string> result;
    for (const auto& [key, name] : names)
        result.push_back(name);
    return result;
}

std::string IoDevices::networkOf(std::string_view name) const {
    const Device* device = find(name);
    if (device == nullptr || device->network.empty()) return "Local";
    const auto known = networkNames_.find(upperCase(device->network));
    return known == networkNames_.end() ? device->network : known->second;
}

const IoDevices::Device* IoDevices::find(std::string_view name) const {
    const auto found = devices_.find(upperCase(name));
    return found == devices_.end() ? nullptr : &found->second;
}

IoDevices::Device& IoDevices::deviceFor(std::string_view name) {
    Device& device = devices_[upperCase(name)];
    if (device.name.empty()) device.name = name;
    return device;
}

bool IoDevices::isNetwork(std::string_view name) const {
    return networks_.contains(upperCase(name)) || sameName(name, "Local") || sameName(name, "Virtual1") ||
           sameName(name, "Virtual");
}

bool IoDevices::mustStayActive(std::string_view name) const {
    const Device* device = find(name);
    if (device == nullptr) return false;
    const auto trust = denyDeactivation_.find(upperCase(device->trustLevel));
    return trust != denyDeactivation_.end() ? trust->second : device->trustLevel == "0";
}

bool IoDevices::isActive(std::string_view name) const {
    const Device* device = find(name);
    return device == nullptr || device->isActive;
}

bool IoDevices::answers(const Device& device) const {
    return !device.isLost && !isNetworkInError(device.network);
}

bool IoDevices::hasContact(std::string_view name) const {
    const Device* device = find(name);
    return device == nullptr || answers(*device);
}

bool IoDevices::isNetworkInError(std::string_view network) const {
    const auto found = networks_.find(upperCase(network));
    return found != networks_.end() && found->second;
}

bool IoDevices::isNetworkOfInError(std::string_view name) const {
    const Device* device = find(name);
    return device != nullptr && isNetworkInError(device->network);
}

bool IoDevices::isMuted(std::string_view name) const {
    const Device* device = find(name);
    return device != nullptr && device->isMuted;
}

void IoDevices::setActive(std::string_view name, bool active) {
    deviceFor(name).isActive = active;
    applyStates();
}

void IoDevices::setContact(std::string_view name, bool contact) {
    deviceFor(name).isLost = !contact;
    applyStates();
}

void IoDevices::setNetworkError(std::string_view network, bool error) {
    networks_[upperCase(network)] = error;
    applyStates();
}

void IoDevices::setMuted(std::string_view name, bool muted) {
    deviceFor(name).isMuted = muted;
}

void IoDevices::restart() {
    for (auto& [key, device] : devices_)
        device.isActive = true, device.isMuted = false;
    applyStates();
}

void IoDevices::applyStates() {
    for (auto& [key, device] : devices_) {
        const bool isReachable = device.isActive && answers(device);
        if (isReachable == device.wasReachable) continue;
        device.wasReachable = isReachable;
        apply_(device.name, isReachable);
    }
    changed_.notifyAll();
}

} // namespace rt
