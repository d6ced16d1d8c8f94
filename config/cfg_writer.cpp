#include "config/cfg_writer.h"

#include "config/text_util.h"

#include <algorithm>
#include <cctype>

namespace rapid::config {

namespace {

constexpr std::size_t kWidth = 80; // columns, as controllers write them
constexpr std::string_view kIndent = "      ";

bool isBare(std::string_view value) {
    const bool isAttribute =
        value.size() > 1 && value[0] == '-' && std::isalpha(static_cast<unsigned char>(value[1])) != 0;
    return !value.empty() && !isAttribute && value.find_first_of(" \t,\"\\#") == std::string_view::npos;
}

std::string attributeText(const CfgAttribute& attribute) {
    std::string text = "-" + attribute.name + " ";
    const bool isQuoted =
        attribute.quoted || !std::all_of(attribute.values.begin(), attribute.values.end(),
                                         [](const std::string& value) { return isBare(value); });
    for (std::size_t i = 0; i < attribute.values.size(); ++i) {
        if (i > 0) text += ',';
        text += isQuoted ? '"' + attribute.values[i] + '"' : attribute.values[i];
    }
    return text;
}

/// Attributes on lines of a limited length; a backslash continues a line.
std::string instanceText(const CfgInstance& instance) {
    std::string text, line(kIndent);
    for (const CfgAttribute& attribute : instance.attributes) {
        const std::string next = attributeText(attribute);
        const bool isFirst = line.size() == kIndent.size();
        if (!isFirst && line.size() + 1 + next.size() >= kWidth) {
            text += line + "\\\n";
            line = kIndent;
        } else if (!isFirst) {
            line += ' ';
        }
        line += next;
    }
    return text + line + "\n";
}

} // namespace

bool isCfgValue(std::string_view text) {
    return text.size() <= 1000 && std::none_of(text.begin(), text.end(), [](unsigned char c) {
               return c < 0x20 || c == 0x7f || c == '"';
           });
}

bool isCfgName(std::string_view text) {
    return !text.empty() && text.size() <= 80 && std::isalpha(static_cast<unsigned char>(text[0])) != 0 &&
           std::all_of(text.begin(), text.end(),
                       [](unsigned char c) { return c < 0x80 && (std::isalnum(c) != 0 || c == '_'); });
}

std::string writeCfg(const CfgFile& file) {
    std::string text = file.domain + ":" + file.version + "\n";
    for (const CfgSection& section : file.sections) {
        text += "#\n" + section.type;
        if (!section.baseType.empty()) text += " = " + section.baseType;
        text += ":\n";
        for (const CfgInstance& instance : section.instances)
            if (!instance.attributes.empty()) text += "\n" + instanceText(instance);
    }
    return text;
}

std::string toLatin1(std::string_view utf8) {
    std::string bytes;
    for (std::size_t i = 0; i < utf8.size(); ++i) {
        const auto byte = static_cast<unsigned char>(utf8[i]);
        if (byte < 0x80) {
            bytes += utf8[i];
        } else if ((byte == 0xC2 || byte == 0xC3) && i + 1 < utf8.size()) {
            bytes += static_cast<char>((byte & 0x03) << 6 | (static_cast<unsigned char>(utf8[++i]) & 0x3F));
        } else {
            return std::string(utf8);
        }
    }
    return toUtf8(bytes) == utf8 ? bytes : std::string(utf8);
}

} // namespace rapid::config
