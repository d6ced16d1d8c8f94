#include "runtime/value/value_text.h"

#include "runtime/value/whole_limits.h"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>
#include <system_error>
#include <vector>

namespace rt {

namespace {

std::string printed(const char* format, int digits, double value) {
    char buffer[400];
    const int size = std::snprintf(buffer, sizeof buffer, format, digits, value);
    return {buffer, static_cast<size_t>(size)};
}

/// The same text as %.*f of printf, to the byte.
std::string fixed(double value, int decimals) {
    char buffer[400]; // the largest number has 309 digits in front of the point
    char* const end = buffer + sizeof buffer;
    if (decimals == 0 && std::fabs(value) < 9007199254740992.0) {
        const double whole = std::nearbyint(value); // halves to the even neighbour, as printf does
        if (whole != 0 || !std::signbit(whole))
            return {buffer, std::to_chars(buffer, end, static_cast<int64_t>(whole)).ptr};
    }
    return {buffer, std::to_chars(buffer, end, value, std::chars_format::fixed, decimals).ptr};
}

std::string formatGeneral(double value, double integerLimit, int digits) {
    if (value == 0) return "0"; // also -0
    if (std::trunc(value) == value && std::fabs(value) <= integerLimit) return fixed(value, 0);
    return printed("%.*G", digits, value);
}

double withoutNoise(double value, double noise) {
    const double nearest = std::nearbyint(value);
    return std::fabs(value - nearest) < noise ? nearest : value;
}

/// A number of the language; nothing is written when the text is something else, or beyond the range of the type.
template <class T> bool readNumber(std::string_view text, void* out) {
    double parsed = 0;
    if (!parseRapidNumber(text, parsed)) return false;
    const T stored = static_cast<T>(parsed);
    if (!std::isfinite(stored)) return false;
    std::memcpy(out, &stored, sizeof stored);
    return true;
}

/// Recursive reader of RAPID values; writes to `out` as it goes.
class ValueReader {
  public:
    /// `codes`: \hh in strings is a byte, as in a source.
    explicit ValueReader(std::string_view text, bool codes = false) : text_(text), codes_(codes) {}

    bool value(char* out, const TypeDesc& type) {
        switch (type.kind) {
        case DescKind::Num: return number<float>(out);
        case DescKind::Dnum: return number<double>(out);
        case DescKind::Bool: return boolean(out);
        case DescKind::String: return string(out);
        case DescKind::Record: return record(out, type);
        case DescKind::Array: return array(out, *type.fields[0], type, 0);
        default: return false;
        }
    }
    bool atEnd() {
        skipBlanks();
        return at_ == text_.size();
    }

  private:
    void skipBlanks() {
        while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t'))
            ++at_;
    }
    bool accept(char c) {
        skipBlanks();
        if (at_ == text_.size() || text_[at_] != c) return false;
        ++at_;
        return true;
    }

    template <class T> bool number(char* out) {
        skipBlanks();
        const auto ends = [](char c) { return c == ',' || c == ']' || c == ' ' || c == '\t'; };
        size_t end = at_;
        while (end < text_.size() && !ends(text_[end]))
            ++end;
        if (!readNumber<T>(text_.substr(at_, end - at_), out)) return false;
        at_ = end;
        return true;
    }

    bool boolean(char* out) {
        skipBlanks();
        for (const auto& [word, value] : {std::pair<std::string_view, char>{"TRUE", 1}, {"FALSE", 0}}) {
            bool same = text_.size() - at_ >= word.size();
            for (size_t i = 0; same && i < word.size(); ++i)
                same = (text_[at_ + i] & ~0x20) == word[i];
            if (!same) continue;
            *out = value;
            at_ += word.size();
            return true;
        }
        return false;
    }

