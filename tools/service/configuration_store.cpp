#include "tools/service/configuration_store.h"

#include "config/atomic_file.h"
#include "config/cfg_writer.h"
#include "config/read_file.h"
#include "config/text_util.h"
#include "runtime/host/cfg_types.h"
#include "tools/service/system_facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace rapidc::service {

namespace {

namespace fs = std::filesystem;
using rapid::config::CfgAttribute;
using rapid::config::CfgFile;
using rapid::config::CfgInstance;
using rapid::config::CfgProblem;
using rapid::config::CfgSection;
using rapid::config::sameName;
using rt::CfgAttributeType;
using rt::cfgType;
using rt::CfgType;
using rt::cfgTypesOf;
using rt::CfgValueKind;
using rt::impliedInstances;

constexpr std::size_t kMostInstances = 20'000; // of a type; a client cannot fill the memory

bool isTrue(std::string_view text) {
    return sameName(text, "true") || sameName(text, "yes");
}
bool isFlagText(std::string_view text) {
    return isTrue(text) || sameName(text, "false") || sameName(text, "no");
}

std::string valueText(const CfgAttribute& attribute, const CfgAttributeType* type) {
    if (attribute.values.empty()) return "true";
    std::string text = fmt::format("{}", fmt::join(attribute.values, ","));
    if (type != nullptr && type->kind == CfgValueKind::Flag && isFlagText(text))
        return isTrue(text) ? "true" : "false";
    return text;
}

/// The name of an instance; "" when it has none.
std::string nameOf(const CfgInstance& instance) {
    const CfgAttribute* name = instance.find("Name");
    return name == nullptr ? std::string() : name->text();
}

CfgSection* sectionOf(CfgFile& file, std::string_view type) {
    for (CfgSection& section : file.sections)
        if (sameName(section.type, type)) return &section;
    return nullptr;
}

/// The instance with this name (of several the last one, which counts) or number; null when there is none.
CfgInstance* instanceIn(CfgFile& file, std::string_view type, std::string_view name) {
    CfgInstance* found = nullptr;
    std::size_t number = 0;
    for (CfgSection& section : file.sections) {
        if (!sameName(section.type, type)) continue;
        for (CfgInstance& instance : section.instances) {
            ++number;
            const std::string own = nameOf(instance);
            if (own.empty() ? name == std::to_string(number) : sameName(own, name)) found = &instance;
        }
    }
    return found;
}

std::string versionFor(int robotWare, const std::string& domain) {
    const bool isSix = robotWare == 6;
    return fmt::format("CFG_1.0:{}:{}::", isSix ? 6 : 7,
                       isSix && (domain == "EIO" || domain == "SIO") ? 1 : 0);
}

} // namespace

const std::vector<std::string>& ConfigurationStore::domains() {
    static const std::vector<std::string> names = {"EIO", "SYS", "MOC", "PROC", "SIO", "MMC"};
    return names;
}

std::string ConfigurationStore::domainNamed(std::string_view name) {
    for (const std::string& domain : domains())
        if (sameName(domain, name)) return domain;
    return {};
}

ConfigurationStore::ConfigurationStore(VirtualController& controller, std::string folder)
    : controller_(controller), folder_(std::move(folder)) {
    read();
    controller_.onInputs([this](Inputs& inputs) { choose(inputs); });
    Observer observer;
    observer.changed = [this](Change change, const rt::Task*) {
        if (change == Change::Generation && controller_.settings().inputs.paths != paths_) read();
    };
    token_ = controller_.observers().add(std::move(observer));
}

void ConfigurationStore::read() {
    paths_ = controller_.settings().inputs.paths;
    files_.clear();
    changed_.clear();
    originals_.clear();
    const rt::ProgramDesc& program = controller_.program().description();
    for (uint32_t i = 0; i < program.configCount; ++i)
        originals_.emplace_back(program.configNames[i], program.configTexts[i]);
    for (const CfgFile& file : controller_.core().configuration()) {
        const std::string domain = domainNamed(file.domain);
        if (domain.empty()) continue;
        CfgFile& whole = fileOf(domain);
        if (whole.sections.empty() && !file.version.empty()) whole.version = file.version;
        for (const CfgSection& section : file.sections) {
            CfgSection* same = sectionOf(whole, section.type);
            if (same == nullptr || !sameName(same->baseType, section.baseType))
                whole.sections.push_back(section);
            else
                same->instances.insert(same->instances.end(), section.instances.begin(),
                                       section.instances.end());
        }
    }
}

