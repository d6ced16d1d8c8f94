#include "frontend/workspace/module_files.h"

#include "config/read_file.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>

namespace rapid::workspace {

namespace fs = std::filesystem;

namespace {

bool isModule(const fs::path& path) {
    constexpr std::array<std::string_view, 5> kTypes = {".mod", ".modx", ".sys", ".sysx", ".prg"};
    std::string type = path.extension().string();
    std::transform(type.begin(), type.end(), type.begin(), [](unsigned char c) { return std::tolower(c); });
    return std::find(kTypes.begin(), kTypes.end(), type) != kTypes.end();
}

bool isEncrypted(const fs::path& path) {
    const int first = std::ifstream(path, std::ios::binary).get();
    return first == 0xFC || first == 0xFE;
}

void addFolder(const fs::path& folder, ModuleFiles& out) {
    std::error_code error;
    const size_t begin = out.paths.size();
    for (fs::recursive_directory_iterator it(folder, fs::directory_options::skip_permission_denied, error),
         end;
         !error && it != end; it.increment(error)) {
        std::error_code ignored;
        if (it->is_regular_file(ignored) && isModule(it->path()) && !isEncrypted(it->path()))
            out.paths.push_back(it->path().string());
    }
    std::sort(out.paths.begin() + static_cast<std::ptrdiff_t>(begin), out.paths.end());
    if (out.paths.size() == begin)
        out.problems.push_back(
            fmt::format("'{}' has no modules: expected files of type .mod, .modx, .sys, .sysx or .prg in it",
                        folder.string()));
}

} // namespace

ModuleFiles findModuleFiles(const std::vector<std::string>& inputs) {
    ModuleFiles out;
    for (const std::string& input : inputs) {
        std::error_code error;
        if (fs::is_directory(input, error))
            addFolder(input, out);
        else if (!fs::exists(input, error))
            out.problems.push_back(fmt::format("'{}' does not exist", input));
        else if (!isModule(input))
            out.problems.push_back(fmt::format(
                "'{}' is not a module: expected a folder, or a file of type .mod, .modx, .sys, .sysx or .prg",
                input));
        else
            out.paths.push_back(input);
    }
    return out;
}

std::shared_ptr<const SourceFile> readModuleFile(const std::string& path, std::string& problem) {
    std::string bytes;
    const std::string reason = config::readFile(path, bytes);
    if (reason.empty()) return std::make_shared<const SourceFile>(path, std::move(bytes));
    problem = "cannot be read: " + reason;
    return nullptr;
}

} // namespace rapid::workspace
