#pragma once
// How numbers and values become text and back: the one place for it (TPWrite, Write, ValToStr, NumToStr,
// StrToVal ...).

#include "runtime/abi/rt_abi.h"

#include <string>
#include <string_view>

namespace rt {

/// A num as the controller writes it: integers within +-8388608 in full, otherwise 6 significant digits,
/// "1.5E-07" when the exponent is below -4 or at least 6.
std::string formatNum(float value);
/// The same for dnum: integers within +-4503599627370496 in full, otherwise 15 significant digits.
std::string formatDnum(double value);
/// TPWrite and Write: as formatNum, but a decimal part below 0.000005 or above 0.999995 is rounded away.
std::string formatDisplayNum(float value);
/// The same for dnum, with 0.00000000000005 and 0.99999999999995.
std::string formatDisplayDnum(double value);
/// NumToStr, DnumToStr: a fixed number of decimals, or scientific ("3.85E-01").
std::string formatDecimals(double value, int decimals, bool exponent);

/// Any value as RAPID text: TRUE, 1.5, "text" (quotes doubled), [1,[2,3]]. Empty for types that have no
/// value.
std::string valueToText(const void* data, const TypeDesc& type);
/// The reverse. All or nothing: `data` is untouched when the text does not fit the type.
bool textToValue(std::string_view text, void* data, const TypeDesc& type);

/// A value as a declaration has it: it reads back as the very same value, with as few digits as that takes; bytes
/// of a string that cannot stand in a source become character codes (\0A). False when the value has no literal: a number
/// that is not finite, a type without values.
bool valueToSource(const void* data, const TypeDesc& type, std::string& text);
/// The reverse, as textToValue.
bool sourceToValue(std::string_view text, void* data, const TypeDesc& type);

/// Reads a RAPID number (sign, decimals, exponent, 0x 0o 0b), the whole text, blanks around it allowed.
bool parseRapidNumber(std::string_view text, double& value);

/// "num", "{x:num,y:num}", "[3,4]string": equal for types with the same values.
std::string describeType(const TypeDesc& type);

} // namespace rt
