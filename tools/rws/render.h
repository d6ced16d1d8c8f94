#pragma once
// Rendering: replies as XHTML (both dialects, and the events of subscriptions), JSON of RWS 1.0 and HAL JSON of RWS 2.0
// (serve-contract 18 to 26).

#include "tools/rws/message.h"

#include <string>
#include <string_view>

namespace rapidc::rws {

enum class Form : uint8_t {
    Xhtml,
    TypedXhtml, ///< spans of the arguments of messages have the attribute "type" (decision 128)
    Json,
};

/// Parts of the request that rendering needs: dialect, base, path.
struct RenderContext {
    Dialect dialect = Dialect::V1;
    std::string base; ///< "http://127.0.0.1:8080"
    std::string path; ///< of the request, decoded
};

/// The body of a reply with a document.
std::string render(const Document& document, Form form, const RenderContext& context);
/// The body of an error.
std::string renderFailure(const Failure& failure, Form form, const RenderContext& context);
/// The same in one form; `isTyped`: as Form::TypedXhtml.
std::string renderXhtml(const Document& document, const RenderContext& context, bool isTyped = false);
std::string renderXhtmlFailure(const Failure& failure, const RenderContext& context);
/// The address of the next page as it is shown, "" when there is none. A query alone is for the same path; other relative addresses stay.
std::string nextPage(const Document& document, const RenderContext& context);
/// "application/xhtml+xml;v=2.0"
std::string contentTypeOf(Form form, Dialect dialect);

/// The folder that relative addresses of a resource count from, with '/' at both ends: "/rw/rapid/".
std::string baseFolder(std::string_view path);
/// How a page shows an address of its own server: without the folder of the base where clients put that folder in front of every
/// address (files, I/O and motion systems, configuration), otherwise as it is.
std::string shownAddress(std::string_view address, std::string_view folder);
/// Text for an element: markup escaped, bytes that are not UTF-8 and characters that XML cannot hold replaced by '?'. Quotes stay as they
/// are: clients that search the text with regular expressions expect "text" of RAPID so.
std::string xmlText(std::string_view text);
/// Text for an attribute in double quotes.
std::string xmlAttribute(std::string_view text);
/// The same replacements, nothing escaped.
std::string cleanText(std::string_view text);

/// One event of a subscription: a page with one li, whose anchor (rel=self) is `href` (serve-contract 44).
std::string renderEvent(const Entry& entry, std::string_view href, std::string_view base);

} // namespace rapidc::rws
