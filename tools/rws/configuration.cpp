#include "tools/rws/configuration.h"

#include "config/letter_case.h"
#include "config/read_file.h"
#include "runtime/host/cfg_types.h"
#include "tools/rws/file_service.h"
#include "tools/rws/rapid_support.h"
#include "tools/rws/request_values.h"
#include "tools/rws/state_watch.h"

#include <fmt/format.h>

#include <filesystem>

namespace rapidc::rws {

namespace {

using rapid::config::sameName;
using service::ConfigurationStore;

constexpr std::size_t kMostInstancesOnPage = 20'000; // clients of RWS 1.0 expect all instances at once
constexpr std::uintmax_t kLargestFile = std::uintmax_t{16} << 20; // bytes

/// RWS 2.0 writes `Attr=[value,1]`.
std::string valueIn(std::string_view text) {
    const std::size_t comma = text.rfind(',');
    const bool isList = text.starts_with('[') && text.ends_with(']') && comma != std::string_view::npos;
    return std::string(isList ? text.substr(1, comma - 1) : text);
}

Failure noConfigurationDomain(const Request& request) {
    return {ReturnCode::NotFound, fmt::format("unknown configuration domain {}", request.parameter("domain")),
            0};
}

std::string instancesHref(const std::string& domain, const std::string& type) {
    return fmt::format("/rw/cfg/{}/{}/instances", domain, escapedSegment(type));
}

} // namespace

// ---- Questions -----------------------------------------------------------------------------------------------------

Reply Configuration::domains(const Request&) const {
    Document document;
    document.place = Document::Place::Resources;
    for (const std::string& domain : ConfigurationStore::domains())
        document.add("cfg-domain-li", domain).value("name", domain).self = "/rw/cfg/" + domain;
    return Reply::of(std::move(document));
}

Reply Configuration::types(const Request& request) const {
    const std::string domain = ConfigurationStore::domainNamed(request.parameter("domain"));
    if (domain.empty()) return Reply::refuse(noConfigurationDomain(request));
    const std::vector<std::string> all = store_.types(domain);
    ListPage page;
    if (const auto failure = readListPage(request, all.size(), kMostInstancesOnPage, page))
        return Reply::refuse(*failure);
    Document document;
    document.place = Document::Place::Resources;
    document.next = page.next;
    for (std::size_t i = page.begin; i < page.end; ++i)
        document.add("cfg-dt-li", all[i]).value("name", all[i]).self =
            fmt::format("/rw/cfg/{}/{}", domain, escapedSegment(all[i]));
    return Reply::of(std::move(document));
}

std::optional<Failure> Configuration::typeNamed(const std::string& written, const std::string& type,
                                                std::string& domain) const {
    domain = ConfigurationStore::domainNamed(written);
    if (domain.empty())
        return Failure{ReturnCode::NotFound, fmt::format("configuration domain {} does not exist", written),
                       0};
    if (store_.isType(domain, type)) return std::nullopt;
    return Failure{ReturnCode::NotFound, fmt::format("domain {} has no type {}", domain, type), 0};
}

std::optional<Failure> Configuration::typeIn(const Request& request, std::string& domain) const {
    return typeNamed(request.parameter("domain"), request.parameter("type"), domain);
}

Reply Configuration::type(const Request& request) const {
    std::string domain;
    if (const auto failure = typeIn(request, domain)) return Reply::refuse(*failure);
    Document document;
    document.place = Document::Place::Resources;
    const std::string base = fmt::format("/rw/cfg/{}/{}/", domain, escapedSegment(request.parameter("type")));
    for (const char* part : {"attributes", "instances"})
        document.add("cfg-dt-li", part).value("name", part).self = base + part;
    return Reply::of(std::move(document));
}

Reply Configuration::attributes(const Request& request) const {
    std::string domain;
    if (const auto failure = typeIn(request, domain)) return Reply::refuse(*failure);
    const std::string type = request.parameter("type");
    Document document;
    document.place = Document::Place::Resources;
    if (const rt::CfgType* known = rt::cfgType(domain, type)) {
        for (const rt::CfgAttributeType& attribute : known->attributes) {
            Entry& entry = document.add("cfg-dt-attribute", attribute.name);
            entry.value("name", attribute.name);
            entry.value("type", attribute.kind == rt::CfgValueKind::Text     ? "string"
                                : attribute.kind == rt::CfgValueKind::Number ? "float"
                                                                             : "bool");
            entry.value("default", attribute.standard);
        }
        return Reply::of(std::move(document));
    }
    const std::vector<Instance> all = store_.instances(domain, type);
    if (!all.empty())
        for (const auto& [name, value] : all.front().values)
            document.add("cfg-dt-attribute", name)
                .value("name", name)
                .value("type", "string")
                .value("default", "");
    return Reply::of(std::move(document));
}

namespace {

void describe(const Request& request, const ConfigurationStore::Instance& instance, Entry& entry) {
    entry.value("instanceid", instance.name);
    entry.nestedName = "attrib";
    for (const auto& [name, value] : instance.values) {
        Entry attribute;
        attribute.type = request.dialect == Dialect::V1 ? "cfg-ia-t-li" : "cfg-ia-t";
        attribute.title = name;
        attribute.value("value", value);
        entry.nested.push_back(std::move(attribute));
    }
}

} // namespace

Reply Configuration::instances(const Request& request) const {
    std::string domain;
    if (const auto failure = typeIn(request, domain)) return Reply::refuse(*failure);
    const std::string type = request.parameter("type");
    const std::vector<Instance> all = store_.instances(domain, type);
    ListPage page;
    if (const auto failure = readListPage(request, all.size(), kMostInstancesOnPage, page))
        return Reply::refuse(*failure);
    Document document;
    document.place = Document::Place::Resources;
    document.next = page.next;
    for (std::size_t i = page.begin; i < page.end; ++i) {
        Entry& entry = document.add("cfg-dt-instance-li", all[i].name);
        entry.self = instancesHref(domain, type) + "/" + escapedSegment(all[i].name);
        describe(request, all[i], entry);
    }
    return Reply::of(std::move(document));
}

Reply Configuration::instance(const Request& request) const {
    std::string domain;
    if (const auto failure = typeIn(request, domain)) return Reply::refuse(*failure);
    const std::string type = request.parameter("type"), name = request.parameter("name");
    const auto found = store_.find(domain, type, name);
    if (!found) return Reply::refuse(ReturnCode::NotFound, fmt::format("{} has no instance {}", type, name));
    Document document;
    describe(request, *found, document.add("cfg-dt-instance", found->name));
    return Reply::of(std::move(document));
}

// ---- Changes -------------------------------------------------------------------------------------------------------

Reply Configuration::set(const Request& request) {
    std::string domain;
    if (const auto failure = typeIn(request, domain)) return Reply::refuse(*failure);
    const std::string type = request.parameter("type"), name = request.parameter("name");
    if (!store_.find(domain, type, name))
        return Reply::refuse(ReturnCode::NotFound, fmt::format("{} has no instance {}", type, name));
    service::CfgValues values;
    for (const auto& [attribute, value] : request.form.all())
        values.emplace_back(attribute, valueIn(value));
    if (values.empty()) return badParameter("attribute", "Attribute=value");
    return replyTo(store_.set(domain, type, name, values), ReturnCode::BadParameter);
}

Reply Configuration::create(const Request& request) {
    std::string domain;
    if (const auto failure = typeIn(request, domain)) return Reply::refuse(*failure);
    service::CfgValues values;
    for (const auto& [attribute, value] : request.form.all())
        if (!sameName(attribute, "name")) values.emplace_back(attribute, valueIn(value));
    const std::string name = valueIn(request.form.text("name"));
    const service::Refusal refusal = store_.create(domain, request.parameter("type"), name, values);
    if (!refusal.empty()) return Reply::refuse(ReturnCode::BadParameter, refusal);
    Reply reply = Reply::done(201);
    reply.location = instancesHref(domain, request.parameter("type")) + "/" + escapedSegment(name);
    return reply;
}

Reply Configuration::remove(const Request& request) {
    std::string domain;
    if (const auto failure = typeIn(request, domain)) return Reply::refuse(*failure);
    const std::string type = request.parameter("type"), name = request.parameter("name");
    if (!store_.find(domain, type, name))
        return Reply::refuse(ReturnCode::NotFound, fmt::format("{} has no instance {}", type, name));
    return replyTo(store_.remove(domain, type, name));
}

/// RWS 2.0: an instance of the store is valid, because changes that are not are refused; so each must only be there.
Reply Configuration::validateInstances(const Request& request) const {
    std::string domain;
    const std::string type = request.form.text("cfgtype");
    if (const auto failure = typeNamed(request.form.text("cfgdomain"), type, domain))
        return Reply::refuse(*failure);
    std::size_t given = 0;
    for (const auto& [field, name] : request.form.all()) {
        if (!sameName(field, "instances")) continue;
        ++given;
        if (!store_.find(domain, type, name))
            return Reply::refuse(ReturnCode::NotFound, fmt::format("{} has no instance {}", type, name));
    }
    const auto count = countIn(request.form.text("instancescount"));
    if (given == 0 || (count && *count != given))
        return badParameter("instancescount", "the number of instances that follow");
    return Reply::done();
}

Reply Configuration::load(const Request& request, bool tryOnly) {
    const std::string path = fieldOf(request, "filepath"), action = fieldOf(request, "action-type");
    ConfigurationStore::Load mode = ConfigurationStore::Load::AddOrReplace;
    if (sameName(action, "add"))
        mode = ConfigurationStore::Load::Add;
    else if (sameName(action, "add-with-reset"))
        mode = ConfigurationStore::Load::Replace;
    else if (!action.empty() && !sameName(action, "replace"))
        return badParameter("action-type", "add, replace or add-with-reset");
    const auto file = volumePath(controller_, path);
    std::error_code code;
    if (!file || !std::filesystem::is_regular_file(file->host, code))
        return Reply::refuse(ReturnCode::NoLoadPath, fmt::format("there is no file {}", path));
    std::string bytes;
    if (std::filesystem::file_size(file->host, code) > kLargestFile || code ||
        !rapid::config::readFile(file->host, bytes).empty())
        return Reply::refuse(ReturnCode::TooLarge, fmt::format("{} cannot be read, or is too large", path));
    const service::Refusal refusal = store_.load(bytes, mode, tryOnly);
    if (!refusal.empty()) return Reply::refuse(ReturnCode::BadParameter, refusal);
    if (tryOnly) return Reply::done();
    Reply reply = Reply::done(); // A7 takes 200 and 204 only, and needs the address
    reply.location = progress_.begin("cfg-load");
    progress_.done(reply.location, ReturnCode::Success);
    return reply;
}

Reply Configuration::save(const Request& request) const {
    const std::string domain = ConfigurationStore::domainNamed(request.parameter("domain"));
    if (domain.empty()) return Reply::refuse(noConfigurationDomain(request));
    const auto file = volumePath(controller_, fieldOf(request, "filepath"));
    if (!file) return badParameter("filepath", "/fileservice/$HOME/name.cfg");
    std::string text = store_.text(domain);
    if (text.empty())
        text = fmt::format("{}:CFG_1.0:{}:0::\n#\n", domain, controller_.settings().robotWare == 6 ? 6 : 7);
    const std::size_t colon = file->rapid.find(':');
    bool isNew = false;
    const service::FileResult written =
        volumes_.write(file->rapid.substr(0, colon) + "/" + file->rapid.substr(colon + 1), text, isNew);
    return written.isDone() ? Reply::done() : refuseFile(written);
}

// ---- Routes --------------------------------------------------------------------------------------------------------

void Configuration::subscribe(Subscribables& subscribables) {
    subscribables.add({"/rw/cfg", "", false, std::nullopt,
                       [this](const Request&, const Changed& changed, Subscription& out) {
                           const auto read = [this] {
                               Entry entry;
                               entry.type = "cfg-prop-ev";
                               entry.title = "change-count";
                               entry.value("cc", fmt::format("{}", store_.changes()));
                               return entry;
                           };
                           return watchState(controller_.observers(), {service::Change::Interval}, read,
                                             changed, out);
                       }});
    subscribables.add(
        {"/rw/cfg/{domain}", "", false, std::nullopt,
         [this](const Request& request, const Changed& changed, Subscription& out) -> std::optional<Failure> {
             const std::string domain = ConfigurationStore::domainNamed(request.parameter("domain"));
             if (domain.empty()) return noConfigurationDomain(request);
             // the text is made only when something of the whole configuration has changed
             const auto read = [this, domain, seen = store_.changes(), text = store_.text(domain),
                                count = uint64_t{0}]() mutable {
                 if (std::exchange(seen, store_.changes()) != store_.changes()) {
                     std::string now = store_.text(domain);
                     if (now != text) ++count;
                     text = std::move(now);
                 }
                 Entry entry;
                 entry.type = "cfg-domain-ev";
                 entry.title = domain;
                 entry.value("name", domain).value("change-count", fmt::format("{}", count));
                 return entry;
             };
             return watchState(controller_.observers(), {service::Change::Interval}, read, changed, out);
         }});
}

void Configuration::addTo(Router& router, Subscribables& subscribables) {
    subscribe(subscribables);
    const std::string all = "/rw/cfg", domain = all + "/{domain}", type = domain + "/{type}";
    const std::string instances = type + "/instances", one = instances + "/{name*}";
    router.getBoth(all, [this](const Request& r) { return domains(r); });
    router.getBoth(domain, [this](const Request& r) { return types(r); });
    router.getBoth(type, [this](const Request& r) { return this->type(r); });
    router.getBoth(type + "/attributes", [this](const Request& r) { return attributes(r); });
    router.getBoth(instances, [this](const Request& r) { return this->instances(r); });
    router.getBoth(one, [this](const Request& r) { return instance(r); });

    const auto guarded = [this](Handler handler) { return access_.guarded(Domain::Cfg, std::move(handler)); };
    const Handler set = guarded([this](const Request& r) { return this->set(r); });
    const Handler create = guarded([this](const Request& r) { return this->create(r); });
    const Handler remove = guarded([this](const Request& r) { return this->remove(r); });
    router.action(one, "set", set);
    router.post(Dialect::V2, one, set);
    addOrder(router, instances, "create-default", "create-default", create);
    addOrder(router, instances, "create", "create", create);
    router.action(one, "remove", remove);
    router.addBoth({Method::Delete, one, {}, remove});
    addOrder(router, all, "load", "load", guarded([this](const Request& r) { return load(r, false); }));
    addOrder(router, all, "validate", "validate", [this](const Request& r) { return load(r, true); });
    router.post(Dialect::V2, all + "/validate-instances",
                [this](const Request& r) { return validateInstances(r); });
    addOrder(router, domain, "saveas", "saveas", [this](const Request& r) { return save(r); });
    addOrder(router, domain, "save", "save", [this](const Request& r) { return save(r); });
}

} // namespace rapidc::rws
