#include "tools/rws/http_reply.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>

namespace rapidc::rws {

namespace {

bool isPlainHost(std::string_view host) {
    return !host.empty() && host.size() < 256 &&
           std::all_of(
               host.begin(), host.end(),
               [](unsigned char c) {
                   return std::isalnum(c) != 0 || c == '.' || c == '-' || c == '_' || c == ':' || c == '[' ||
                          c == ']';
               });
}

ReturnCode codeFor(int status) {
    switch (status) {
    case 400: return ReturnCode::BadParameter;
    case 404: return ReturnCode::NotFound;
    case 413:
    case 431: return ReturnCode::TooLarge;
    default: return ReturnCode::Rejected;
    }
}

} // namespace

RenderContext contextOf(Dialect dialect, const http::Head& head, std::string path) {
    const std::string_view host = head.header("host");
    return {dialect,
            fmt::format("{}://{}", head.secure ? "https" : "http", isPlainHost(host) ? host : "127.0.0.1"),
            std::move(path)};
}

http::Response responseTo(const Reply& reply, Form form, const RenderContext& context) {
    http::Response response;
    response.status = reply.status;
    if (reply.failure) {
        response.status =
            reply.failure->status != 0 ? reply.failure->status : describe(reply.failure->code).status;
        response.body = renderFailure(*reply.failure, form, context);
    } else if (reply.document) {
        response.body = render(*reply.document, form, context);
    } else if (reply.raw) {
        response.body = reply.raw->bytes;
    }
    if (reply.raw && !reply.failure)
        response.headers.emplace_back("Content-Type", reply.raw->contentType);
    else if (response.status != 204) // clients look at it before the body, which may be empty
        response.headers.emplace_back("Content-Type", contentTypeOf(form, context.dialect));
    if (!reply.location.empty()) response.headers.emplace_back("Location", reply.location);
    response.headers.emplace_back("Cache-Control", "no-cache, no-store");
    response.headers.emplace_back("X-Content-Type-Options", "nosniff");
    return response;
}

http::Response errorResponse(int status, const std::string& message, Form form,
                             const RenderContext& context) {
    return responseTo(Reply::refuse(codeFor(status), message, status), form, context);
}

http::Response withHeaders(http::Response response, const http::FieldList& headers) {
    response.headers.insert(response.headers.end(), headers.begin(), headers.end());
    return response;
}

} // namespace rapidc::rws
