#include "tools/rws/subscriptions.h"

#include "tools/http/url.h"
#include "tools/rws/path_pattern.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>

namespace rapidc::rws {

namespace {

bool isNumber(std::string_view text) {
    return !text.empty() &&
           std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

uint64_t numberOf(std::string_view text) {
    uint64_t number = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
    return problem == std::errc() && end == text.data() + text.size() ? number : 0;
}

/// Some clients encode the path once more, some write the whole address.
std::string plainPath(std::string text) {
    if (text.find('/') == std::string::npos || text.find('%') != std::string::npos)
        if (const auto decoded = http::decodePercent(text)) text = *decoded;
    if (const std::size_t scheme = text.find("://"); scheme != std::string::npos) {
        const std::size_t slash = text.find('/', scheme + 3);
        text = slash == std::string::npos ? "/" : text.substr(slash);
    }
    return text;
}

std::string pollAddress(const Request& request, uint64_t number) {
    const std::size_t scheme = request.base.find("://");
    return fmt::format("{}{}/poll/{}", request.dialect == Dialect::V1 ? "ws" : "wss",
                       scheme == std::string::npos ? "://" + request.base : request.base.substr(scheme),
                       number);
}

} // namespace

Subscriptions::~Subscriptions() = default;

void Subscriptions::addTo(Router& router) {
    router.postBoth("/subscription", [this](const Request& request) { return create(request); });
    router.getBoth("/subscription", [this](const Request& request) { return show(request); });
    router.getBoth("/subscription/{id}", [this](const Request& request) { return show(request); });
    for (const Method method : {Method::Put, Method::Post})
        router.addBoth(
            {method, "/subscription/{id}", "", [this](const Request& request) { return change(request); }});
    router.addBoth({Method::Delete, "/subscription/{id}", "",
                    [this](const Request& request) { return remove(request); }});
    router.addBoth({Method::Delete, "/subscription/{id}/{resource*}", "",
                    [this](const Request& request) { return removeResource(request); }});
}

// ---- What a client wants ---------------------------------------------------------------------------------------------

/// Fields whose names are numbers are resources; NUMBER-p is the priority.
std::optional<Failure> Subscriptions::read(const Request& request, std::vector<Wanted>& wanted) {
    Fields form = request.form;
    if (form.all().empty() && !request.body.empty()) { // of PUT
        const auto fields = http::parseFields(request.body);
        if (!fields) return Failure{ReturnCode::BadParameter, "the form is not well formed"};
        for (const auto& [name, value] : *fields)
            form.add(name, value);
    }
    for (const auto& [name, value] : form.all()) {
        if (!isNumber(name)) continue;
        Wanted one{plainPath(value), 1};
        if (form.has(name + "-p")) {
            const std::string priority = form.text(name + "-p");
            if (priority != "0" && priority != "1" && priority != "2")
                return Failure{ReturnCode::BadParameter,
                               fmt::format("the priority of {} must be 0, 1 or 2", value)};
            one.priority = priority.front() - '0';
        }
        wanted.push_back(std::move(one));
    }
    if (wanted.empty())
        return Failure{ReturnCode::BadParameter,
                       "resources to subscribe to are missing: resources=1&1=PATH;RESOURCE&1-p=1"};
    return std::nullopt;
}

/// Opens all of them or none.
std::optional<Failure> Subscriptions::open(Group& group, const Request& request,
                                           const std::vector<Wanted>& wanted, std::vector<Entry>& initial) {
    std::vector<std::shared_ptr<Item>> items = group.items;
    for (const Wanted& one : wanted) {
        const auto present = std::find_if(items.begin(), items.end(),
                                          [&](const auto& item) { return item->text == one.text; });
        if (present != items.end()) {
            (*present)->priority = one.priority;
            continue;
        }
        auto item = std::make_shared<Item>();
        item->text = one.text;
        item->priority = one.priority;
        item->group = &group;
        if (auto failure = openItem(request, *item, initial)) return failure;
        items.push_back(std::move(item));
    }
    const auto high =
        std::count_if(items.begin(), items.end(), [](const auto& item) { return item->priority == 2; });
    if (static_cast<std::size_t>(high) > kMostHigh)
        return Failure{ReturnCode::BadParameter, "at most 64 resources of a group may have priority 2"};
    if (items.size() > kMostResources)
        return Failure{ReturnCode::TooLarge, fmt::format("a group has at most {} resources", kMostResources)};
    group.items = std::move(items);
    return std::nullopt;
}

std::optional<Failure> Subscriptions::openItem(const Request& request, Item& item,
                                               std::vector<Entry>& initial) {
    Request resource;
    resource.dialect = request.dialect;
    resource.session = request.session;
    resource.base = request.base;
    const Subscribable* subscribable = subscribables_.find(item.text, resource);
    if (subscribable == nullptr)
        return Failure{ReturnCode::NotFound, fmt::format("{} cannot be subscribed", item.text)};
    Subscription subscription;
    const auto notify = [this, &item](Entry entry) { changed(item, std::move(entry)); };
    if (auto failure = subscribable->open(resource, notify, subscription)) return failure;
    item.watch = std::move(subscription.watch);
    item.queued.clear();
    for (Entry& entry : subscription.initial) {
        entry.self = addressOf(entry, item);
        initial.push_back(std::move(entry));
    }
    return std::nullopt;
}

// ---- Requests --------------------------------------------------------------------------------------------------------

Reply Subscriptions::create(const Request& request) {
    std::vector<Wanted> wanted;
    if (auto failure = read(request, wanted)) return Reply::refuse(failure->code, failure->message);
    const auto own = std::count_if(groups_.begin(), groups_.end(), [&](const auto& item) {
        return item.second.outlet->session == request.session->number;
    });
    if (static_cast<std::size_t>(own) >= kMostGroups)
        return Reply::refuse(ReturnCode::Rejected, "too many subscriptions: delete one", 503);
    const uint64_t number = ++last_;
    Group& group = groups_[number];
    group.number = number;
    group.dialect = request.dialect;
    group.base = request.base;
    group.outlet = std::make_shared<Outlet>(request.session->number, request.dialect == Dialect::V1);
    Document document;
    if (auto failure = open(group, request, wanted, document.entries)) {
        groups_.erase(number);
        return Reply::refuse(failure->code, failure->message, failure->status);
    }
    {
        const std::lock_guard lock(mutex_);
        outlets_[number] = group.outlet;
    }
    document.self = pollAddress(request, number);
    document.links.emplace_back("group", fmt::format("subscription/{}", number));
    Reply reply = Reply::of(std::move(document), 201);
    reply.location = pollAddress(request, number);
    return reply;
}

Subscriptions::Group* Subscriptions::groupOf(const Request& request) {
    const auto found = groups_.find(numberOf(request.parameter("id")));
    const bool isOwn = found != groups_.end() && found->second.outlet->session == request.session->number;
    return isOwn ? &found->second : nullptr;
}

namespace {
Reply noGroup(const Request& request) {
    return Reply::refuse(ReturnCode::NotFound,
                         fmt::format("there is no subscription {}", request.parameter("id")));
}
} // namespace

Reply Subscriptions::change(const Request& request) {
    Group* group = groupOf(request);
    if (group == nullptr) return noGroup(request);
    std::vector<Wanted> wanted;
    if (auto failure = read(request, wanted)) return Reply::refuse(failure->code, failure->message);
    Document document;
    if (auto failure = open(*group, request, wanted, document.entries))
        return Reply::refuse(failure->code, failure->message, failure->status);
    document.links.emplace_back("group", fmt::format("subscription/{}", group->number));
    return Reply::of(std::move(document));
}

Reply Subscriptions::show(const Request& request) {
    Document document;
    if (request.parameters.empty()) {
        for (const auto& [number, group] : groups_) {
            if (group.outlet->session != request.session->number) continue;
            Entry& entry = document.add("subscription-li", std::to_string(number));
            entry.self = fmt::format("/subscription/{}", number);
            entry.value("resources", std::to_string(group.items.size()));
        }
        return Reply::of(std::move(document));
    }
    const Group* group = groupOf(request);
    if (group == nullptr) return noGroup(request);
    for (const auto& item : group->items)
        document.add("subscription-resource-li", item->text)
            .value("resource", item->text)
            .value("priority", std::to_string(item->priority));
    return Reply::of(std::move(document));
}

Reply Subscriptions::remove(const Request& request) {
    const Group* group = groupOf(request);
    if (group == nullptr) return noGroup(request);
    drop(group->number);
    return Reply::done(200);
}

Reply Subscriptions::removeResource(const Request& request) {
    Group* group = groupOf(request);
    if (group == nullptr) return noGroup(request);
    const std::vector<std::string> named = splitPath(request.parameter("resource"));
    const auto before = group->items.size();
    std::erase_if(group->items, [&](const auto& item) { return splitPath(item->text) == named; });
    if (group->items.size() == before)
        return Reply::refuse(ReturnCode::NotFound, "the resource is not part of the subscription");
    return Reply::done(200);
}

void Subscriptions::drop(uint64_t number) {
    const auto found = groups_.find(number);
    if (found == groups_.end()) return;
    found->second.outlet->close();
    groups_.erase(found);
    const std::lock_guard lock(mutex_);
    outlets_.erase(number);
}

void Subscriptions::sessionEnded(uint64_t session) {
    std::vector<uint64_t> ended;
    for (const auto& [number, group] : groups_)
        if (group.outlet->session == session) ended.push_back(number);
    for (const uint64_t number : ended)
        drop(number);
}

} // namespace rapidc::rws
