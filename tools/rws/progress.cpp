#include "tools/rws/progress.h"

#include "tools/rws/polled_states.h"
#include "tools/rws/request_values.h"

#include <fmt/format.h>

namespace rapidc::rws {

namespace {

constexpr std::string_view kPath = "/progress/";

} // namespace

std::string Progress::begin(const std::string& operation) {
    works_[++last_] = {operation, false, ReturnCode::Success};
    if (works_.size() > kKept) works_.erase(works_.begin());
    return fmt::format("{}{}", kPath, last_);
}

void Progress::done(const std::string& path, ReturnCode code) {
    const auto number = countIn(std::string_view(path).substr(std::min(kPath.size(), path.size())));
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
    const Subscribables* all = &subscribables;
    for (const char* resource : {"", "state"}) // clients write either
        subscribables.add({"/progress/{id}", resource, false, std::nullopt,
                           [this, all](const Request& request, const Changed& changed,
                                       Subscription& out) -> std::optional<Failure> {
                               const uint64_t id = countIn(request.parameter("id")).value_or(0);
                               if (!works_.contains(id))
                                   return Failure{ReturnCode::NotFound, "there is no such work", 0};
                               return watchPolled(
                                   *all,
                                   [this, id] {
                                       Entry entry;
                                       entry.type = "progress-ev";
                                       const auto found = works_.find(id); // old work is forgotten
                                       entry.title = found == works_.end() ? "" : found->second.operation;
                                       if (found != works_.end()) describe(found->second, entry);
                                       return entry;
                                   },
                                   changed, out);
                           }});
    router.getBoth("/progress", [this](const Request&) {
        Document document;
        for (const auto& [number, work] : works_) {
            Entry& entry = document.add("progress-li", work.operation);
            entry.self = fmt::format("{}{}", kPath, number);
            entry.value("state", work.isReady ? "ready" : "pending");
        }
        return Reply::of(std::move(document));
    });
    router.getBoth("/progress/{id}", [this](const Request& request) {
        const auto found = works_.find(countIn(request.parameter("id")).value_or(0));
        if (found == works_.end()) return Reply::refuse(ReturnCode::NotFound, "there is no such work");
        const Work& work = found->second;
        Document document;
        describe(work, document.add("progress", work.operation));
        return Reply::of(std::move(document));
    });
}

} // namespace rapidc::rws
