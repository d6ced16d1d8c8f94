#pragma once
// Numbers out of JSON that may be anything: state files.

#include "config/json_text.h"

#include <stdexcept>
#include <type_traits>

namespace rt {

/// Throws std::invalid_argument unless the value is a number of this kind: a float would be cut off, or out of range.
template <class Number> Number numberFrom(const nlohmann::json& json) {
    if (std::is_integral_v<Number> ? !json.is_number_integer() : !json.is_number())
        throw std::invalid_argument("no number of this kind");
    return json.get<Number>();
}

} // namespace rt
