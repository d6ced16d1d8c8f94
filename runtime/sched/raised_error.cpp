#include "runtime/sched/raised_error.h"

#include "runtime/log/event_log.h"
#include "runtime/sched/error_search.h"

#include <fmt/format.h>

#include <utility>

namespace rt {

RaisedError RaisedError::described(std::string text, SourcePlace place) {
    RaisedError error;
    error.note_ = std::make_shared<const Note>(Note{std::move(text), std::move(place), true});
    return error;
}

void RaisedError::setDetail(const std::string& detail) {
    note_.reset();
    if (!detail.empty()) note_ = std::make_shared<const Note>(Note{detail, std::nullopt, false});
}

void RaisedError::renumber(int number, const std::string& detail) {
    number_ = number;
    std::optional<SourcePlace> known = note_ != nullptr ? note_->place : std::nullopt;
    note_.reset();
    if (known || !detail.empty()) note_ = std::make_shared<const Note>(Note{detail, std::move(known), false});
}

std::string RaisedError::text(const EventLog& log) const {
    if (note_ != nullptr && note_->isWhole) return note_->text;
    if (number_ == kNone) return {};
    const std::string name = log.errorName(number_);
    std::string text =
        name.empty() ? fmt::format("Error {}", number_) : fmt::format("{} ({})", name, number_);
    const std::string why = note_ != nullptr && !note_->text.empty() ? note_->text : log.errorText(number_);
    text += why.empty() ? "." : ": " + why;
    if (text.back() != '.' && text.back() != '!' && text.back() != '?') text += '.';
    return text;
}

SourcePlace RaisedError::place() const {
    if (note_ != nullptr && note_->place) return *note_->place;
    return routine_ != nullptr ? placeOf(*routine_, statement_) : SourcePlace();
}

} // namespace rt
