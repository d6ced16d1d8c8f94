#pragma once
// Replies as responses of HTTP.

#include "tools/http/message.h"
#include "tools/rws/render.h"

namespace rapidc::rws {

/// The address of this server as the client wrote it in Host, as far as it is a plain name or address.
RenderContext contextOf(Dialect dialect, const http::Head& head, std::string path);
http::Response responseTo(const Reply& reply, Form form, const RenderContext& context);
/// An error of the front door itself.
http::Response errorResponse(int status, const std::string& message, Form form, const RenderContext& context);
http::Response withHeaders(http::Response response, const http::FieldList& headers);

} // namespace rapidc::rws
