#include "runtime/value/value_text.h"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <system_error>
#include <vector>

namespace rt {

namespace {

constexpr double kNumInteger = 8388608.0;
constexpr double kDnumInteger = 4503599627370496.0;

std::string printed(const char* format, int digits, double value) {
    char buffer[400];
    const int size = std::snprintf(buffer, sizeof buffer, format, digits, value);
    return {buffer, static_cast<size_t>(size)};
}

std::string formatGeneral(double value, double integerLimit, int digits) {
    if (value == 0) return "0"; // also -0
    if (std::trunc(value) == value && std::fabs(value) <= integerLimit) return printed("%.*f", 0, value);
    return printed("%.*G", digits, value);
}

double withoutNoise(double value, double noise) {
    const double nearest = std::nearbyint(value);
    return std::fabs(value - nearest) < noise ? nearest : value;
}

/// Recursive reader of RAPID values; writes to `out` as it goes.
class ValueReader {
  public:
    explicit ValueReader(std::string_view text) : text_(text) {}

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
        size_t end = text_.find_first_of(",] \t", at_);
        if (end == std::string_view::npos) end = text_.size();
        double parsed = 0;
        if (!parseRapidNumber(text_.substr(at_, end - at_), parsed)) return false;
        const T stored = static_cast<T>(parsed);
        if (!std::isfinite(stored)) return false;
        std::memcpy(out, &stored, sizeof stored);
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
            read += c;
        }
        return false;
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
};

std::string quotedText(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += c;
        out += c;
    }
    return out + '"';
}

void appendValue(std::string& out, const char* data, const TypeDesc& type);

void appendArray(std::string& out, const char*& data, const TypeDesc& type, int dim) {
    const TypeDesc& element = *type.fields[0];
    const bool innermost = dim == 2 || type.dims[dim + 1] == 0;
    out += '[';
    for (int32_t i = 0; i < type.dims[dim]; ++i) {
        if (i > 0) out += ',';
        if (!innermost) {
            appendArray(out, data, type, dim + 1);
            continue;
        }
        appendValue(out, data, element);
        data += element.size;
    }
    out += ']';
}

template <class T> T loaded(const char* data) {
    T value;
    std::memcpy(&value, data, sizeof value);
    return value;
}

void appendValue(std::string& out, const char* data, const TypeDesc& type) {
    switch (type.kind) {
    case DescKind::Num: out += formatNum(loaded<float>(data)); break;
    case DescKind::Dnum: out += formatDnum(loaded<double>(data)); break;
    case DescKind::Bool: out += *data ? "TRUE" : "FALSE"; break;
    case DescKind::String: out += quotedText(loaded<String>(data).view()); break;
    case DescKind::Record:
        out += '[';
        for (uint32_t i = 0; i < type.count; ++i) {
            if (i > 0) out += ',';
            appendValue(out, data + type.offsets[i], *type.fields[i]);
        }
        out += ']';
        break;
    case DescKind::Array: appendArray(out, data, type, 0); break;
    default: break; // handles have no value
    }
}

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
    return printed(exponent ? "%.*E" : "%.*f", decimals, value);
}

std::string valueToText(const void* data, const TypeDesc& type) {
    std::string out;
    appendValue(out, static_cast<const char*>(data), type);
    return out;
}

bool textToValue(std::string_view text, void* data, const TypeDesc& type) {
    std::vector<char> read(
        type.size); // Load into a copy: a text that fails half-way must leave the data alone
    std::memcpy(read.data(), data, type.size);
    ValueReader reader(text);
    if (!reader.value(read.data(), type) || !reader.atEnd()) return false;
    std::memcpy(data, read.data(), type.size);
    return true;
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
    if (!parsePrefixed(text, value)) {
        const char* end = text.data() + text.size();
        const auto [stop, error] = std::from_chars(text.data(), end, value);
        if (error != std::errc() || stop != end) return false;
    }
    if (negative) value = -value;
    return true;
}

} // namespace rt
