#include "tools/lsp/readable_texts.h"

#include "config/atomic_file.h"
#include "config/read_file.h"
#include "frontend/diag/explain.h"
#include "tools/lsp/uri.h"

#include <cstdlib>
#include <filesystem>
#include <map>
#include <unistd.h>

namespace lsp {

namespace fs = std::filesystem;

namespace {

std::string variable(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
}

/// Whether the folder is there and can be written in.
bool makeFolder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    return fs::is_directory(folder, error) && access(folder.c_str(), W_OK) == 0;
}

std::string findFolder() {
    std::vector<fs::path> choices;
    if (const std::string own = variable("RAPIDC_CACHE"); own.starts_with('/')) choices.emplace_back(own);
    if (const std::string caches = variable("XDG_CACHE_HOME"); caches.starts_with('/'))
        choices.push_back(fs::path(caches) / "rapidc");
    if (const std::string home = variable("HOME"); home.starts_with('/'))
        choices.push_back(fs::path(home) / ".cache" / "rapidc");
    std::error_code ignored;
    choices.push_back(fs::temp_directory_path(ignored) / ("rapidc-" + std::to_string(getuid())));
    for (const fs::path& choice : choices)
        if (const fs::path folder = choice / RAPIDC_VERSION; makeFolder(folder)) return folder.string();
    return {};
}

/// The path of a file with this text below the folder; "" when it cannot be written.
std::string write(const std::string& name, std::string_view text) {
    static std::map<std::string, std::string> written; // one thread works on requests
    if (const auto known = written.find(name); known != written.end()) return known->second;
    const std::string folder = readableFolder();
    if (folder.empty()) return {};
    const fs::path path = fs::path(folder) / name;
    std::string before;
    const bool same = rapid::config::readFile(path.string(), before).empty() && before == text;
    if (!same &&
        (!makeFolder(path.parent_path()) || !rapid::config::replaceFile(path.string(), text).empty()))
        return {};
    return written[name] = path.lexically_normal().string();
}

} // namespace

std::string readableFolder() {
    static const std::string folder = findFolder();
    return folder;
}

std::string declarationPath(const rapid::workspace::Environment& environment, std::string_view name) {
    for (const rapid::sema::LibraryText& text : environment.library(true))
        if (text.name == name) return write(std::string(name), text.text);
    return {};
}

std::string explanationUri(rapid::diag::Code code) {
    static const std::map<std::string, std::string> pages = [] {
        std::map<std::string, std::string> texts;
        for (rapid::diag::DiagnosticPage& page : rapid::diag::diagnosticPages())
            texts[page.fileName] = std::move(page.text);
        return texts;
    }();
    const auto page = pages.find(rapid::diag::codeName(code) + ".md");
    if (page == pages.end()) return {};
    const std::string path = write("diagnostics/" + page->first, page->second);
    return path.empty() ? "" : fileUri(path);
}

} // namespace lsp