    bool string(char* out) {
        if (!accept('"')) return false;
        std::string read;
        while (at_ < text_.size()) {
            const char c = text_[at_++];
            const bool doubled = at_ < text_.size() && text_[at_] == c;
            if (c == '"' && !doubled) {
                if (read.size() > sizeof(String::bytes)) return false;
                String value;
                value.assign(read);
                std::memcpy(out, &value, sizeof value);
                return true;
            }
            if ((c == '"' || c == '\\') && doubled) ++at_;
            read += c == '\\' && !doubled && codes_ ? characterCode() : c;
        }
        return false;
    }

    /// The two digits after a backslash; without digits the backslash represents itself.
    char characterCode() {
        unsigned code = 0;
        const char* digits = text_.data() + at_;
        if (at_ + 2 > text_.size()) return '\\';
        const auto [stop, error] = std::from_chars(digits, digits + 2, code, 16);
        if (error != std::errc() || stop != digits + 2) return '\\';
        at_ += 2;
        return static_cast<char>(code);
    }

    bool record(char* out, const TypeDesc& type) {
        if (!accept('[')) return false;
        for (uint32_t i = 0; i < type.count; ++i) {
            if (i > 0 && !accept(',')) return false;
            if (!value(out + type.offsets[i], *type.fields[i])) return false;
        }
        return accept(']');
    }

    /// Row-major: the innermost brackets hold the elements.
    bool array(char*& out, const TypeDesc& element, const TypeDesc& type, int dim) {
        if (!accept('[')) return false;
        const bool innermost = dim == 2 || type.dims[dim + 1] == 0;
        for (int32_t i = 0; i < type.dims[dim]; ++i) {
            if (i > 0 && !accept(',')) return false;
            if (!innermost) {
                if (!array(out, element, type, dim + 1)) return false;
                continue;
            }
            if (!value(out, element)) return false;
            out += element.size;
        }
        return accept(']');
    }

    std::string_view text_;
    size_t at_ = 0;
    bool codes_ = false;
};

bool read(ValueReader reader, void* data, const TypeDesc& type) {
    constexpr size_t kFew = 256;
    char few[kFew];
    std::vector<char> many(type.size > kFew ? type.size : 0);
    char* const copy =
        many.empty() ? few : many.data(); // a text that fails half-way must leave the data alone
    std::memcpy(copy, data, type.size);
    if (!reader.value(copy, type) || !reader.atEnd()) return false;
    std::memcpy(data, copy, type.size);
    return true;
}

/// Length of the UTF-8 character at the front of `text`; 0 when there is none.
size_t characterLength(std::string_view text) {
    const auto first = static_cast<unsigned char>(text[0]);
    const size_t length = first < 0x80   ? 1
                          : first < 0xC2 ? 0
                          : first < 0xE0 ? 2
                          : first < 0xF0 ? 3
                          : first < 0xF5 ? 4
                                         : 0;
    if (length < 2) return length;
    if (length > text.size()) return 0;
    for (size_t i = 1; i < length; ++i)
        if ((static_cast<unsigned char>(text[i]) & 0xC0) != 0x80) return 0;
    const auto second = static_cast<unsigned char>(text[1]);
    const bool tooLong = (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90);
    const bool noCharacter = (first == 0xED && second > 0x9F) || (first == 0xF4 && second > 0x8F);
    return tooLong || noCharacter ? 0 : length;
}

/// As few digits as tell the number from its neighbours; the layout of formatNum.
template <class T> std::string shortestDigits(T value, double integerLimit, int plainExponent) {
    if (value == 0) return std::signbit(value) ? "-0" : "0";
    if (std::trunc(value) == value && std::fabs(static_cast<double>(value)) <= integerLimit)
        return fixed(static_cast<double>(value), 0);
    char buffer[64];
    const char* end = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::scientific).ptr;
    std::string text(buffer, static_cast<size_t>(end - buffer));
    const size_t mark = text.find('e');
    if (mark == std::string::npos) return text; // infinite, or no number
    const int exponent = std::atoi(text.c_str() + mark + 1);
    text[mark] = 'E';
    if (exponent < -4 || exponent >= plainExponent) return text;
    end = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed).ptr;
    return {buffer, static_cast<size_t>(end - buffer)};
}