bool ConfigurationStore::takeKept() {
    for (const std::string& domain : domains()) {
        const std::string path = fmt::format("{}/{}.cfg", folder_, domain);
        std::string bytes;
        std::vector<CfgProblem> problems;
        if (!rapid::config::readFile(path, bytes).empty()) continue;
        CfgFile file = rapid::config::parseCfg(bytes, path, problems);
        if (domainNamed(file.domain) != domain) continue;
        file.domain = domain;
        files_[domain] = std::move(file);
        changed_.insert(domain);
    }
    return !changed_.empty();
}

ConfigurationStore::~ConfigurationStore() {
    controller_.observers().remove(token_);
    controller_.onInputs({});
}

CfgFile& ConfigurationStore::fileOf(const std::string& domain) {
    CfgFile& file = files_[domain];
    if (file.domain.empty()) {
        file.domain = domain;
        file.version = versionFor(controller_.settings().robotWare, domain);
    }
    return file;
}

// ---- Questions -----------------------------------------------------------------------------------------------------

std::vector<std::string> ConfigurationStore::types(const std::string& domain) const {
    std::vector<std::string> names = cfgTypesOf(domain);
    const auto found = files_.find(domain);
    if (found == files_.end()) return names;
    for (const CfgSection& section : found->second.sections) {
        const bool isThere = std::any_of(names.begin(), names.end(), [&](const std::string& name) {
            return sameName(name, section.type);
        });
        if (!isThere) names.push_back(section.type);
    }
    return names;
}

bool ConfigurationStore::isType(const std::string& domain, std::string_view type) const {
    const std::vector<std::string> all = types(domain);
    return std::any_of(all.begin(), all.end(), [&](const std::string& name) { return sameName(name, type); });
}

ConfigurationStore::Instance ConfigurationStore::shown(const std::string& domain, std::string_view type,
                                                       const CfgInstance* written, const CfgInstance* implied,
                                                       std::size_t number) const {
    Instance instance;
    const CfgType* known = cfgType(domain, type);
    std::set<std::string> done;
    const auto add = [&](const std::string& name, const std::string& value) {
        if (done.insert(rapid::config::lowerCase(name)).second) instance.values.emplace_back(name, value);
    };
    const auto valueOf = [&](const CfgAttributeType& attribute) {
        for (const CfgInstance* from : {written, implied})
            if (from != nullptr)
                if (const CfgAttribute* found = from->find(attribute.name))
                    return valueText(*found, &attribute);
        return attribute.standard;
    };
    if (known != nullptr)
        for (const CfgAttributeType& attribute : known->attributes)
            add(attribute.name, valueOf(attribute));
    for (const CfgInstance* from : {written, implied})
        if (from != nullptr)
            for (const CfgAttribute& attribute : from->attributes)
                add(attribute.name,
                    valueText(attribute, known == nullptr ? nullptr : known->find(attribute.name)));
    instance.name = written != nullptr   ? nameOf(*written)
                    : implied != nullptr ? nameOf(*implied)
                                         : std::string();
    if (instance.name.empty()) instance.name = std::to_string(number);
    return instance;
}

/// Those of the system, where its configuration does not list them.
void ConfigurationStore::addOptions(std::vector<CfgInstance>& instances) const {
    for (const std::string& option : systemFacts(controller_).options) {
        CfgInstance& instance = instances.emplace_back();
        instance.attributes.push_back({"name", {option}});
        instance.attributes.push_back({"desc", {option}});
    }
}

std::vector<ConfigurationStore::Instance> ConfigurationStore::instances(const std::string& domain,
                                                                        std::string_view type) const {
    std::vector<CfgInstance> implied = impliedInstances(controller_.core(), domain, type);
    if (domain == "SYS" && sameName(type, "PRESENT_OPTIONS")) addOptions(implied);
    std::vector<Instance> all;
    std::size_t number = 0;
    std::set<std::string> named;
    if (const auto found = files_.find(domain); found != files_.end()) {
        for (const CfgSection& section : found->second.sections) {
            if (!sameName(section.type, type)) continue;
            for (const CfgInstance& instance : section.instances) {
                ++number;
                const std::string name = nameOf(instance);
                const auto same = std::find_if(implied.begin(), implied.end(), [&](const CfgInstance& other) {
                    return !name.empty() && sameName(nameOf(other), name);
                });
                named.insert(rapid::config::lowerCase(name));
                all.push_back(
                    shown(domain, type, &instance, same == implied.end() ? nullptr : &*same, number));
            }
        }
    }
    for (const CfgInstance& instance : implied)
        if (!named.contains(rapid::config::lowerCase(nameOf(instance))))
            all.push_back(shown(domain, type, nullptr, &instance, ++number));
    return all;
}

