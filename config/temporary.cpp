#include "config/temporary.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <fmt/format.h>
#include <set>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace rapid::config {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMark = "rapidc-";
constexpr std::string_view kEnd = ".tmp";
constexpr std::string_view kRandom = "XXXXXX";
constexpr int kSuffix = 4; // of kEnd

/// "PID-XXXXXX" after the mark.
bool isTag(std::string_view text) {
    const size_t dash = text.find('-');
    const auto all = [](std::string_view part, int (*is)(int)) {
        return !part.empty() &&
               std::all_of(part.begin(), part.end(), [is](unsigned char c) { return is(c); });
    };
    return dash != std::string_view::npos && all(text.substr(0, dash), std::isdigit) &&
           text.size() - dash - 1 == kRandom.size() && all(text.substr(dash + 1), std::isalnum);
}

/// ".x.modx.rapidc-PID-XXXXXX.tmp", of folders without the end, or "rapidc-home-PID-XXXXXX".
bool isOurs(std::string_view name) {
    if (name.starts_with('.')) {
        if (name.ends_with(kEnd)) name.remove_suffix(kEnd.size());
        const size_t mark = name.rfind(kMark);
        return mark != std::string_view::npos && mark > 1 && name[mark - 1] == '.' &&
               isTag(name.substr(mark + kMark.size()));
    }
    if (!name.starts_with(kMark)) return false;
    name.remove_prefix(kMark.size());
    const size_t dash = name.find('-');
    return dash != std::string_view::npos && dash > 0 && isTag(name.substr(dash + 1));
}

std::string patternBeside(const fs::path& folder, const std::string& name) {
    constexpr size_t kLongest = 200; // a name has at most 255 bytes
    return (folder / fmt::format(".{}.{}{}-{}", name.substr(0, kLongest), kMark, ::getpid(), kRandom))
        .string();
}

/// A process that clears up may take a new file between its making and its locking: then another one is needed.
bool stillThere(int file, const std::string& path) {
    struct stat own{}, named{};
    return ::fstat(file, &own) == 0 && ::lstat(path.c_str(), &named) == 0 && own.st_dev == named.st_dev &&
           own.st_ino == named.st_ino;
}

/// Waits while a process that clears up looks at it. Without locks nothing is ever cleared up there.
void lock(int file) {
    while (::flock(file, LOCK_EX) != 0 && errno == EINTR) {
    }
}

constexpr int kAttempts = 20;

void removeIfAbandoned(const fs::path& path) {
    struct stat status{};
    if (::lstat(path.c_str(), &status) != 0 || status.st_uid != ::geteuid() ||
        (!S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode)))
        return;
    const int file = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) return;
    if (::flock(file, LOCK_EX | LOCK_NB) == 0 && stillThere(file, path.string())) {
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }
    ::close(file);
}

} // namespace

int TemporaryFile::make(const fs::path& folder, const std::string& name) {
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
        std::string path = patternBeside(folder, name) + std::string(kEnd);
        const int file = ::mkostemps(path.data(), kSuffix, O_CLOEXEC);
        if (file < 0) return errno;
        lock(file);
        if (stillThere(file, path)) {
            path_ = path;
            file_ = file;
            return 0;
        }
        ::close(file);
    }
    return EAGAIN;
}

int TemporaryFile::renameTo(const fs::path& target) {
    if (::rename(path_.c_str(), target.c_str()) != 0) return errno;
    path_.clear();
    return 0;
}

TemporaryFile::~TemporaryFile() {
    if (!path_.empty()) ::unlink(path_.c_str());
    if (file_ >= 0) ::close(file_);
}

int TemporaryFolder::makeFrom(const std::string& pattern) {
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
        std::string path = pattern;
        if (::mkdtemp(path.data()) == nullptr) return errno;
        const int file = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
        if (file < 0 && errno != ENOENT) return errno;
        if (file >= 0) lock(file);
        if (file >= 0 && stillThere(file, path)) {
            path_ = path;
            lock_ = file;
            return 0;
        }
        if (file >= 0) ::close(file);
    }
    return EAGAIN;
}

int TemporaryFolder::make(std::string_view purpose) {
    std::error_code problem;
    const fs::path folder = fs::temp_directory_path(problem);
    if (problem) return problem.value();
    removeLeftovers(folder);
    return makeFrom((folder / fmt::format("{}{}-{}-{}", kMark, purpose, ::getpid(), kRandom)).string());
}

int TemporaryFolder::makeBeside(const fs::path& folder, const std::string& name) {
    return makeFrom(patternBeside(folder, name));
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
    if (lock_ >= 0) ::close(lock_);
}

void removeLeftovers(const fs::path& folder) {
    removeLeftoversBelow(folder.empty() ? fs::path(".") : folder, 1);
}

void removeLeftoversBelow(const fs::path& folder, std::size_t most) {
    std::error_code error;
    std::vector<fs::path> found;
    std::size_t folders = 1;
    fs::recursive_directory_iterator it(folder, fs::directory_options::skip_permission_denied, error);
    for (const fs::recursive_directory_iterator end; !error && it != end; it.increment(error)) {
        const bool isLeftover = isOurs(it->path().filename().native());
        if (isLeftover) found.push_back(it->path());
        std::error_code ignored;
        if (it->is_directory(ignored) && !it->is_symlink(ignored) && (isLeftover || folders++ >= most))
            it.disable_recursion_pending();
    }
    for (const fs::path& path : found)
        removeIfAbandoned(path);
}

void removeLeftoversBeside(const std::vector<std::string>& files) {
    std::set<fs::path> folders;
    for (const std::string& file : files)
        if (const fs::path folder = fs::path(file).parent_path(); folders.insert(folder).second)
            removeLeftovers(folder);
}

} // namespace rapid::config
