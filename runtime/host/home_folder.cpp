#include "runtime/host/home_folder.h"

#include "runtime/base/text_util.h"

#include <fmt/format.h>

#include <cstring>
#include <deque>
#include <filesystem>
#include <vector>

namespace rt {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxLinks = 40; // as the kernel allows

void splitPath(std::string_view path, std::vector<std::string>& parts) {
    parts.clear();
    for (std::size_t begin = 0; begin <= path.size();) {
        const std::size_t end = std::min(path.find('/', begin), path.size());
        const std::string_view part = path.substr(begin, end - begin);
        if (!part.empty() && part != ".") parts.emplace_back(part);
        begin = end + 1;
    }
}

} // namespace

bool HomeFolder::open(const std::string& path, std::string& error) {
    std::error_code code;
    const fs::path real = fs::canonical(path, code);
    if (code || !fs::is_directory(real, code)) {
        error = fmt::format("{} is not a folder", path);
        return false;
    }
    path_ = real.string();
    return true;
}

bool HomeFolder::openTemporary(std::string& error) {
    if (const int problem = temporary_.make("home"); problem != 0) {
        error = fmt::format("cannot make a temporary folder for HOME: {}", std::strerror(problem));
        return false;
    }
    return open(temporary_.path(), error);
}

bool HomeFolder::resolve(std::string_view rapidPath, std::string& hostPath) const {
    std::string path(rapidPath);
    for (char& c : path) {
        if (c == '\0') return false;
        if (c == '\\') c = '/'; // programs written under Windows
    }
    std::string_view relative = path;
    const std::size_t colon = relative.find(':');
    if (colon != std::string_view::npos) {
        if (!sameName(relative.substr(0, colon), "HOME")) return false;
        relative.remove_prefix(colon + 1);
    }
    return walk(relative, hostPath);
}

bool HomeFolder::resolve(std::string_view directory, std::string_view file, std::string& hostPath) const {
    if (file.empty()) return resolve(directory, hostPath);
    // A device in the second part would turn the first into nothing.
    if (file.find(':') != std::string_view::npos) return false;
    return resolve(fmt::format("{}/{}", directory, file), hostPath);
}

/// Follows the path part by part as the kernel would, so that neither `..` nor a symbolic link, even a dangling one,
/// leads out of the folder.
bool HomeFolder::walk(std::string_view relative, std::string& hostPath) const {
    if (path_.empty()) return false;
    std::vector<std::string> parts, rootParts, done;
    splitPath(relative, parts);
    splitPath(path_, rootParts);
    std::deque<std::string> open(parts.begin(), parts.end());
    int links = 0;
    while (!open.empty()) {
        const std::string part = std::move(open.front());
        open.pop_front();
        if (part == "..") {
            if (done.empty()) return false;
            done.pop_back();
            continue;
        }
        done.push_back(part);
        const std::string present = fmt::format("{}/{}", path_, fmt::join(done, "/"));
        std::error_code code;
        if (!fs::is_symlink(fs::symlink_status(present, code))) continue;
        if (++links > kMaxLinks) return false;
        const std::string target = fs::read_symlink(present, code).string();
        if (code) return false;
        splitPath(target, parts);
        done.pop_back();
        if (!target.empty() && target.front() == '/') { // absolute: fine when it begins with HOME itself
            done.clear();
            if (parts.size() < rootParts.size()) return false;
            for (std::size_t i = 0; i < rootParts.size(); ++i) {
                if (parts[i] != rootParts[i]) return false;
            }
            parts.erase(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(rootParts.size()));
        }
        open.insert(open.begin(), parts.begin(), parts.end());
    }
    hostPath = done.empty() ? path_ : fmt::format("{}/{}", path_, fmt::join(done, "/"));
    return true;
}

} // namespace rt
