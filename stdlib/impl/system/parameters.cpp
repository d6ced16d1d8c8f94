// Manual 1.17: ReadCfgData, WriteCfgData, SaveCfgData, WarmStart.

#include "runtime/base/text_util.h"
#include "runtime/value/value_text.h"
#include "stdlib/impl/files/places.h"
#include "stdlib/impl/support/fail.h"
#include "stdlib/impl/system/configuration.h"
#include "stdlib/impl/system/whole_file.h"

#include "natives/support.h"
#include "stdlib_constants.h"

#include <cmath>
#include <limits>

using namespace rt;
using lib::CfgKind;
using lib::Configuration;

namespace {

std::string quoted(const String& text) {
    return "'" + std::string(text.view()) + "'";
}

const char* nameOf(CfgKind kind) {
    return kind == CfgKind::Number ? "a number" : kind == CfgKind::Bool ? "a bool" : "a text";
}

CfgKind kindFor(const TypeDesc& type) {
    if (type.kind == DescKind::String) return CfgKind::Text;
    return type.kind == DescKind::Bool ? CfgKind::Bool : CfgKind::Number;
}

/// The instance that an instruction works on, and where the search of \ListNo continues.
struct Found {
    Configuration* configuration = nullptr;
    Configuration::Path path;
    CfgInstance* instance = nullptr;
    float next = k::END_OF_LIST;
};

Status findInstance(TaskCore* task, const String& text, const float* listNo, Found& found) {
    found.configuration = &Configuration::of(taskOf(task).controller());
    if (!found.path.read(text.view()))
        return lib::fail(task, err::ERR_CFG_NOTFND,
                         quoted(text) + " is not a path; expected /DOMAIN/TYPE/name or "
                                        "/DOMAIN/TYPE/attribute/value");
    const std::vector<CfgInstance*> instances = found.configuration->find(found.path);
    if (instances.empty())
        return lib::fail(task, err::ERR_CFG_NOTFND, "the configuration has no instance " + quoted(text));
    const float number = listNo ? *listNo : 0;
    if (!(number >= 0 && number < static_cast<float>(instances.size())) || std::trunc(number) != number)
        return lib::failWith(task, err::ERR_CFG_OUTOFBOUNDS,
                             "ListNo is {}, but there are {} instances, numbered from 0",
                             static_cast<double>(number), static_cast<double>(instances.size()));
    found.instance = instances[static_cast<std::size_t>(number)];
    if (number + 1 < static_cast<float>(instances.size())) found.next = number + 1;
    return kOk;
}

Status wrongKind(TaskCore* task, const String& attribute, CfgKind has, CfgKind wanted) {
    return lib::fail(task, err::ERR_CFG_ILLTYPE,
                     "attribute " + std::string(attribute.view()) + " is " + nameOf(has) +
                         ", but CfgData is " + nameOf(wanted));
}

Status noAttribute(TaskCore* task, const Found& found, const String& attribute) {
    return lib::fail(task, err::ERR_CFG_NOTFND,
                     "instance '" + found.path.value + "' of " + found.path.type + " has no attribute " +
                         quoted(attribute) + ", and its standard value is not known");
}

Status readNumber(TaskCore* task, const CfgAttribute& attribute, void* data, const TypeDesc& type) {
    double value = 0;
    parseNumber(attribute.text(), value);
    if (type.kind == DescKind::Dnum) {
        *static_cast<double*>(data) = value;
        return kOk;
    }
    if (!std::isfinite(static_cast<float>(value)))
        return lib::fail(task, err::ERR_CFG_LIMIT, attribute.text() + " is beyond the range of num");
    *static_cast<float*>(data) = static_cast<float>(value);
    return kOk;
}

Status readText(TaskCore* task, const CfgAttribute& attribute, String& data) {
    std::string text;
    for (const std::string& value : attribute.values)
        text += (text.empty() ? "" : ",") + value;
    if (text.size() > kStringCapacity)
        return lib::fail(task, err::ERR_CFG_LIMIT,
                         "the text of attribute " + attribute.name + " is longer than a string");
    data.assign(text);
    return kOk;
}

/// Attributes with their standard value are left out of configuration files: false when the standard value is not known.
bool standardValue(const Found& found, std::string_view name, CfgAttribute& standard) {
    const CfgType* type = cfgType(found.path.domain, found.path.type);
    const CfgAttributeType* known = type == nullptr ? nullptr : type->find(name);
    if (known != nullptr) {
        standard = {known->name, {known->standard}, known->kind == CfgValueKind::Text, 0};
        return true;
    }
    // A bool that another instance has is FALSE in this one.
    const CfgAttribute* other = found.configuration->anyOf(found.path, name);
    if (other == nullptr || lib::kindOf(*other) != CfgKind::Bool) return false;
    standard = {other->name, {"FALSE"}, false, 0};
    return true;
}

Status readAttribute(TaskCore* task, const Found& found, const String& name, void* data,
                     const TypeDesc& type) {
    const CfgKind wanted = kindFor(type);
    CfgAttribute standard;
    const CfgAttribute* attribute = found.configuration->attribute(found.path, *found.instance, name.view());
    if (attribute == nullptr) {
        if (!standardValue(found, name.view(), standard)) return noAttribute(task, found, name);
        attribute = &standard;
    }
    const CfgKind kind = lib::kindOf(*attribute);
    if (kind != wanted) return wrongKind(task, name, kind, wanted);
    if (kind == CfgKind::Number) return readNumber(task, *attribute, data, type);
    if (kind == CfgKind::Text) return readText(task, *attribute, *static_cast<String*>(data));
    *static_cast<bool*>(data) = lib::isTrue(*attribute);
    return kOk;
}

/// The text of a value in a configuration file; ERR_CFG_LIMIT when there is none.
Status valueText(TaskCore* task, const void* data, const TypeDesc& type, std::string& text) {
    if (type.kind == DescKind::String) {
        text = static_cast<const String*>(data)->view();
        if (text.find_first_of("\"\r\n") == std::string::npos) return kOk;
        return lib::fail(task, err::ERR_CFG_LIMIT,
                         "a text of the configuration cannot hold quotation marks or ends of lines");
    }
    if (type.kind == DescKind::Bool) {
        text = *static_cast<const bool*>(data) ? "TRUE" : "FALSE";
        return kOk;
    }
    const double value = type.kind == DescKind::Dnum ? *static_cast<const double*>(data)
                                                     : static_cast<double>(*static_cast<const float*>(data));
    if (!(std::fabs(value) <= static_cast<double>(std::numeric_limits<float>::max())))
        return lib::fail(task, err::ERR_CFG_LIMIT, "the value is beyond the range of a system parameter");
    text = shortestNumber(value);
    return kOk;
}

bool isDomain(std::string_view name) {
    for (const char* domain : {"EIO", "MMC", "MOC", "PROC", "SIO", "SYS"})
        if (sameName(name, domain)) return true;
    return false;
}

Status saveDomain(TaskCore* task, const std::string& domain, const std::string& path) {
    Controller& controller = taskOf(task).controller();
    std::string text = Configuration::of(controller).text(domain);
    if (text.empty()) text = upperCase(domain) + ":CFG_1.0:6:0::\n";
    const std::string problem = lib::writeWhole(controller, path, text);
    if (problem.empty()) return kOk;
    return lib::fail(task, err::ERR_CFG_WRITEFILE, lib::shown(path) + " cannot be written: " + problem);
}

} // namespace

