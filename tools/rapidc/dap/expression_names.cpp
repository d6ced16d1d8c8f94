#include "tools/rapidc/dap/expression_names.h"

#include "runtime/base/text_util.h"

#include <algorithm>
#include <cctype>

namespace rapidc::dap {
namespace {

bool isLetter(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_' ||
           static_cast<unsigned char>(c) >= 0x80;
}

bool isPart(char c) {
    return isLetter(c) || std::isdigit(static_cast<unsigned char>(c)) != 0;
}

} // namespace

std::set<std::string> namesIn(std::string_view text) {
    std::set<std::string> names;
    for (std::size_t i = 0; i < text.size();) {
        if (text[i] == '"') {
            i = std::min(text.find('"', i + 1), text.size() - 1) + 1;
        } else if (text[i] == '!') {
            i = std::min(text.find('\n', i), text.size());
        } else if (isLetter(text[i])) {
            const std::size_t begin = i;
            while (i < text.size() && isPart(text[i]))
                ++i;
            names.insert(rt::upperCase(text.substr(begin, i - begin)));
        } else if (std::isdigit(static_cast<unsigned char>(text[i])) != 0) {
            while (i < text.size() && isPart(text[i]))
                ++i;
        } else {
            ++i;
        }
    }
    return names;
}

} // namespace rapidc::dap
