#include "frontend/project/files.h"

#include "config/letter_case.h"
#include "config/text_util.h"
#include "frontend/diag/messages/projects.h"

#include <algorithm>
#include <cctype>
#include <sys/stat.h>

namespace rapid::project {

namespace fs = std::filesystem;
using config::sameName;
namespace say = diag::say;

std::string extensionOf(const fs::path& path) {
    return config::lowerCase(path.extension().string());
}

bool isModule(const fs::path& path) {
    const std::string e = extensionOf(path);
    return e == ".mod" || e == ".modx" || e == ".sys" || e == ".sysx" || e == ".prg";
}

bool isFolder(const fs::path& path) {
    std::error_code error;
    return fs::is_directory(path, error);
}

namespace {
std::vector<fs::path> sortedEntries(const fs::path& folder, std::error_code& error) {
    std::vector<fs::path> found;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
        found.push_back(it->path());
    std::sort(found.begin(), found.end());
    return found;
}
} // namespace

std::vector<fs::path> entries(const fs::path& folder) {
    std::error_code ignored;
    return sortedEntries(folder, ignored);
}

fs::path findEntry(const fs::path& folder, const std::string& name) {
    if (folder.empty()) return {};
    std::error_code error;
    if (fs::exists(folder / name, error)) return folder / name;
    for (const fs::path& path :
         entries(folder)) // a backup that was unpacked elsewhere has ISO 8859-1 in names
        if (sameName(config::toUtf8(path.filename().string()), name)) return path;
    return {};
}

fs::path findPath(const fs::path& folder, std::string_view relative) {
    fs::path found = folder;
    while (!relative.empty() && !found.empty()) {
        const size_t slash = relative.find_first_of("/\\");
        const std::string step(relative.substr(0, slash));
        relative = slash == std::string_view::npos ? std::string_view() : relative.substr(slash + 1);
        if (step == "..") return {}; // no way out of the folder
        if (!step.empty() && step != ".") found = findEntry(found, step);
    }
    return found;
}

bool FileReader::read(const fs::path& path, std::string& bytes) {
    filesRead_.push_back(path.string());
    const std::string problem = readText(texts_, path.string(), bytes);
    if (!problem.empty()) report(say::FileUnreadable, {path.string(), problem});
    return problem.empty();
}

std::vector<fs::path> FileReader::list(const fs::path& folder) {
    std::error_code error;
    std::vector<fs::path> found = sortedEntries(folder, error);
    if (error && !folder.empty() && unreadable_.insert(folder.string()).second)
        report(say::FileUnreadable, {folder.string(), error.message()});
    if (!texts_ || folder.empty()) return found;
    for (const fs::path& open : texts_->in(folder)) {
        const auto place = std::lower_bound(found.begin(), found.end(), open);
        if (place == found.end() || *place != open) found.insert(place, open);
    }
    return found;
}

/// Whether the file, under whatever name, belongs to the task already.
bool FileReader::isKnown(const fs::path& path, const sema::TaskInput& task) {
    auto& identities = identities_[&task];
    if (task.files.empty() && task.missingModules.empty()) identities.clear(); // another task at this place
    struct stat status{};
    return ::stat(path.c_str(), &status) == 0 && !identities.insert({status.st_dev, status.st_ino}).second;
}

std::shared_ptr<const SourceFile> FileReader::load(const fs::path& path) {
    auto& known = known_[path.string()];
    std::string bytes;
    if (known || !read(path, bytes)) return known;
    known = std::make_shared<const SourceFile>(path.string(), std::move(bytes));
    if (known->isEncrypted()) sink_.report(say::EncryptedModule, known, {}, {path.filename().string()});
    return known;
}

void FileReader::addModule(const fs::path& path, sema::TaskInput& task) {
    if (isKnown(path, task)) {
        report(say::SameFileTwice, {path.string()});
        return;
    }
    const auto file = load(path);
    if (!file) return;
    if (!file->isEncrypted()) {
        task.files.push_back(file);
        return;
    }
    task.missingModules.push_back(path.filename().string());
    task.incomplete = true;
}

} // namespace rapid::project
