#include "tools/pendant/client.h"

#include "config/json_text.h"

#include <fmt/format.h>

namespace rapidc::pendant {

void Client::answer(const Json& id, const Json& result) {
    auto text =
        std::make_shared<const std::string>(rapid::config::textOf(Json{{"id", id}, {"result", result}}));
    if (text->size() > kLargestAnswer)
        return refuse(
            id, {code::kTooLarge, fmt::format("The answer has {} bytes", text->size()), "Ask for less"});
    send(std::move(text));
}

void Client::refuse(const Json& id, const RequestError& error) {
    Json details{{"code", error.code}, {"message", error.message}};
    if (!error.remedy.empty()) details["remedy"] = error.remedy;
    send(std::make_shared<const std::string>(
        rapid::config::textOf(Json{{"id", id}, {"error", std::move(details)}})));
}

} // namespace rapidc::pendant
