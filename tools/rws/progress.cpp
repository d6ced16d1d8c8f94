#include "tools/rws/progress.h"

#include "tools/rws/request_values.h"
#include "tools/rws/state_watch.h"

#include <fmt/format.h>

namespace rapidc::rws {

namespace {

constexpr std::string_view kProgressPath = "/progress/";

uint64_t numberIn(const Request& request) {
    return countIn(request.parameter("id")).value_or(0);
}

Failure unknown(const Request& request) {
    return {ReturnCode::NotFound, fmt::format("unknown progress {}", request.parameter("id")), 0};
}

} // namespace

std::string Progress::begin(const std::string& operation) {
    works_[++last_] = {operation, false, ReturnCode::Success};
    if (works_.size() > kKept) works_.erase(works_.begin());
    return fmt::format("{}{}", kProgressPath, last_);
}

void Progress::done(const std::string& path, ReturnCode code) {
    const auto number = countIn(std::string_view(path).substr(std::min(kProgressPath.size(), path.size())));
    const auto found = works_.find(number.value_or(0));
    if (found == works_.end()) return;
    found->second.isReady = true;
    found->second.code = code;
}

void Progress::describe(const Work& work, Entry& entry) {
    entry.value("state", work.isReady ? "ready" : "pending")
        .value("code", fmt::format("{}", static_cast<int>(work.code)));
}

void Progress::addTo(Router& router, Subscribables& subscribables) {
    for (const char* resource : {"", "state"}) // clients write either
        subscribables.add({"/progress/{id}", resource, false, std::nullopt,
                           [this](const Request& request, const Changed& changed,
                                  Subscription& out) -> std::optional<Failure> {
                               const uint64_t id = numberIn(request);
                               if (!works_.contains(id)) return unknown(request);
                               const auto read = [this, id] {
                                   Entry entry;
                                   entry.type = "progress-ev";
                                   const auto found = works_.find(id);
                                   if (found == works_.end()) return entry; // old work is forgotten
                                   entry.title = found->second.operation;
                                   describe(found->second, entry);
                                   return entry;
                               };
                               return watchState(observers_, {service::Change::Interval}, read, changed, out);
                           }});
    router.getBoth("/progress", [this](const Request&) {
        Document document;
        for (const auto& [number, work] : works_) {
            Entry& entry = document.add("progress-li", work.operation);
            entry.self = fmt::format("{}{}", kProgressPath, number);
            entry.value("state", work.isReady ? "ready" : "pending");
        }
        return Reply::of(std::move(document));
    });
    router.getBoth("/progress/{id}", [this](const Request& request) {
        const auto found = works_.find(numberIn(request));
        if (found == works_.end()) return Reply::refuse(unknown(request));
        const Work& work = found->second;
        Document document;
        describe(work, document.add("progress", work.operation));
        return Reply::of(std::move(document));
    });
}

} // namespace rapidc::rws
