#include "tools/rws/subscriptions.h"

#include "config/letter_case.h"
#include "tools/rws/subscription_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>
#include <unordered_map>

namespace rapidc::rws {

namespace {

constexpr std::size_t kMostResources = 1000;        ///< in a group
constexpr std::size_t kMostGroups = 32;             ///< of a session
constexpr std::size_t kMostMessagesInPeriod = 1000; ///< of a topic within a period
constexpr std::size_t kMostSpent = 500;             ///< groups whose socket has closed
constexpr std::size_t kMostImmediate = 64;          ///< resources of priority 2 in a group

Failure bad(std::string message) {
    return {ReturnCode::BadParameter, std::move(message), 400};
}

/// Some clients escape the path a second time inside the form, some write the whole address.
std::string plainText(const std::string& text) {
    std::string plain = http::decodePercent(text).value_or(text);
    const std::size_t scheme = plain.find("://");
    if (plain.starts_with('/') || scheme == std::string::npos) return plain;
    const std::size_t path = plain.find('/', scheme + 3);
    return path == std::string::npos ? "/" : plain.substr(path);
}

/// The path of a subscribed text, without its resource.
std::string_view pathOf(std::string_view text) {
    return text.substr(0, text.rfind(';'));
}

uint64_t numberOf(const std::string& text) {
    uint64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size() ? number : 0;
}

/// "http://host" -> "ws://host".
std::string socketBaseOf(const std::string& base) {
    return "ws" + base.substr(std::min<std::size_t>(4, base.size()));
}

bool isNumber(const std::string& text) {
    return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
}

/// The names of the fields that hold paths: "resources" names each of them, or some clients write their count there.
std::vector<std::string> resourceIds(const Fields& form) {
    std::vector<std::string> ids;
    std::set<std::string> known;
    for (const auto& [name, value] : form.all()) {
        const bool isName = rapid::config::sameName(name, "resources");
        const std::string& id = isName ? value : name;
        if ((isName || isNumber(name)) && known.insert(rapid::config::lowerCase(id)).second)
            ids.push_back(id);
    }
    return ids;
}

/// Messages are sent one by one; all else is a state whose last value counts.
bool isMessage(const Entry& entry) {
    return entry.type == "elog-message-ev" || entry.type == "rap-ui-ev" || entry.type == "dipc-msg-ev";
}

/// An entry of an event: the anchor of rel=self repeats what was subscribed.
Entry eventEntry(Entry entry, Dialect dialect, const std::string& text) {
    // The first anchor is the one that the clients of these two read: the message of the log, which they expect as rel=self, and the
    // symbol without ";value".
    entry.links.clear();
    if (entry.type == "elog-message-ev" && !entry.self.empty())
        entry.links.emplace_back("self", entry.self);
    else if (dialect == Dialect::V2 && rapid::config::beginsWithName(text, "/rw/rapid/symbol/") &&
             text.ends_with(";value"))
        entry.links.emplace_back("symbol", std::string(pathOf(text)));
    entry.self = text;
    return entry;
}

} // namespace

Subscriptions::Subscriptions(const Subscribables& subscribables, Post post, Post postToNetwork)
    : subscribables_(subscribables), post_(std::move(post)), postToNetwork_(std::move(postToNetwork)) {}

Subscriptions::~Subscriptions() = default;

void Subscriptions::addTo(Router& router) {
    router.postBoth("/subscription", [this](const Request& request) { return create(request); });
    router.getBoth("/subscription", [this](const Request& request) { return show(request); });
    router.getBoth("/subscription/{group}", [this](const Request& request) { return show(request); });
    router.addBoth({Method::Put, "/subscription/{group}", {}, [this](const Request& request) {
                        return change(request);
                    }});
    router.postBoth("/subscription/{group}", [this](const Request& request) { return change(request); });
    router.addBoth({Method::Delete, "/subscription/{group}", {}, [this](const Request& request) {
                        return remove(request);
                    }});
    router.addBoth({Method::Delete, "/subscription/{group}/{resource*}", {}, [this](const Request& request) {
                        return removeResource(request);
                    }});
}

std::optional<Failure> Subscriptions::readRequested(const Request& request,
                                                    std::vector<Requested>& requested) const {
    std::unordered_map<std::string, const std::string*> fields; // a form may have thousands
    for (const auto& [name, value] : request.form.all())
        fields.emplace(rapid::config::lowerCase(name), &value);
    const auto valueOf = [&](const std::string& name) {
        const auto found = fields.find(rapid::config::lowerCase(name));
        return found == fields.end() ? nullptr : found->second;
    };
    for (const std::string& id : resourceIds(request.form)) {
        const std::string* text = valueOf(id);
        Requested one{text ? *text : "", 1};
        if (one.text.empty())
            return bad(fmt::format("The form has no field '{}' with the path of a resource.", id));
        if (const std::string* priority = valueOf(id + "-p")) {
            if (*priority != "0" && *priority != "1" && *priority != "2")
                return bad("The priority is 0, 1 or 2.");
            one.priority = (*priority)[0] - '0';
        }
        requested.push_back(std::move(one));
        if (requested.size() > kMostResources)
            return bad(fmt::format("A group has at most {} resources.", kMostResources));
    }
    if (requested.empty()) return bad("The form names no resources.");
    return std::nullopt;
}

Reply Subscriptions::create(const Request& request) {
    const auto mine = std::count_if(groups_.begin(), groups_.end(), [&](const auto& each) {
        return each.second->session == request.session->number;
    });
    if (static_cast<std::size_t>(mine) >= kMostGroups)
        return Reply::refuse(ReturnCode::Rejected,
                             fmt::format("A session has at most {} groups.", kMostGroups), 400);
    std::vector<Requested> requested;
    if (const auto failure = readRequested(request, requested)) return Reply::refuse(*failure);
    auto group = std::make_unique<Group>();
    group->id = ++lastGroup_;
    group->session = request.session->number;
    group->outlet = std::make_shared<Outlet>();
    group->outlet->id = group->id;
    group->outlet->session = group->session;
    group->outlet->dialect = request.dialect;
    Document document;
    const auto failure = subscribe(request, *group, requested, document.entries);
    if (failure) {
        for (const auto& [text, resource] : group->resources)
            disconnect(resource.topic, group->outlet);
        return Reply::refuse(*failure);
    }
    document.self = fmt::format("{}/poll/{}", socketBaseOf(request.base), group->id);
    document.links.emplace_back("group", fmt::format("subscription/{}", group->id));
    {
        const std::lock_guard lock(mutex_);
        outlets_[group->id] = group->outlet;
    }
    groups_[group->id] = std::move(group);
    Reply reply = Reply::of(std::move(document), 201);
    reply.location = reply.document->self;
    return reply;
}

Reply Subscriptions::change(const Request& request) {
    Group* group = groupOf(request);
    if (!group) return Reply::refuse(ReturnCode::NotFound, "There is no such group of subscriptions.");
    std::vector<Requested> requested;
    auto failure = readRequested(request, requested);
    Document document;
    if (!failure) failure = subscribe(request, *group, requested, document.entries);
    if (failure) return Reply::refuse(*failure);
    document.self = fmt::format("{}/poll/{}", socketBaseOf(request.base), group->id);
    document.links.emplace_back("group", fmt::format("subscription/{}", group->id));
    return Reply::of(std::move(document), 200);
}

std::optional<Failure> Subscriptions::subscribe(const Request& request, Group& group,
                                                const std::vector<Requested>& requested,
                                                std::vector<Entry>& initial) {
    std::map<std::string, int> priorities;
    for (const auto& [text, resource] : group.resources)
        priorities[text] = resource.priority;
    for (const Requested& one : requested)
        priorities[one.text] = one.priority;
    const auto immediate = std::count_if(priorities.begin(), priorities.end(),
                                         [](const auto& each) { return each.second == 2; });
    if (static_cast<std::size_t>(immediate) > kMostImmediate)
        return bad(fmt::format("At most {} resources of a group have priority 2.", kMostImmediate));
    if (priorities.size() > kMostResources)
        return bad(fmt::format("A group has at most {} resources.", kMostResources));
    // All or nothing: first open, then connect.
    std::vector<std::shared_ptr<Topic>> topics;
    std::optional<Failure> failure;
    for (const Requested& one : requested) {
        std::shared_ptr<Topic> topic;
        failure = openTopic(request, one.text, topic, initial);
        if (failure) break;
        topics.push_back(std::move(topic));
    }
    for (std::size_t i = 0; !failure && i < requested.size(); ++i) {
        const auto found = group.resources.find(requested[i].text);
        if (found != group.resources.end()) detach(*found->second.topic, group.outlet); // its watch stays
        connect(*topics[i], group.outlet, requested[i].priority);
        group.resources[requested[i].text] = {topics[i], requested[i].priority};
        topics_[{request.dialect, requested[i].text}] = topics[i];
    }
    for (const std::shared_ptr<Topic>& topic : topics)
        closeIfUnused(topic);
    return failure;
}

std::optional<Failure> Subscriptions::openTopic(const Request& request, const std::string& text,
                                                std::shared_ptr<Topic>& topic, std::vector<Entry>& initial) {
    Request wanted; // without the form
    wanted.dialect = request.dialect;
    wanted.base = request.base;
    wanted.session = request.session;
    wanted.connection = request.connection;
    const Subscribable* subscribable = subscribables_.find(plainText(text), wanted);
    if (!subscribable) return bad(fmt::format("'{}' cannot be subscribed to.", text));
    auto& known = topics_[{request.dialect, text}];
    const bool isNew = !known;
    if (isNew) {
        known = std::make_shared<Topic>(++lastTopic_);
        known->dialect = request.dialect;
        known->text = text;
    }
    Subscription opened;
    const Changed notify = [this, weak = std::weak_ptr<Topic>(known)](Entry entry) {
        if (const auto strong = weak.lock()) changed(strong, std::move(entry));
    };
    // Another client's watch serves this one too; the second one only asks for the initial values.
    const auto failure = subscribable->open(wanted, isNew ? notify : Changed([](Entry) {}), opened);
    if (failure) {
        if (isNew) topics_.erase({request.dialect, text});
        Failure answer = *failure;
        if (answer.status != 404) answer.status = 400;
        return answer;
    }
    if (isNew) known->watch = std::move(opened.watch);
    for (Entry& entry : opened.initial)
        initial.push_back(eventEntry(std::move(entry), request.dialect, text));
    topic = known;
    return std::nullopt;
}

void Subscriptions::connect(Topic& topic, const std::shared_ptr<Outlet>& outlet, int priority) {
    const std::lock_guard lock(mutex_);
    auto outlets = std::make_shared<std::vector<std::shared_ptr<Outlet>>>(*topic.outlets[priority]);
    outlets->push_back(outlet);
    topic.outlets[priority] = std::move(outlets);
}

void Subscriptions::detach(Topic& topic, const std::shared_ptr<Outlet>& outlet) {
    const std::lock_guard lock(mutex_);
    for (Outlets& present : topic.outlets) {
        auto outlets = std::make_shared<std::vector<std::shared_ptr<Outlet>>>(*present);
        std::erase(*outlets, outlet);
        present = std::move(outlets);
    }
}

void Subscriptions::disconnect(const std::shared_ptr<Topic>& topic, const std::shared_ptr<Outlet>& outlet) {
    detach(*topic, outlet);
    closeIfUnused(topic);
}

void Subscriptions::closeIfUnused(const std::shared_ptr<Topic>& topic) {
    {
        const std::lock_guard lock(mutex_);
        for (const Outlets& outlets : topic->outlets)
            if (!outlets->empty()) return;
    }
    topic->watch.reset();
    const auto found = topics_.find({topic->dialect, topic->text});
    if (found != topics_.end() && found->second == topic) topics_.erase(found);
}

Subscriptions::Group* Subscriptions::groupOf(const Request& request) {
    const auto found = groups_.find(numberOf(request.parameter("group")));
    const bool isMine = found != groups_.end() && found->second->session == request.session->number;
    return isMine ? found->second.get() : nullptr;
}

Reply Subscriptions::show(const Request& request) {
    Document document;
    for (const auto& [id, group] : groups_) {
        if (group->session != request.session->number) continue;
        if (!request.parameter("group").empty() && id != numberOf(request.parameter("group"))) continue;
        for (const auto& [text, resource] : group->resources)
            document.add("subscription-li", std::to_string(id))
                .value("resource", text)
                .value("priority", std::to_string(resource.priority));
    }
    if (!request.parameter("group").empty() && !groupOf(request))
        return Reply::refuse(ReturnCode::NotFound, "There is no such group of subscriptions.");
    return Reply::of(std::move(document));
}

Reply Subscriptions::remove(const Request& request) {
    const Group* group = groupOf(request);
    if (group) {
        removeGroup(group->id);
        return Reply::done(200);
    }
    const auto spent = std::find_if(spent_.begin(), spent_.end(), [&](const auto& each) {
        return each.second == request.session->number && each.first == numberOf(request.parameter("group"));
    });
    if (spent == spent_.end())
        return Reply::refuse(ReturnCode::NotFound, "There is no such group of subscriptions.");
    spent_.erase(spent);
    return Reply::done(200);
}

Reply Subscriptions::removeResource(const Request& request) {
    Group* group = groupOf(request);
    if (!group) return Reply::refuse(ReturnCode::NotFound, "There is no such group of subscriptions.");
    const std::string wanted = "/" + request.parameter("resource");
    const auto find = [&](auto fits) {
        return std::find_if(group->resources.begin(), group->resources.end(), fits);
    };
    auto found =
        find([&](const auto& each) { return rapid::config::sameName(plainText(each.first), wanted); });
    if (found == group->resources.end())
        found = find(
            [&](const auto& each) { return rapid::config::sameName(pathOf(plainText(each.first)), wanted); });
    if (found == group->resources.end())
        return Reply::refuse(ReturnCode::NotFound, "The group does not have this resource.");
    disconnect(found->second.topic, group->outlet);
    group->resources.erase(found);
    return Reply::done(200);
}

void Subscriptions::removeGroup(uint64_t id) {
    const auto found = groups_.find(id);
    if (found == groups_.end()) return;
    const std::unique_ptr<Group> group = std::move(found->second);
    groups_.erase(found);
    for (const auto& [text, resource] : group->resources)
        disconnect(resource.topic, group->outlet);
    {
        const std::lock_guard lock(mutex_);
        outlets_.erase(id);
    }
    postToNetwork_([this, outlet = group->outlet] {
        outlet->stop();
        ending_.emplace_back(std::chrono::steady_clock::now() + kUntilClosed, outlet);
    });
}

void Subscriptions::sessionEnded(uint64_t session) {
    std::vector<uint64_t> ended;
    for (const auto& [id, group] : groups_)
        if (group->session == session) ended.push_back(id);
    for (const uint64_t id : ended)
        removeGroup(id);
    std::erase_if(spent_, [session](const auto& each) { return each.second == session; });
}

void Subscriptions::dropLater(uint64_t group) {
    post_([this, group] {
        const auto found = groups_.find(group);
        if (found == groups_.end()) return;
        spent_.emplace_back(group, found->second->session);
        if (spent_.size() > kMostSpent) spent_.pop_front();
        removeGroup(group);
    });
}

void Subscriptions::changed(const std::shared_ptr<Topic>& topic, Entry entry) {
    entry = eventEntry(std::move(entry), topic->dialect, topic->text);
    bool mustSchedule = false;
    {
        const std::lock_guard lock(mutex_);
        for (int priority = 0; priority < 2; ++priority) {
            if (topic->outlets[priority]->empty()) continue;
            std::deque<Entry>& messages = topic->messages[priority];
            if (messages.size() >= kMostMessagesInPeriod) { // more than anybody reads within a period
                messages.back() = entry;
                continue;
            }
            if (isMessage(entry) || !topic->isDirty[priority]) dirty_[priority].push_back(topic);
            topic->isDirty[priority] = true;
            if (isMessage(entry))
                messages.push_back(entry);
            else
                topic->latest = entry;
        }
        if (!topic->outlets[2]->empty()) {
            now_.push_back({topic, std::move(entry)});
            mustSchedule = !std::exchange(isScheduled_, true);
        }
    }
    if (mustSchedule) postToNetwork_([this] { sendNow(); });
}

} // namespace rapidc::rws
