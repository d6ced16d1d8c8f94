#include "tools/rws/render.h"

#include "tools/http/url.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace rapidc::rws {

namespace {

/// Bytes of the UTF-8 sequence that begins here; 0 when there is none.
std::size_t sequenceLength(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char first = byte(0);
    if (first < 0x80) return 1;
    const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
    if (first < 0xC2 || first > 0xF4 || text.size() < length) return 0;
    for (std::size_t i = 1; i < length; ++i)
        if ((byte(i) & 0xC0) != 0x80) return 0;
    const bool overlong = (first == 0xE0 && byte(1) < 0xA0) || (first == 0xF0 && byte(1) < 0x90);
    const bool surrogate = first == 0xED && byte(1) >= 0xA0;
    const bool beyond = first == 0xF4 && byte(1) >= 0x90;
    const bool noCharacter = first == 0xEF && byte(1) == 0xBF && byte(2) >= 0xBE; // U+FFFE, U+FFFF
    return overlong || surrogate || beyond || noCharacter ? 0 : length;
}

constexpr std::size_t kLargestEvent = 1024; // bytes
constexpr const char* kPlainInPath = "-._~/$:;,@";
constexpr std::string_view kFiles = "/fileservice", kIoSystem = "/rw/iosystem",
                           kMotionSystem = "/rw/motionsystem", kConfiguration = "/rw/cfg";
/// Services whose folder is the base of all their resources.
constexpr std::array<std::string_view, 7> kServices = {"/rw/mastership", "/rw/elog",    "/users",      "/uas",
                                                       kIoSystem,        kMotionSystem, kConfiguration};
/// Those whose base clients put in front of the addresses themselves.
constexpr std::array kRelative = {kFiles, kIoSystem, kMotionSystem, kConfiguration};

bool isControl(char c) {
    const auto code = static_cast<unsigned char>(c);
    return (code < 0x20 && c != '\t' && c != '\n' && c != '\r') || code == 0x7F;
}

std::string anchor(std::string_view href, std::string_view rel) {
    return fmt::format(R"(<a href="{}" rel="{}"></a>)", xmlAttribute(href), xmlAttribute(rel));
}

/// ` type="long"` of the argument with that name, "" when nothing is known of it: JSON has the types in nested entries.
std::string typeAttribute(const Entry& entry, std::string_view name) {
    for (const Entry& nested : entry.nested) {
        if (nested.title != name) continue;
        for (const auto& [member, value] : nested.values)
            if (member == "type") return fmt::format(R"( type="{}")", xmlAttribute(value));
    }
    return {};
}

std::string listItem(const Entry& entry, std::string_view folder, bool isTyped = false) {
    std::string text =
        fmt::format(R"(<li class="{}" title="{}">)", xmlAttribute(entry.type), xmlAttribute(entry.title));
    if (!entry.self.empty()) text += anchor(shownAddress(entry.self, folder), "self");
    for (const auto& [rel, href] : entry.links)
        text += anchor(href, rel);
    for (const auto& [name, value] : entry.values)
        text += fmt::format(R"(<span class="{}"{}>{}</span>)", xmlAttribute(name),
                            isTyped && entry.isNestedOnlyInJson ? typeAttribute(entry, name) : std::string(),
                            xmlText(value));
    if (!entry.nestedName.empty() && !entry.isNestedOnlyInJson) {
        text += "<ul>";
        for (const Entry& nested : entry.nested)
            text += listItem(nested, folder, isTyped);
        text += "</ul>";
    }
    return text + "</li>";
}

std::string page(std::string_view base, std::string_view body) {
    return fmt::format(
        R"(<?xml version="1.0" encoding="UTF-8"?>)"
        "\n"
        R"(<html xmlns="http://www.w3.org/1999/xhtml"><head><title>rapidc</title><base href="{}"/></head>)"
        "<body>{}</body></html>\n",
        xmlAttribute(base), body);
}

} // namespace

