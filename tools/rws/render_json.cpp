#include "tools/rws/render.h"

#include "config/json_text.h"
#include "tools/http/url.h"

namespace rapidc::rws {

namespace {

using Json = nlohmann::ordered_json;

Json href(std::string_view text) {
    return {{"href", cleanText(text)}};
}

/// RWS 1.0 adds "?json=1" to relative addresses, which lead to JSON again; some clients replace it with what they subscribe to.
std::string selfOf(const Entry& entry, const RenderContext& context) {
    std::string self = shownAddress(entry.self, baseFolder(context.path));
    const bool isRelative = !self.starts_with('/') && self.find_first_of(":;?") == std::string::npos;
    if (context.dialect == Dialect::V1 && isRelative) self += "?json=1";
    return self;
}

Json valueOf(const Entry& entry, const std::string& name, const std::string& text,
             const RenderContext& context) {
    if (context.dialect == Dialect::V1 && name == entry.numberInJson) {
        Json number = Json::parse(text, nullptr, false);
        if (number.is_number()) return number;
    }
    return cleanText(text);
}

Json objectOf(const Entry& entry, const RenderContext& context) {
    Json links = Json::object();
    if (!entry.self.empty()) links["self"] = href(selfOf(entry, context));
    for (const auto& [rel, target] : entry.links)
        links[rel] = href(target);
    Json object = Json::object();
    if (!links.empty()) object["_links"] = std::move(links);
    object["_type"] = entry.type;
    object["_title"] = cleanText(entry.title);
    for (const auto& [name, value] : entry.values)
        object[name] = valueOf(entry, name, value, context);
    if (!entry.nestedName.empty()) {
        Json list = Json::array();
        for (const Entry& nested : entry.nested)
            list.push_back(objectOf(nested, context));
        object[entry.nestedName] = std::move(list);
    }
    return object;
}

/// RWS 2.0 gives addresses as in XHTML, with "&amp;".
std::string withEscapedAmpersand(std::string_view text) {
    std::string result;
    for (const char c : text)
        result += c == '&' ? std::string("&amp;") : std::string(1, c);
    return result;
}

Json linksOf(const Document& document, const RenderContext& context) {
    Json links = {{"base", href(context.base + baseFolder(context.path))}};
    links["self"] =
        href(document.self.empty() ? http::encodePercent(context.path, "-._~/$:;,@") : document.self);
    for (const auto& [rel, target] : document.links)
        links[rel] = href(target);
    if (const std::string next = nextPage(document, context); !next.empty())
        links["next"] = href(context.dialect == Dialect::V2 ? withEscapedAmpersand(next) : next);
    return links;
}

std::string renderJson(const Document& document, const RenderContext& context) {
    Json entries = Json::array();
    for (const Entry& entry : document.entries)
        entries.push_back(objectOf(entry, context));
    Json json = {{"_links", linksOf(document, context)}};
    if (context.dialect == Dialect::V1) {
        json["_embedded"] = {{"_state", std::move(entries)}};
    } else {
        json["status"] = {{"code", static_cast<int>(ReturnCode::Success)}};
        if (document.place == Document::Place::Resources)
            json["_embedded"] = {{"resources", std::move(entries)}};
        else
            json["state"] = std::move(entries);
    }
    return rapid::config::textOf(json);
}

std::string renderJsonFailure(const Failure& failure, const RenderContext& context) {
    const Json status = {{"code", static_cast<int>(failure.code)}, {"msg", cleanText(failure.message)}};
    Json json = {{"_links", {{"base", href(context.base + baseFolder(context.path))}}}};
    if (context.dialect == Dialect::V1)
        json["_embedded"] = {{"status", status}};
    else
        json["status"] = status;
    return rapid::config::textOf(json);
}

} // namespace

std::string render(const Document& document, Form form, const RenderContext& context) {
    return form == Form::Json ? renderJson(document, context)
                              : renderXhtml(document, context, form == Form::TypedXhtml);
}

std::string renderFailure(const Failure& failure, Form form, const RenderContext& context) {
    return form == Form::Json ? renderJsonFailure(failure, context) : renderXhtmlFailure(failure, context);
}

} // namespace rapidc::rws