std::optional<ConfigurationStore::Instance>
ConfigurationStore::find(const std::string& domain, std::string_view type, std::string_view name) const {
    std::optional<Instance> found;
    for (Instance& instance : instances(domain, type))
        if (sameName(instance.name, name)) found = std::move(instance); // of several the last one counts
    return found;
}

std::string ConfigurationStore::text(const std::string& domain) const {
    const auto found = files_.find(domain);
    return found == files_.end() ? std::string()
                                 : rapid::config::toLatin1(rapid::config::writeCfg(found->second));
}

std::vector<std::pair<std::string, std::string>> ConfigurationStore::files() const {
    std::vector<std::pair<std::string, std::string>> all;
    std::set<std::string> names;
    const auto add = [&](std::string name, std::string bytes) {
        const std::string stem = fs::path(name).stem().string();
        for (int i = 2; !names.insert(rapid::config::upperCase(name)).second; ++i)
            name = fmt::format("{}_{}.cfg", stem, i);
        all.emplace_back(std::move(name), std::move(bytes));
    };
    for (const std::string& domain : changed_)
        add(domain + ".cfg", text(domain));
    for (const auto& [path, bytes] : originals_) {
        std::vector<CfgProblem> ignored;
        const std::string domain = domainNamed(rapid::config::parseCfg(bytes, path, ignored).domain);
        if (!changed_.contains(domain)) add(fs::path(path).stem().string() + ".cfg", bytes);
    }
    return all;
}

// ---- Changes -------------------------------------------------------------------------------------------------------

Refusal ConfigurationStore::put(CfgInstance& instance, const std::string& domain, std::string_view type,
                                const std::string& attribute, const std::string& value) const {
    if (!rapid::config::isCfgName(attribute))
        return fmt::format("'{}' is not a name of an attribute", attribute);
    if (!rapid::config::isCfgValue(value))
        return fmt::format("the value of {} has characters that a configuration cannot hold", attribute);
    const CfgType* known = cfgType(domain, type);
    const CfgAttributeType* kind = known == nullptr ? nullptr : known->find(attribute);
    const CfgAttribute* present = instance.find(attribute);
    if (kind == nullptr && present == nullptr && known != nullptr && isType(domain, type)) {
        // an attribute that the table does not know: another instance has it
        const std::vector<Instance> others = instances(domain, type);
        const bool isUsed = std::any_of(others.begin(), others.end(), [&](const Instance& other) {
            return std::any_of(other.values.begin(), other.values.end(),
                               [&](const auto& one) { return sameName(one.first, attribute); });
        });
        if (!isUsed) return fmt::format("{} has no attribute {}", type, attribute);
    }
    double number = 0;
    const bool isNumber = rapid::config::parseNumber(value, number);
    const bool wasFlag = present != nullptr && present->values.empty();
    if (kind != nullptr && kind->kind == CfgValueKind::Number && !isNumber)
        return fmt::format("{} is a number, '{}' is none", attribute, value);
    if (kind != nullptr && kind->kind == CfgValueKind::Flag && !isFlagText(value) && value != "0" &&
        value != "1")
        return fmt::format("{} is true or false, not '{}'", attribute, value);
    CfgAttribute written{present != nullptr ? present->name
                         : kind != nullptr  ? kind->name
                                            : attribute,
                         {},
                         false,
                         0};
    const bool isFlag = kind != nullptr ? kind->kind == CfgValueKind::Flag : wasFlag && isFlagText(value);
    if (isFlag) {
        const bool on = isTrue(value) || value == "1";
        if (!on && kind != nullptr && kind->standard == "true")
            written.values = {"NO"}, written.quoted = true;
        if (!on && written.values.empty()) { // absent means false
            std::erase_if(instance.attributes,
                          [&](const CfgAttribute& other) { return sameName(other.name, attribute); });
            return {};
        }
    } else {
        written.values = {value};
        const bool wasQuoted = present != nullptr && present->quoted;
        written.quoted = kind != nullptr ? kind->kind == CfgValueKind::Text : wasQuoted || !isNumber;
    }
    for (CfgAttribute& other : instance.attributes) {
        if (!sameName(other.name, attribute)) continue;
        other = std::move(written);
        return {};
    }
    instance.attributes.push_back(std::move(written));
    return {};
}