extern "C" {

Status rt_ReadCfgData(TaskCore* task, const String* InstancePath, const String* Attribute, void* CfgData,
                      const TypeDesc* CfgDataType, float* ListNo) {
    Found found;
    if (const Status status = findInstance(task, *InstancePath, ListNo, found)) return status;
    const Status status = readAttribute(task, found, *Attribute, CfgData, *CfgDataType);
    if (status == kOk && ListNo) *ListNo = found.next;
    return status;
}

/// The running controller keeps the parameters it was started with.
Status rt_WriteCfgData(TaskCore* task, const String* InstancePath, const String* Attribute,
                       const void* CfgData, const TypeDesc* CfgDataType, float* ListNo) {
    Found found;
    if (const Status status = findInstance(task, *InstancePath, ListNo, found)) return status;
    if (sameName(found.instance->text("Access"), "Internal"))
        return lib::fail(task, err::ERR_CFG_INTERNAL,
                         "instance '" + found.path.value +
                             "' is internal (Access): programs cannot change it");
    const CfgKind wanted = kindFor(*CfgDataType);
    CfgAttribute standard;
    const CfgAttribute* known =
        found.configuration->attribute(found.path, *found.instance, Attribute->view());
    if (known == nullptr) known = found.configuration->anyOf(found.path, Attribute->view());
    if (known == nullptr && standardValue(found, Attribute->view(), standard)) known = &standard;
    if (known == nullptr) return noAttribute(task, found, *Attribute);
    if (lib::kindOf(*known) != wanted) return wrongKind(task, *Attribute, lib::kindOf(*known), wanted);
    std::string text;
    if (const Status status = valueText(task, CfgData, *CfgDataType, text)) return status;
    CfgAttribute changed{known->name, {text}, wanted == CfgKind::Text, 0};
    CfgInstance& instance = found.configuration->kept(*found.instance);
    if (auto* own = const_cast<CfgAttribute*>(instance.find(Attribute->view())))
        *own = std::move(changed);
    else
        instance.attributes.push_back(std::move(changed));
    if (ListNo) *ListNo = found.next;
    return kOk;
}

/// A single domain goes to the file; all of them to a file each in the directory.
Status rt_SaveCfgData(TaskCore* task, const String* FilePath, const String* File, const String* Domain) {
    const std::string domain(Domain->view());
    const std::string path =
        File ? Volumes::joined(FilePath->view(), File->view()) : std::string(FilePath->view());
    if (isDomain(domain)) return saveDomain(task, domain, path);
    if (!sameName(domain, "ALL"))
        return lib::fail(task, err::ERR_CFG_ILL_DOMAIN,
                         "there is no configuration domain " + quoted(*Domain) +
                             "; use a constant such as EIO_DOMAIN");
    for (const char* each : {"EIO", "MMC", "MOC", "PROC", "SIO", "SYS"}) {
        const Status status = saveDomain(task, each, Volumes::joined(path, std::string(each) + ".cfg"));
        if (status != kOk) return status;
    }
    return kOk;
}

/// A power failure that the controller orders itself: NORMAL tasks wait for a start and continue after WarmStart.
Status rt_WarmStart(TaskCore* task) {
    constexpr Time kRestart = 10 * kSecond;
    constexpr int kRestartOrdered = 10046;
    Task& owner = taskOf(task);
    Controller& controller = owner.controller();
    std::string text = "The program has ordered a restart of the controller (WarmStart).";
    if (Configuration::of(controller).isChanged())
        text +=
            " Changed system parameters (WriteCfgData) do not count in this run: save them with SaveCfgData "
            "and start with --config.";
    controller.log().write(EventType::Information, kRestartOrdered, "Restart", text, &owner, {});
    Scheduler& scheduler = owner.scheduler();
    scheduler.at(owner.now(), [&controller] { controller.actionPowerFail(); });
    scheduler.at(addTime(owner.now(), kRestart), [&controller] { controller.actionPowerOn(); });
    return owner.sleepUntil(addTime(owner.now(), kMillisecond));
}
}
