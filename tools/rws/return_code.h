#pragma once
// ReturnCode: the numbers with which a controller refuses a request, with name, text and HTTP status: return_codes.def.

#include <optional>
#include <span>
#include <string_view>

namespace rapidc::rws {

enum class ReturnCode : int {
#define RETURN_CODE(name, number, symbol, severity, status, text) name = number,
#include "tools/rws/return_codes.def"
#undef RETURN_CODE
};

struct ReturnCodeText {
    ReturnCode code;
    const char* symbol;   ///< "SYS_CTRL_E_..."
    const char* severity; ///< "Error", "Information"
    int status;           ///< HTTP status of a reply with this code
    const char* text;
};

/// The row of a number; none when it is unknown.
std::optional<ReturnCodeText> describe(int number);
ReturnCodeText describe(ReturnCode code);
/// All rows.
std::span<const ReturnCodeText> returnCodes();

} // namespace rapidc::rws