/// Mistakes that would keep the controller from starting.
Refusal ConfigurationStore::judge(const CfgFile& file, std::string_view type,
                                  const CfgInstance* instance) const {
    std::vector<CfgProblem> problems;
    if (file.domain == "EIO" && instance != nullptr && sameName(type, "EIO_SIGNAL")) {
        CfgFile one{file.name, file.domain, file.version, {{"EIO_SIGNAL", {}, {*instance}, 0}}};
        rt::IoSystem io(controller_.core().scheduler());
        io.configure(one, problems);
    }
    if (file.domain == "MOC") {
        rt::MechanicalUnits units;
        bool isUsage = false;
        const auto lookup = [&](std::string_view domain, std::string_view wanted) {
            std::vector<const CfgInstance*> found;
            const auto other = files_.find(std::string(domain));
            const CfgFile* from = domain == "MOC" ? &file : other == files_.end() ? nullptr : &other->second;
            if (from == nullptr) return found;
            for (const CfgSection* section : from->find(wanted))
                for (const CfgInstance& each : section->instances)
                    found.push_back(&each);
            return found;
        };
        const std::string problem =
            units.read(lookup, controller_.settings().options.robots, rt::kDefaultRobot, 1, isUsage);
        if (!problem.empty()) return problem;
    }
    for (const CfgProblem& problem : problems)
        if (!problem.warning) return problem.message;
    return {};
}

Refusal ConfigurationStore::replace(const std::string& domain, CfgFile file) {
    const std::string path = fmt::format("{}/{}.cfg", folder_, domain);
    if (const std::string problem =
            rapid::config::replaceFile(path, rapid::config::toLatin1(rapid::config::writeCfg(file)));
        !problem.empty())
        return problem;
    files_[domain] = std::move(file);
    changed_.insert(domain);
    ++changes_;
    controller_.noteConfiguration();
    controller_.core().log().write(rt::EventId::ConfigurationChanged, nullptr, {domain});
    return {};
}

Refusal ConfigurationStore::set(const std::string& domain, std::string_view type, std::string_view name,
                                const CfgValues& values) {
    const auto present = find(domain, type, name);
    if (!present) return fmt::format("{} has no instance {}", type, name);
    CfgFile file = fileOf(domain);
    CfgInstance* instance = instanceIn(file, type, present->name);
    if (instance == nullptr) { // implied by the robot: from now on it is written
        CfgSection* section = sectionOf(file, type);
        if (section == nullptr)
            section = &file.sections.emplace_back(CfgSection{rapid::config::upperCase(type), {}, {}, 0});
        instance = &section->instances.emplace_back();
        const CfgType* known = cfgType(domain, type);
        instance->attributes.push_back(
            {known == nullptr ? "name" : known->attributes.front().name, {present->name}, true, 0});
        if (sameName(type, "ROBOT"))
            for (const auto& [attribute, value] : present->values)
                if (sameName(attribute, "use_robot_type"))
                    instance->attributes.push_back({attribute, {value}, true, 0});
    }
    for (const auto& [attribute, value] : values) {
        if (sameName(attribute, "Name") && !sameName(value, present->name) && find(domain, type, value))
            return fmt::format("{} has an instance {} already", type, value);
        if (Refusal refusal = put(*instance, domain, type, attribute, value); !refusal.empty())
            return refusal;
    }
    if (Refusal refusal = judge(file, type, instance); !refusal.empty()) return refusal;
    return replace(domain, std::move(file));
}

