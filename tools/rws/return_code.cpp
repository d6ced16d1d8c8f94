#include "tools/rws/return_code.h"

namespace rapidc::rws {

namespace {

constexpr ReturnCodeText kTexts[] = {
#define RETURN_CODE(name, number, symbol, severity, status, text)                                            \
    {ReturnCode::name, symbol, severity, status, text},
#include "tools/rws/return_codes.def"
#undef RETURN_CODE
};

} // namespace

std::optional<ReturnCodeText> describe(int number) {
    for (const ReturnCodeText& row : kTexts)
        if (static_cast<int>(row.code) == number) return row;
    return std::nullopt;
}

std::span<const ReturnCodeText> returnCodes() {
    return kTexts;
}

ReturnCodeText describe(ReturnCode code) {
    return describe(static_cast<int>(code)).value_or(kTexts[0]); // every enumerator has a row
}

} // namespace rapidc::rws
