#include "tools/rws/negotiation.h"

#include "config/letter_case.h"
#include "tools/http/url.h"

namespace rapidc::rws {

namespace {

bool isBelow(std::string_view path, std::string_view folder) {
    return path.size() >= folder.size() && rapid::config::sameName(path.substr(0, folder.size()), folder);
}

/// The value of a parameter of a media type, "" when it has none.
std::string parameterOf(std::string_view type, std::string_view name) {
    std::size_t at = type.find(';');
    while (at != std::string_view::npos) {
        const std::size_t next = type.find(';', at + 1);
        const std::string_view part =
            http::trimBlanks(type.substr(at + 1, next == std::string_view::npos ? next : next - at - 1));
        const std::size_t equals = part.find('=');
        if (equals != std::string_view::npos &&
            rapid::config::sameName(http::trimBlanks(part.substr(0, equals)), name))
            return std::string(http::trimBlanks(part.substr(equals + 1)));
        at = next;
    }
    return {};
}

} // namespace

bool acceptsAnything(std::string_view accept) {
    return http::trimBlanks(accept) == "*/*";
}

bool asksForNewestMessages(std::string_view path,
                           const std::vector<std::pair<std::string, std::string>>& query) {
    return isBelow(path, "/rw/elog") && std::any_of(query.begin(), query.end(), [](const auto& field) {
               return rapid::config::sameName(field.first, "order") &&
                      rapid::config::sameName(field.second, "lifo");
           });
}

std::optional<Form> acceptedForm(std::string_view accept, std::string_view path) {
    while (!accept.empty()) {
        const std::size_t comma = std::min(accept.find(','), accept.size());
        const std::string_view one = http::trimBlanks(accept.substr(0, comma));
        accept.remove_prefix(std::min(comma + 1, accept.size()));
        const std::string type = http::mediaTypeOf(one), version = parameterOf(one, "v");
        if (parameterOf(one, "q") == "0") continue;
        if (type == "application/hal+json" && version == "2.0") return Form::Json;
        const bool isLogOf21 = version == "2.1" && isBelow(path, "/rw/elog"); // as XHTML in both forms
        if (type == "application/hal+json" && isLogOf21) return Form::TypedXhtml;
        if (type == "application/xhtml+xml" && isLogOf21) return Form::TypedXhtml;
        if (type == "application/xhtml+xml" && version == "2.0") return Form::Xhtml;
    }
    return std::nullopt;
}

bool isAcceptedContent(const http::Head& head, std::string_view path) {
    const std::string_view type = head.header("content-type");
    if (head.method == "PUT" && isBelow(path, "/fileservice")) return true;
    if (type.empty()) return !head.isChunked && head.length.value_or(0) == 0;
    return http::mediaTypeOf(type) == "application/x-www-form-urlencoded" && parameterOf(type, "v") == "2.0";
}

} // namespace rapidc::rws
