#include "tools/rws/event_log_pages.h"

#include "config/text_util.h"
#include "tools/rws/file_service.h"
#include "tools/rws/rapid_support.h"
#include "tools/rws/request_values.h"

#include <fmt/format.h>

#include <algorithm>

namespace rapidc::rws {

namespace {

using rapid::config::sameName;
using service::EventDomain;
using service::EventMessage;

constexpr std::size_t kMostMessagesOnPage = 50;

/// Controllers give the arguments of texts with their types.
const char* typeOf(const std::string& argument) {
    if (!numberIn(argument)) return "string";
    return argument.find_first_of(".eE") == std::string::npos ? "long" : "float";
}

void describe(const EventMessage& message, Entry& entry) {
    entry.value("msgtype", fmt::format("{}", static_cast<int>(message.type)));
    entry.value("code", fmt::format("{}", message.code));
    entry.value("src-name", message.task.empty() ? "MC0" : message.task);
    entry.value("tstamp", service::calendarText(message.calendarSeconds));
    entry.value("argc", fmt::format("{}", message.arguments.size()));
    entry.nestedName = "argv";
    entry.isNestedOnlyInJson = true;
    for (std::size_t i = 0; i < message.arguments.size(); ++i) {
        const std::string name = fmt::format("arg{}", i + 1);
        entry.value(name, message.arguments[i]);
        Entry argument;
        argument.type = "elog-arg";
        argument.title = name;
        argument.value("type", typeOf(message.arguments[i])).value("value", message.arguments[i]);
        entry.nested.push_back(std::move(argument));
    }
    entry.value("title", message.title)
        .value("desc", message.description)
        .value("conseqs", message.consequences);
    entry.value("causes", message.causes).value("actions", message.actions);
}

/// The number of the domain in the path; none when there is no such domain.
std::optional<int> domainIn(const Request& request) {
    const auto number = countIn(request.parameter("domain"));
    const auto& all = service::eventDomains();
    const bool isKnown = number && std::any_of(all.begin(), all.end(), [&](const EventDomain& each) {
                             return each.number == static_cast<int>(*number);
                         });
    return isKnown ? std::optional(static_cast<int>(*number)) : std::nullopt;
}

Reply noLogDomain(const Request& request) {
    return Reply::refuse(ReturnCode::NotFound,
                         fmt::format("the event log has no domain {}", request.parameter("domain")));
}

class LogWatch final : public Watch {
  public:
    LogWatch(service::EventJournal& journal, int domain, Changed changed) : journal_(journal) {
        listener_ = journal.addListener([domain, changed = std::move(changed)](const EventMessage& message) {
            if (domain != 0 && domain != message.domain()) return;
            Entry entry;
            entry.type = "elog-message-ev";
            entry.title = entry.self = fmt::format("/rw/elog/{}/{}", domain, message.number);
            entry.value("seqnum", fmt::format("{}", message.number));
            changed(std::move(entry));
        });
    }
    ~LogWatch() override { journal_.removeListener(listener_); }