std::string cleanText(std::string_view text) {
    std::string result;
    result.reserve(text.size());
    while (!text.empty()) {
        const std::size_t length = sequenceLength(text);
        if (length == 0 || (length == 1 && isControl(text.front())))
            result += '?';
        else
            result += text.substr(0, length);
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return result;
}

std::string xmlText(std::string_view text) {
    std::string result;
    for (const char c : cleanText(text)) {
        switch (c) {
        case '&': result += "&amp;"; break;
        case '<': result += "&lt;"; break;
        case '>': result += "&gt;"; break;
        case '\r': result += "&#13;"; break; // a bare one would become a line feed
        default: result += c;
        }
    }
    return result;
}

std::string xmlAttribute(std::string_view text) {
    std::string result;
    for (const char c : xmlText(text))
        c == '"' ? result += "&quot;" : result += c;
    return result;
}

std::string baseFolder(std::string_view path) {
    const auto isIn = [&](std::string_view root) {
        return path.substr(0, root.size()) == root &&
               (path.size() == root.size() || path[root.size()] == '/');
    };
    if (isIn(kFiles)) {
        std::string folder = http::encodePercent(path, "-._~/$");
        return folder.ends_with('/') ? folder : folder + '/';
    }
    for (const std::string_view root : kServices)
        if (isIn(root)) return std::string(root) + "/";
    if (path.size() > 1 && isIn("/rw/rapid") && path != "/rw/rapid") return "/rw/rapid/";
    return isIn("/rw") && path != "/rw" ? "/rw/" : "/";
}

std::string shownAddress(std::string_view address, std::string_view folder) {
    const bool isRelative = std::any_of(kRelative.begin(), kRelative.end(), [&](std::string_view root) {
        return folder.starts_with(root) && folder.substr(root.size()).starts_with('/');
    });
    if (isRelative && address.starts_with(folder)) address.remove_prefix(folder.size());
    return std::string(address);
}

std::string contentTypeOf(Form form, Dialect dialect) {
    if (dialect == Dialect::V1) return form == Form::Json ? "application/json" : "application/xhtml+xml";
    return form == Form::Json ? "application/hal+json;v=2.0" : "application/xhtml+xml;v=2.0";
}

std::string nextPage(const Document& document, const RenderContext& context) {
    const std::string next = document.next.starts_with('?') ? context.path + document.next : document.next;
    const std::string folder = baseFolder(context.path), path = folder.substr(0, folder.size() - 1) + '?';
    if (folder.starts_with(kFiles) && next.starts_with(path)) return next.substr(path.size() - 1);
    return shownAddress(next, folder);
}

std::string renderXhtml(const Document& document, const RenderContext& context, bool isTyped) {
    std::string body = R"(<div class="state">)";
    body += anchor(document.self.empty() ? http::encodePercent(context.path, kPlainInPath) : document.self,
                   "self");
    for (const auto& [rel, href] : document.links)
        body += anchor(href, rel);
    if (const std::string next = nextPage(document, context); !next.empty()) body += anchor(next, "next");
    body += "<ul>";
    const std::string folder = baseFolder(context.path);
    for (const Entry& entry : document.entries)
        body += listItem(entry, folder, isTyped);
    return page(context.base + folder, body + "</ul></div>");
}

std::string renderXhtmlFailure(const Failure& failure, const RenderContext& context) {
    return page(
        context.base + baseFolder(context.path),
        fmt::format(R"(<div class="status"><span class="code">{}</span><span class="msg">{}</span></div>)",
                    static_cast<int>(failure.code), xmlText(failure.message)));
}

std::string renderEvent(const Entry& entry, std::string_view href, std::string_view base) {
    Entry event = entry;
    event.self.clear();
    event.links.emplace_back("self", href); // after the others: some clients read the first anchor
    const auto render = [&] {
        return page(fmt::format("{}/", base),
                    R"(<div class="state"><ul>)" + listItem(event, "/") + "</ul></div>");
    };
    std::string text = render();
    if (text.size() < kLargestEvent) return text;
    // The buffers of some clients end there: the value is left out, and read at the address in the event.
    std::erase_if(event.values, [](const auto& value) { return value.first == "value"; });
    return render();
}

} // namespace rapidc::rws
