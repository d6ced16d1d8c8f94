#pragma once
// Negotiation: which form a reply has, and whether the form of a request is accepted (serve-contract 18, 19).

#include "tools/http/message.h"
#include "tools/rws/render.h"

#include <optional>

namespace rapidc::rws {

/// Whether a request is for the event log with order=lifo: its XHTML has the types of arguments (decision 128).
bool asksForNewestMessages(std::string_view path,
                           const std::vector<std::pair<std::string, std::string>>& query);
/// RWS 2.0: the first form of the header Accept that this server has. `path`: v=2.1 counts for the event log only. None: 406.
std::optional<Form> acceptedForm(std::string_view accept, std::string_view path);
/// True for what browsers send when a page does not say what it accepts.
bool acceptsAnything(std::string_view accept);
/// RWS 2.0: a form says that it is of version 2.0; contents of files may be of any type. False: 415.
bool isAcceptedContent(const http::Head& head, std::string_view path);

} // namespace rapidc::rws
