#include "tools/rws/router.h"

#include "config/letter_case.h"

#include <algorithm>

namespace rapidc::rws {

namespace {

/// RWS 1.0 names the operation of a POST by ?action=; everywhere else the word is a field of the query like others.
bool mustHaveAction(const Request& request) {
    return request.dialect == Dialect::V1 && request.method == Method::Post;
}

} // namespace

void Router::add(Dialect dialect, Route route) {
    auto& routes = routes_[static_cast<std::size_t>(dialect)];
    Compiled added{PathPattern(route.pattern), std::move(route)};
    const auto same = std::find_if(routes.begin(), routes.end(), [&](const Compiled& other) {
        return other.route.method == added.route.method && other.pattern.isSameAs(added.pattern) &&
               rapid::config::sameName(other.route.action, added.route.action);
    });
    if (same != routes.end()) {
        *same = std::move(added);
        return;
    }
    // The most specific first: then find() takes the first that fits.
    const auto place = std::find_if(routes.begin(), routes.end(), [&](const Compiled& other) {
        return added.pattern.isMoreSpecificThan(other.pattern);
    });
    routes.insert(place, std::move(added));
}

void Router::addBoth(const Route& route) {
    add(Dialect::V1, route);
    add(Dialect::V2, route);
}

void Router::get(Dialect dialect, std::string pattern, Handler handler) {
    add(dialect, {Method::Get, std::move(pattern), {}, std::move(handler)});
}

void Router::post(Dialect dialect, std::string pattern, Handler handler) {
    add(dialect, {Method::Post, std::move(pattern), {}, std::move(handler)});
}

void Router::action(std::string pattern, std::string action, Handler handler) {
    add(Dialect::V1, {Method::Post, std::move(pattern), std::move(action), std::move(handler)});
}

void Router::getBoth(std::string pattern, const Handler& handler) {
    addBoth({Method::Get, std::move(pattern), {}, handler});
}

void Router::postBoth(std::string pattern, const Handler& handler) {
    addBoth({Method::Post, std::move(pattern), {}, handler});
}

bool Router::has(Dialect dialect, Method method, const std::vector<std::string>& segments) const {
    const auto& routes = routes_[static_cast<std::size_t>(dialect)];
    return std::any_of(routes.begin(), routes.end(), [&](const Compiled& each) {
        return each.route.method == method && each.pattern.matches(segments);
    });
}

Router::Match Router::find(Request& request) const {
    Match match;
    const Compiled* found = nullptr;
    for (const Compiled& each : routes_[static_cast<std::size_t>(request.dialect)]) {
        if (found && found->pattern.isMoreSpecificThan(each.pattern)) break;
        if (!each.pattern.matches(request.segments)) continue;
        match.pathKnown = true;
        if (each.route.method != request.method) continue;
        match.methodKnown = true;
        const bool sameAction = rapid::config::sameName(each.route.action, request.action);
        if (!sameAction && (!each.route.action.empty() || mustHaveAction(request))) continue;
        if (!found || sameAction) found = &each; // a route for the action wins over one without
        if (sameAction) break;
    }
    if (!found) return match;
    match.route = &found->route;
    request.parameters = found->pattern.parametersOf(request.segments);
    return match;
}

} // namespace rapidc::rws
