#include "tools/http/message.h"

#include "config/letter_case.h"

#include <fmt/format.h>

#include <algorithm>

namespace rapidc::http {

using rapid::config::sameName;

namespace {

struct StatusText {
    int status;
    const char* text;
};

constexpr StatusText kStatusTexts[] = {
    {100, "Continue"},
    {101, "Switching Protocols"},
    {200, "OK"},
    {201, "Created"},
    {202, "Accepted"},
    {204, "No Content"},
    {301, "Moved Permanently"},
    {304, "Not Modified"},
    {400, "Bad Request"},
    {401, "Unauthorized"},
    {403, "Forbidden"},
    {404, "Not Found"},
    {405, "Method Not Allowed"},
    {406, "Not Acceptable"},
    {408, "Request Timeout"},
    {409, "Conflict"},
    {410, "Gone"},
    {411, "Length Required"},
    {413, "Payload Too Large"},
    {414, "URI Too Long"},
    {415, "Unsupported Media Type"},
    {417, "Expectation Failed"},
    {426, "Upgrade Required"},
    {429, "Too Many Requests"},
    {501, "Not Implemented"},
    {431, "Header Fields Too Large"},
    {503, "Service Unavailable"},
    {505, "HTTP Version Not Supported"},
};

/// "host:port" without the port; an address of IPv6 keeps its brackets.
std::string_view hostOf(std::string_view authority) {
    if (authority.starts_with('['))
        return authority.substr(0, std::min(authority.find(']'), authority.size() - 1) + 1);
    return authority.substr(0, authority.find(':'));
}

/// Clients may write the port that a scheme has by itself, or leave it out.
std::string_view withoutStandardPort(std::string_view host, bool secure) {
    const std::string_view port = secure ? ":443" : ":80";
    if (host.ends_with(port)) host.remove_suffix(port.size());
    return host;
}

bool isAddress(std::string_view host) {
    if (host.starts_with('[')) return true;
    return !host.empty() && host.find_first_not_of("0123456789.") == std::string_view::npos;
}

bool hasToken(std::string_view list, std::string_view token) {
    while (!list.empty()) {
        const std::size_t end = std::min(list.find(','), list.size());
        if (sameName(trimBlanks(list.substr(0, end)), token)) return true;
        list.remove_prefix(std::min(end + 1, list.size()));
    }
    return false;
}

} // namespace

std::string_view Head::header(std::string_view name) const {
    for (const auto& [key, value] : headers)
        if (sameName(key, name)) return value;
    return {};
}

std::size_t Head::count(std::string_view name) const {
    return static_cast<std::size_t>(std::count_if(
        headers.begin(), headers.end(), [&](const auto& field) { return sameName(field.first, name); }));
}

bool Head::asksForSocket() const {
    return hasToken(header("Upgrade"), "websocket");
}

std::string_view Head::cookie(std::string_view name) const {
    for (const auto& [key, value] : headers) {
        if (!sameName(key, "Cookie")) continue;
        std::string_view rest = value;
        while (!rest.empty()) {
            const std::size_t end = std::min(rest.find(';'), rest.size());
            const std::string_view pair = trimBlanks(rest.substr(0, end));
            rest.remove_prefix(std::min(end + 1, rest.size()));
            const std::size_t equals = pair.find('=');
            if (equals == std::string_view::npos || trimBlanks(pair.substr(0, equals)) != name) continue;
            return trimBlanks(pair.substr(equals + 1));
        }
    }
    return {};
}

Response Response::text(int status, std::string body, std::string contentType) {
    Response response;
    response.status = status;
    response.headers.emplace_back("Content-Type", std::move(contentType));
    response.body = std::move(body);
    return response;
}

const char* statusText(int status) {
    for (const StatusText& row : kStatusTexts)
        if (row.status == status) return row.text;
    return "Status";
}

std::string headOf(const Response& response, bool keepsAlive) {
    std::string head = fmt::format("HTTP/1.1 {} {}\r\n", response.status, statusText(response.status));
    for (const auto& [name, value] : response.headers)
        head += fmt::format("{}: {}\r\n", name, value);
    if (response.status != 204 && response.status != 304 && response.status >= 200)
        head += fmt::format("Content-Length: {}\r\n", response.body.size());
    head += keepsAlive ? "Connection: keep-alive\r\n\r\n" : "Connection: close\r\n\r\n";
    return head;
}

bool hasSafeHost(const Head& head) {
    const std::string_view host = hostOf(head.header("Host"));
    return isAddress(host) || sameName(host, "localhost");
}

bool hasOwnOrigin(const Head& head) {
    if (head.count("Origin") == 0) return true;
    if (head.count("Origin") > 1 || !hasSafeHost(head)) return false;
    std::string_view origin = head.header("Origin");
    const std::size_t end = origin.find("://");
    if (end == std::string_view::npos) return false;
    const std::string_view scheme = origin.substr(0, end);
    origin.remove_prefix(end + 3);
    // Client libraries outside browsers name the scheme of their WebSocket.
    const bool isOwnScheme = sameName(scheme, head.secure ? "https" : "http") ||
                             (head.asksForSocket() && sameName(scheme, head.secure ? "wss" : "ws"));
    return isOwnScheme && sameName(withoutStandardPort(origin, head.secure),
                                   withoutStandardPort(head.header("Host"), head.secure));
}

} // namespace rapidc::http
