#pragma once
// Outcome: how an operation on a socket ended.

#include <cstdint>
#include <string>
#include <utility>

namespace rt::net {

enum class Fault : uint8_t {
    None,
    Again, ///< not yet: wait and try once more
    Closed,
    AddressInvalid,
    AddressInUse,
    IsBound,
    NotBound,
    IsConnected,
    NotConnected,
    Unreachable,
    Unspecified,
};

struct [[nodiscard]] Outcome {
    Fault fault = Fault::None;
    std::string why = {}; ///< a sentence for the event, without a full stop

    bool ok() const { return fault == Fault::None; }
};

} // namespace rt::net