  private:
    service::EventJournal& journal_;
    uint64_t listener_;
};

} // namespace

void EventLogPages::describeDomain(const EventDomain& domain, Entry& entry) const {
    entry.self = fmt::format("/rw/elog/{}", domain.number);
    entry.value("domain-name", domain.name);
    entry.value("numevts", fmt::format("{}", journal_.messages(domain.number).size()));
    entry.value("buffsize", fmt::format("{}", service::EventJournal::kKept));
}

Reply EventLogPages::domains(const Request&) const {
    Document document;
    document.place = Document::Place::Resources;
    for (const EventDomain& domain : service::eventDomains())
        describeDomain(domain, document.add("elog-domain-li", fmt::format("{}", domain.number)));
    return Reply::of(std::move(document));
}

/// ?resource=info: how many messages a domain has, and can have.
Reply EventLogPages::domain(int number) const {
    Document document;
    document.place = Document::Place::Resources;
    for (const EventDomain& domain : service::eventDomains())
        if (domain.number == number)
            describeDomain(domain, document.add("elog-domain", fmt::format("{}", number)));
    return Reply::of(std::move(document));
}

Reply EventLogPages::list(const Request& request) const {
    const auto domain = domainIn(request);
    if (!domain) return noLogDomain(request);
    if (sameName(request.query.text("resource"), "info")) return this->domain(*domain);
    const std::string order = request.query.text("order"), after = request.query.text("elogseqnum");
    if (!order.empty() && !sameName(order, "lifo") && !sameName(order, "fifo"))
        return Reply::refuse(ReturnCode::BadParameter, "order is lifo or fifo");
    const bool newestFirst = order.empty() ? request.dialect == Dialect::V1 : sameName(order, "lifo");
    const auto& all = journal_.messages(*domain);
    std::size_t skipped = 0; // older than asked for
    if (const auto number = countIn(after))
        while (skipped < all.size() && all[skipped]->number <= *number)
            ++skipped;
    const std::size_t total = all.size() - skipped;
    ListPage page;
    const bool countsPages = request.dialect == Dialect::V2;
    if (const auto failure = readListPage(request, total, kMostMessagesOnPage, page, countsPages))
        return Reply::refuse(*failure);
    Document document;
    document.place = Document::Place::Resources;
    document.next = page.next;
    if (const std::size_t size = page.end - page.begin; countsPages && !page.next.empty())
        document.links.emplace_back(
            "last", fmt::format("/rw/elog/{}?start={}&limit={}", *domain, (total + size - 1) / size, size));
    for (std::size_t i = page.begin; i < page.end; ++i) {
        const EventMessage& message = *all[newestFirst ? all.size() - 1 - i : skipped + i];
        Entry& entry =
            document.add("elog-message-li", fmt::format("/rw/elog/{}/{}", *domain, message.number));
        // The App SDK reads the number between the slashes: relative to the folder of the log.
        entry.self = countsPages ? fmt::format("{}/{}", *domain, message.number) : entry.title;
        describe(message, entry);
    }
    return Reply::of(std::move(document));
}

Reply EventLogPages::one(const Request& request) const {
    const bool byNumberAlone = request.parameters.count("domain") == 0;
    const auto domain = byNumberAlone ? std::optional(0) : domainIn(request);
    if (!domain) return noLogDomain(request);
    const auto number = countIn(request.parameter("number"));
    const auto message = number ? journal_.find(*domain, *number) : nullptr;
    if (!message)
        return Reply::refuse(ReturnCode::NotFound, fmt::format("there is no message {} in domain {}",
                                                               request.parameter("number"), *domain));
    Document document;
    if (!byNumberAlone) document.place = Document::Place::Resources;
    Entry& entry = document.add("elog-message", fmt::format("/rw/elog/{}/{}", *domain, message->number));
    entry.self = entry.title;
    describe(*message, entry);
    return Reply::of(std::move(document));
}

Reply EventLogPages::clear(const Request& request) {
    const auto domain = domainIn(request);
    if (!domain) return noLogDomain(request);
    journal_.clear(*domain);
    return Reply::done();
}

Reply EventLogPages::clearAll(const Request&) {
    journal_.clearAll();
    return Reply::done();
}

/// All messages as text, one line each, into a file of a volume.
Reply EventLogPages::saveRaw(const Request& request) const {
    const std::string path = pathInVolume(fieldOf(request, "path"));
    if (path.find('/') == std::string::npos) return badParameter("path", "/fileservice/$HOME/name.txt");
    std::string text = "Number\tTime\tType\tCode\tTitle\tDescription\n";
    for (const auto& message : journal_.messages(0))
        text += fmt::format("{}\t{}\t{}\t{}\t{}\t{}\n", message->number,
                            service::calendarText(message->calendarSeconds), static_cast<int>(message->type),
                            message->code, message->title, message->description);
    bool isNew = false;
    if (const service::FileResult written = volumes_.write(path, text, isNew); !written.isDone())
        return refuseFile(written);
    Reply reply = Reply::done(202);
    reply.location = progress_.begin("saveraw");
    progress_.done(reply.location, ReturnCode::Success);
    return reply;
}

void EventLogPages::addTo(Router& router, Subscribables& subscribables) {
    const std::string all = "/rw/elog", domain = all + "/{domain}";
    router.getBoth(all, [this](const Request& r) { return domains(r); });
    router.getBoth(domain, [this](const Request& r) { return list(r); });
    router.getBoth(domain + "/{number}", [this](const Request& r) { return one(r); });
    router.getBoth(all + "/seqnum/{number}", [this](const Request& r) { return one(r); });
    addOrder(router, all, "saveraw", "saveraw", [this](const Request& r) { return saveRaw(r); });
    router.action(domain, "clear", [this](const Request& r) { return clear(r); });
    router.action(all, "clearall", [this](const Request& r) { return clearAll(r); });
    router.post(Dialect::V2, domain + "/clear", [this](const Request& r) { return clear(r); });
    router.post(Dialect::V2, all + "/clearall", [this](const Request& r) { return clearAll(r); });
    Subscribable messages;
    messages.pattern = domain;
    messages.open = [this](const Request& request, const Changed& changed, Subscription& out) {
        const auto number = domainIn(request);
        if (!number)
            return std::optional(
                Failure{ReturnCode::NotFound,
                        fmt::format("the event log has no domain {}", request.parameter("domain")), 0});
        out.watch = std::make_unique<LogWatch>(journal_, *number, changed);
        return std::optional<Failure>();
    };
    subscribables.add(std::move(messages));
}

} // namespace rapidc::rws