template <class T> T loaded(const char* data) {
    T value;
    std::memcpy(&value, data, sizeof value);
    return value;
}

/// Writes values as people read them or, for a source, so that they read back identically.
class ValueWriter {
  public:
    explicit ValueWriter(bool source) : source_(source) {}

    std::string out;
    bool hasLiteral = true;

    void value(const char* data, const TypeDesc& type) {
        switch (type.kind) {
        case DescKind::Num: num(loaded<float>(data)); break;
        case DescKind::Dnum: dnum(loaded<double>(data)); break;
        case DescKind::Bool: out += *data ? "TRUE" : "FALSE"; break;
        case DescKind::String: string(loaded<String>(data).view()); break;
        case DescKind::Record:
            out += '[';
            for (uint32_t i = 0; i < type.count; ++i) {
                if (i > 0) out += ',';
                value(data + type.offsets[i], *type.fields[i]);
            }
            out += ']';
            break;
        case DescKind::Array: array(data, type, 0); break;
        default: hasLiteral = false; break; // handles have no value
        }
    }

  private:
    void num(float number) {
        hasLiteral = hasLiteral && std::isfinite(number);
        out += source_ ? shortestDigits(number, kNumInteger, 7) : formatNum(number);
    }
    void dnum(double number) {
        hasLiteral = hasLiteral && std::isfinite(number);
        out += source_ ? shortestDigits(number, kDnumInteger, 16) : formatDnum(number);
    }

    void string(std::string_view text) {
        out += '"';
        while (!text.empty()) {
            const size_t length = characterLength(text);
            const auto first = static_cast<unsigned char>(text[0]);
            if (source_ && (length == 0 || first < 0x20 || first == 0x7F)) {
                constexpr const char* kDigits = "0123456789ABCDEF";
                out += {'\\', kDigits[first >> 4], kDigits[first & 15]};
            } else {
                if (first == '"' || first == '\\') out += text[0];
                out += text[0];
            }
            text.remove_prefix(1);
            if (length < 2) continue;
            out += text.substr(0, length - 1);
            text.remove_prefix(length - 1);
        }
        out += '"';
    }

    void array(const char*& data, const TypeDesc& type, int dim) {
        const TypeDesc& element = *type.fields[0];
        const bool innermost = dim == 2 || type.dims[dim + 1] == 0;
        out += '[';
        for (int32_t i = 0; i < type.dims[dim]; ++i) {
            if (i > 0) out += ',';
            if (!innermost) {
                array(data, type, dim + 1);
                continue;
            }
            value(data, element);
            data += element.size;
        }
        out += ']';
    }

    bool source_;
};

/// Digits of an integer literal with a base prefix; false when there is none or a digit does not fit.
bool parsePrefixed(std::string_view digits, double& value) {
    if (digits.size() < 3 || digits[0] != '0') return false;
    const char mark = static_cast<char>(digits[1] | 0x20);
    const int base = mark == 'x' ? 16 : mark == 'o' ? 8 : mark == 'b' ? 2 : 0;
    if (base == 0) return false;
    uint64_t integer = 0;
    const char* end = digits.data() + digits.size();
    const auto [stop, error] = std::from_chars(digits.data() + 2, end, integer, base);
    value = static_cast<double>(integer);
    return error == std::errc() && stop == end;
}