Refusal ConfigurationStore::create(const std::string& domain, std::string_view type, const std::string& name,
                                   const CfgValues& values) {
    if (!rapid::config::isCfgName(type)) return fmt::format("'{}' is not a name of a type", type);
    if (name.empty() || !rapid::config::isCfgValue(name))
        return "the name of the instance is missing or not possible";
    if (find(domain, type, name)) return fmt::format("{} has an instance {} already", type, name);
    CfgFile file = fileOf(domain);
    const CfgType* known = cfgType(domain, type);
    CfgSection* section = sectionOf(file, type);
    if (section == nullptr)
        section = &file.sections.emplace_back(
            CfgSection{known != nullptr ? known->type : rapid::config::upperCase(type), {}, {}, 0});
    if (section->instances.size() >= kMostInstances)
        return fmt::format("{} has {} instances, the maximum", type, kMostInstances);
    CfgInstance& instance = section->instances.emplace_back();
    instance.attributes.push_back(
        {known == nullptr ? "Name" : known->attributes.front().name, {name}, true, 0});
    if (sameName(type, "EIO_SIGNAL"))
        instance.attributes.push_back({"SignalType", {"DI"}, true, 0}); // a signal must have one
    for (const auto& [attribute, value] : values)
        if (Refusal refusal = put(instance, domain, type, attribute, value); !refusal.empty()) return refusal;
    if (Refusal refusal = judge(file, type, &instance); !refusal.empty()) return refusal;
    return replace(domain, std::move(file));
}

Refusal ConfigurationStore::remove(const std::string& domain, std::string_view type, std::string_view name) {
    if (!find(domain, type, name)) return fmt::format("{} has no instance {}", type, name);
    CfgFile file = fileOf(domain);
    const CfgInstance* instance = instanceIn(file, type, name);
    if (instance == nullptr)
        return fmt::format("{} {} belongs to the robot and cannot be removed", type, name);
    for (CfgSection& section : file.sections)
        for (std::size_t i = 0; i < section.instances.size(); ++i)
            if (&section.instances[i] == instance) {
                section.instances.erase(section.instances.begin() + static_cast<std::ptrdiff_t>(i));
                if (Refusal refusal = judge(file, type, nullptr); !refusal.empty()) return refusal;
                return replace(domain, std::move(file));
            }
    return "internal error";
}

Refusal ConfigurationStore::load(std::string_view bytes, Load mode, bool tryOnly) {
    std::vector<CfgProblem> problems;
    CfgFile loaded = rapid::config::parseCfg(bytes, "configuration", problems);
    if (!problems.empty()) return problems.front().text();
    const std::string domain = domainNamed(loaded.domain);
    if (domain.empty())
        return fmt::format("the file is of domain '{}', which controllers do not have", loaded.domain);
    loaded.domain = domain;
    CfgFile file = mode == Load::Replace ? loaded : fileOf(domain);
    for (const CfgSection& section : loaded.sections) {
        for (const CfgInstance& instance : section.instances) {
            for (const CfgAttribute& attribute : instance.attributes)
                for (const std::string& value : attribute.values)
                    if (!rapid::config::isCfgValue(value))
                        return fmt::format("line {}: a value cannot be kept", instance.line);
            if (Refusal refusal = judge({file.name, domain, file.version, {}}, section.type, &instance);
                domain == "EIO" && !refusal.empty())
                return fmt::format("line {}: {}", instance.line, refusal);
            if (mode == Load::Replace) continue;
            const std::string name = nameOf(instance);
            CfgInstance* same = name.empty() ? nullptr : instanceIn(file, section.type, name);
            if (same != nullptr && mode == Load::Add)
                return fmt::format("{} has an instance {} already", section.type, name);
            CfgSection* into = sectionOf(file, section.type);
            if (into == nullptr)
                into = &file.sections.emplace_back(CfgSection{section.type, section.baseType, {}, 0});
            if (same != nullptr)
                *same = instance;
            else
                into->instances.push_back(instance);
        }
    }
    if (Refusal refusal = judge(file, {}, nullptr); !refusal.empty()) return refusal;
    return tryOnly ? Refusal() : replace(domain, std::move(file));
}

/// For the next start: changed domains come from their new files, and the files they had are empty.
void ConfigurationStore::choose(Inputs& inputs) {
    if (changed_.empty()) return;
    auto texts = std::make_unique<rapid::project::OpenTexts>();
    for (const auto& [path, bytes] : originals_) {
        std::vector<CfgProblem> ignored;
        const std::string domain = domainNamed(rapid::config::parseCfg(bytes, path, ignored).domain);
        if (changed_.contains(domain))
            texts->set(path, fmt::format("{}:{}\n#\n", domain, files_[domain].version));
    }
    for (const std::string& domain : changed_) {
        const std::string path = fmt::format("{}/{}.cfg", folder_, domain);
        texts->set(path, rapid::config::writeCfg(files_[domain])); // what is changed later is not meant
        inputs.configFiles.push_back(path);
    }
    inputs.texts = texts.get();
    texts_.push_back(std::move(texts));
}

} // namespace rapidc::service
