#include "frontend/project/program_file.h"

#include "config/text_util.h"

#include <algorithm>
#include <charconv>

namespace rapid::project {

namespace {

std::string_view trim(std::string_view s) {
    const char* blank = " \t\r\n";
    const size_t begin = s.find_first_not_of(blank);
    if (begin == std::string_view::npos) return {};
    return s.substr(begin, s.find_last_not_of(blank) - begin + 1);
}

void appendUtf8(std::string& out, uint32_t point) {
    const auto put = [&out](uint32_t byte) { out += static_cast<char>(byte); };
    if (point < 0x80) {
        put(point);
    } else if (point < 0x800) {
        put(0xC0 | point >> 6), put(0x80 | (point & 0x3F));
    } else if (point < 0x10000) {
        put(0xE0 | point >> 12), put(0x80 | (point >> 6 & 0x3F)), put(0x80 | (point & 0x3F));
    }
}

/// The character of "&amp;", "&#233;", "&#xE9;" at the beginning of `text`; returns its length, 0 if it is none.
size_t decodeEntity(std::string_view text, std::string& out) {
    static constexpr std::pair<std::string_view, char> kEntities[] = {
        {"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}};
    for (const auto& [entity, character] : kEntities) {
        if (!text.starts_with(entity)) continue;
        out += character;
        return entity.size();
    }
    if (!text.starts_with("&#")) return 0;
    const bool hex = text.size() > 2 && (text[2] == 'x' || text[2] == 'X');
    const char* begin = text.data() + (hex ? 3 : 2);
    uint32_t point = 0;
    const auto [end, error] = std::from_chars(begin, text.data() + text.size(), point, hex ? 16 : 10);
    if (error != std::errc() || end == text.data() + text.size() || *end != ';' || point == 0 ||
        point > 0xFFFF)
        return 0;
    appendUtf8(out, point);
    return static_cast<size_t>(end - text.data()) + 1;
}

std::string decodeEntities(std::string_view text) {
    std::string out;
    while (!text.empty()) {
        size_t length = text.front() == '&' ? decodeEntity(text, out) : 0;
        if (length == 0) {
            out += text.front();
            length = 1;
        }
        text.remove_prefix(length);
    }
    return out;
}

/// Comments become blanks, so that modules in them do not count.
std::string withoutComments(std::string text) {
    for (size_t at = text.find("<!--"); at != std::string::npos; at = text.find("<!--", at)) {
        const size_t end = text.find("-->", at + 4);
        const size_t stop = end == std::string::npos ? text.size() : end + 3;
        std::fill(text.begin() + static_cast<std::ptrdiff_t>(at),
                  text.begin() + static_cast<std::ptrdiff_t>(stop), ' ');
    }
    return text;
}

} // namespace

bool readProgramFile(std::string_view bytes, std::vector<std::string>& modules) {
    const std::string text = withoutComments(config::toUtf8(bytes));
    const std::string folded = config::upperCase(text);
    const size_t open = folded.find("<PROGRAM");
    if (open == std::string::npos) return false;
    const size_t close = folded.find('>', open);
    if (close == std::string::npos) return false;
    // A file that was cut off in a transfer lacks modules, too.
    if (folded[close - 1] != '/' && folded.find("</PROGRAM", close) == std::string::npos) return false;
    size_t at = 0;
    while ((at = folded.find("<MODULE", at)) != std::string::npos) {
        const size_t begin = folded.find('>', at);
        if (begin == std::string::npos) return false;
        if (folded[begin - 1] == '/') { // <Module/>: no name
            at = begin;
            continue;
        }
        const size_t end = folded.find("</MODULE", begin);
        if (end == std::string::npos) return false;
        std::string name = decodeEntities(trim(std::string_view(text).substr(begin + 1, end - begin - 1)));
        std::replace(name.begin(), name.end(), '\\', '/');
        if (!name.empty()) modules.push_back(std::move(name));
        at = end;
    }
    return true;
}

} // namespace rapid::project
