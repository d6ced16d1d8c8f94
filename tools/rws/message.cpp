#include "tools/rws/message.h"

#include "config/letter_case.h"

namespace rapidc::rws {

std::string Fields::text(std::string_view name) const {
    for (const auto& [key, value] : fields_)
        if (rapid::config::sameName(key, name)) return value;
    return {};
}

bool Fields::has(std::string_view name) const {
    for (const auto& field : fields_)
        if (rapid::config::sameName(field.first, name)) return true;
    return false;
}

const std::string& Request::parameter(std::string_view name) const {
    static const std::string kNone;
    const auto found = parameters.find(name);
    return found == parameters.end() ? kNone : found->second;
}

Reply Reply::of(Document document, int status) {
    Reply reply;
    reply.status = status;
    reply.document = std::move(document);
    return reply;
}

Reply Reply::of(Raw raw) {
    Reply reply;
    reply.raw = std::move(raw);
    return reply;
}

Reply Reply::done(int status) {
    Reply reply;
    reply.status = status;
    return reply;
}

Reply Reply::refuse(ReturnCode code, std::string message, int status) {
    Reply reply;
    reply.status = status ? status : describe(code).status;
    reply.failure = Failure{code, std::move(message), reply.status};
    return reply;
}

} // namespace rapidc::rws
