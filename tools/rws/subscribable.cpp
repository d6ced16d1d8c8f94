#include "tools/rws/subscribable.h"

#include "config/letter_case.h"

namespace rapidc::rws {

void Subscribables::add(Subscribable subscribable) {
    patterns_.emplace_back(subscribable.pattern);
    all_.push_back(std::move(subscribable));
}

const Subscribable* Subscribables::find(std::string_view text, Request& request) const {
    const std::size_t semicolon = text.rfind(';');
    const std::string_view path = text.substr(0, semicolon);
    const std::string_view resource = semicolon == std::string_view::npos ? "" : text.substr(semicolon + 1);
    if (!path.starts_with('/')) return nullptr;
    request.segments = splitPath(path);
    if (request.segments.empty()) return nullptr;
    const Subscribable* found = nullptr;
    const PathPattern* best = nullptr;
    for (std::size_t i = 0; i < all_.size(); ++i) {
        const Subscribable& each = all_[i];
        if (each.only && *each.only != request.dialect) continue;
        const bool repeatsName =
            each.resource.empty() && rapid::config::sameName(resource, request.segments.back());
        if (!repeatsName && !rapid::config::sameName(resource, each.resource)) continue;
        if (!patterns_[i].matches(request.segments)) continue;
        if (best && !patterns_[i].isMoreSpecificThan(*best)) continue;
        found = &each;
        best = &patterns_[i];
    }
    if (!found) return nullptr;
    request.path.clear();
    for (const std::string& segment : request.segments)
        request.path += '/' + segment;
    request.parameters = best->parametersOf(request.segments);
    return found;
}

} // namespace rapidc::rws
