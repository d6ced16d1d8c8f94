#pragma once
// TestRecord: what the assertions of a unit test leave for the one who runs it (tools/testing). A service of the controller.

#include "runtime/base/source_place.h"

#include <cstdint>
#include <optional>
#include <string>

namespace rt::lib {

struct TestRecord {
    struct Failure {
        SourcePlace place;            ///< of the assertion, in the program
        std::string text;             ///< what was expected and what was found, in one sentence
        std::string expected, actual; ///< in RAPID's notation; "" when there are no two values
    };
    struct Skip {
        SourcePlace place;
        std::string reason;
    };
    uint64_t assertions = 0; ///< that were executed
    std::optional<Failure> failure;
    std::optional<Skip> skip;
    int32_t expectedError = 0; ///< number of the error that is to end the test (ExpectError); 0: none
    SourcePlace expectedAt;    ///< of that ExpectError
};

} // namespace rt::lib