/// Digits with or without a point, few enough that both numbers of the division are exact: its result is rounded once, as that of
/// from_chars. False: something else, or too long.
bool parseShortDecimal(std::string_view text, double& value) {
    constexpr size_t kExactDigits = 15;
    constexpr double kPowers[kExactDigits + 1] = {1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                  1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
    if (text.size() > kExactDigits) return false;
    uint64_t digits = 0;
    size_t decimals = 0;
    bool hasPoint = false;
    for (const char c : text) {
        if (c == '.' && !hasPoint) {
            hasPoint = true;
        } else if (c >= '0' && c <= '9') {
            digits = digits * 10 + static_cast<uint64_t>(c - '0');
            decimals += hasPoint ? 1 : 0;
        } else {
            return false;
        }
    }
    value = static_cast<double>(digits) / kPowers[decimals];
    return text != ".";
}

} // namespace

std::string formatNum(float value) {
    return formatGeneral(static_cast<double>(value), kNumInteger, 6);
}

std::string formatDnum(double value) {
    return formatGeneral(value, kDnumInteger, 15);
}

std::string formatDisplayNum(float value) {
    return formatGeneral(withoutNoise(static_cast<double>(value), 0.000005), kNumInteger, 6);
}

std::string formatDisplayDnum(double value) {
    return formatGeneral(withoutNoise(value, 0.00000000000005), kDnumInteger, 15);
}

std::string formatDecimals(double value, int decimals, bool exponent) {
    if (value == 0) value = 0; // not -0: whether a zero has a sign depends on how the compiler computed it
    return exponent ? printed("%.*E", decimals, value) : fixed(value, decimals);
}

std::string valueToText(const void* data, const TypeDesc& type) {
    ValueWriter writer(false);
    writer.value(static_cast<const char*>(data), type);
    return std::move(writer.out);
}

bool textToValue(std::string_view text, void* data, const TypeDesc& type) {
    if (type.kind == DescKind::Num) return readNumber<float>(text, data);
    if (type.kind == DescKind::Dnum) return readNumber<double>(text, data);
    return read(ValueReader(text), data, type);
}

bool sourceToValue(std::string_view text, void* data, const TypeDesc& type) {
    return read(ValueReader(text, true), data, type);
}

bool valueToSource(const void* data, const TypeDesc& type, std::string& text) {
    ValueWriter writer(true);
    writer.value(static_cast<const char*>(data), type);
    text = std::move(writer.out);
    return writer.hasLiteral;
}

bool parseRapidNumber(std::string_view text, double& value) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t'))
        text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t'))
        text.remove_suffix(1);
    bool negative = false;
    if (!text.empty() && (text[0] == '+' || text[0] == '-')) {
        negative = text[0] == '-';
        text.remove_prefix(1);
    }
    // from_chars alone would take "inf", "nan" and a second sign
    if (text.empty() || !(text[0] == '.' || (text[0] >= '0' && text[0] <= '9'))) return false;
    if (!parseShortDecimal(text, value) && !parsePrefixed(text, value)) {
        const char* end = text.data() + text.size();
        const auto [stop, error] = std::from_chars(text.data(), end, value);
        if (error != std::errc() || stop != end) return false;
    }
    if (negative) value = -value;
    return true;
}

std::string describeType(const TypeDesc& type) {
    switch (type.kind) {
    case DescKind::Num: return "num";
    case DescKind::Dnum: return "dnum";
    case DescKind::Bool: return "bool";
    case DescKind::String: return "string";
    case DescKind::Record: {
        std::string text = "{";
        for (uint32_t i = 0; i < type.count; ++i)
            text +=
                fmt::format("{}{}:{}", i > 0 ? "," : "", type.fieldNames[i], describeType(*type.fields[i]));
        return text + "}";
    }
    case DescKind::Array: {
        std::string text = "[";
        for (int k = 0; k < 3 && type.dims[k] > 0; ++k)
            text += fmt::format("{}{}", k > 0 ? "," : "", type.dims[k]);
        return text + "]" + describeType(*type.fields[0]);
    }
    case DescKind::Bytes:
    case DescKind::Handle:
    case DescKind::Other: break;
    }
    return type.baseName;
}

} // namespace rt
