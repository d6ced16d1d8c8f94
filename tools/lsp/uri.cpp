#include "tools/lsp/uri.h"

#include "config/text_util.h"

#include <cctype>
#include <filesystem>
#include <fmt/format.h>

namespace lsp {

namespace {

int hexDigit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    const char lower = static_cast<char>(c | 0x20);
    return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

std::string decoded(std::string_view text) {
    std::string out;
    for (size_t i = 0; i < text.size(); ++i) {
        const int high = text[i] == '%' && i + 2 < text.size() ? hexDigit(text[i + 1]) : -1;
        const int low = high >= 0 ? hexDigit(text[i + 2]) : -1;
        if (low < 0) {
            out.push_back(text[i]);
            continue;
        }
        out.push_back(static_cast<char>(high * 16 + low));
        i += 2;
    }
    return out;
}

} // namespace

std::optional<std::string> pathOf(std::string_view uri) {
    constexpr std::string_view kScheme = "file:";
    if (!rapid::config::sameName(uri.substr(0, kScheme.size()), kScheme)) return {};
    uri.remove_prefix(kScheme.size());
    if (uri.starts_with("//")) { // the name of a machine: this one
        const size_t path = uri.find('/', 2);
        if (path == std::string_view::npos) return {};
        uri.remove_prefix(path);
    }
    uri = uri.substr(0, uri.find_first_of("?#"));
    const std::string path = decoded(uri);
    if (!path.starts_with('/') || path.find('\0') != std::string::npos) return {};
    std::string normal = std::filesystem::path(path).lexically_normal().string();
    while (normal.size() > 1 && normal.ends_with('/'))
        normal.pop_back();
    return normal;
}

std::string fileUri(std::string_view path) {
    std::string out = "file://";
    for (const char c : path) {
        if (std::isalnum(static_cast<unsigned char>(c)) != 0 ||
            std::string_view("/-._~").find(c) != std::string_view::npos)
            out.push_back(c);
        else
            out += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
    return out;
}

} // namespace lsp
