#include "tools/rws/alias_signals.h"

#include "config/letter_case.h"
#include "tools/rws/rapid_support.h"
#include "tools/rws/request_values.h"

#include <cstring>
#include <fmt/format.h>

namespace rapidc::rws {

namespace {

constexpr std::size_t kMostAliasesOnPage = 100;

/// The signal that a signal variable is connected with; -1: none, or it is not a signal variable.
rt::SignalId aliasOf(rt::Controller& core, const rt::GlobalDesc& data) {
    const bool isSignal = data.type != nullptr && data.type->kind == rt::DescKind::Handle &&
                          rapid::config::beginsWithName(data.type->baseName, "signal");
    if (!isSignal || data.address == nullptr || data.kind != rt::kGlobalVariable) return -1;
    rt::Handle handle = 0;
    std::memcpy(&handle, data.address, sizeof handle);
    return handle == 0 ? -1 : core.io().idOf(handle);
}

Reply list(service::VirtualController& controller, const Request& request) {
    const std::optional<Page> page = readPage(request, kMostAliasesOnPage, kMostAliasesOnPage);
    if (!page) return badParameter("start or limit", "whole numbers");
    rt::Controller& core = controller.core();
    Document document;
    std::size_t number = 0;
    for (const rt::GlobalDesc* data : core.tables().globals()) {
        const rt::SignalId signal = aliasOf(core, *data);
        if (signal < 0 || rapid::config::sameName(core.io().config(signal).name, data->name)) continue;
        if (number++ < page->start) continue;
        if (document.entries.size() == page->limit) {
            document.next = fmt::format("?start={}&limit={}", page->start + page->limit, page->limit);
            break;
        }
        const rt::SignalConfig& config = core.io().config(signal);
        document.add("rap-alias-io", data->name)
            .value("alias-name", data->name)
            .value("signal-name", config.name)
            .value("type", rt::signalTypeName(config.type));
    }
    return Reply::of(std::move(document));
}

} // namespace

void addAliasSignals(Router& router, service::VirtualController& controller) {
    router.getBoth("/rw/rapid/aliasio",
                   [&controller](const Request& request) { return list(controller, request); });
}

} // namespace rapidc::rws
