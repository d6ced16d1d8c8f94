#include "stdlib/impl/support/written_value.h"

#include "runtime/value/value_text.h"

namespace rt::lib {

namespace {

std::string bracketed(std::initializer_list<float> values) {
    std::string out;
    for (const float value : values)
        out += (out.empty() ? "[" : ",") + formatDisplayNum(value);
    return out + "]";
}

} // namespace

std::string withValue(const String& text, const float* num, const bool* boolean, const data::Pos* pos,
                      const data::Orient* orient, const double* dnum) {
    std::string out(text.view());
    if (num) out += formatDisplayNum(*num);
    if (boolean) out += *boolean ? "TRUE" : "FALSE";
    if (pos) out += bracketed({pos->x, pos->y, pos->z});
    if (orient) out += bracketed({orient->q1, orient->q2, orient->q3, orient->q4});
    if (dnum) out += formatDisplayDnum(*dnum);
    return out;
}

} // namespace rt::lib
