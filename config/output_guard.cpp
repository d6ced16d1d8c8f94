#include "config/output_guard.h"

#include "config/text_util.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace rapid::config {

namespace {

namespace fs = std::filesystem;

/// The file that a path means, even where links lead to a file that is not there yet.
fs::path followed(fs::path path) {
    constexpr int kMaxLinks = 40; // as the kernel allows
    std::error_code error;
    for (int links = 0; links < kMaxLinks && fs::is_symlink(fs::symlink_status(path, error)); ++links) {
        const fs::path target = fs::read_symlink(path, error);
        if (error) break;
        path = target.is_absolute() ? target : path.parent_path() / target;
    }
    const fs::path canonical = fs::weakly_canonical(fs::absolute(path, error), error);
    return error ? path : canonical;
}

/// Whether files of this name belong to a program: an output in their place would be lost work, whatever is compiled now.
bool isSourceName(const std::string& path, bool configuration) {
    constexpr std::string_view kTypes[] = {".MOD", ".MODX", ".SYS", ".SYSX", ".PRG", ".PGF", ".CFG"};
    const std::string type = upperCase(fs::path(path).extension().string());
    return !(configuration && type == ".CFG") &&
           std::find(std::begin(kTypes), std::end(kTypes), type) != std::end(kTypes);
}

} // namespace

OutputGuard::OutputGuard() {
    struct stat status{};
    standardOutput_.what = "the standard output";
    standardOutput_.ordinary = ::fstat(STDOUT_FILENO, &status) == 0 && S_ISREG(status.st_mode);
    standardOutput_.exists = standardOutput_.ordinary;
    standardOutput_.device = status.st_dev;
    standardOutput_.node = status.st_ino;
}

OutputGuard::File OutputGuard::fileOf(const std::string& path, std::string what) {
    File file;
    file.path = path;
    file.what = std::move(what);
    struct stat status{};
    file.exists = ::stat(path.c_str(), &status) == 0;
    file.ordinary = !file.exists || S_ISREG(status.st_mode);
    file.device = status.st_dev;
    file.node = status.st_ino;
    if (!file.exists) file.canonical = upperCase(followed(path).string());
    return file;
}

bool OutputGuard::same(const File& a, const File& b) {
    if (!a.ordinary || !b.ordinary || a.exists != b.exists) return false;
    return a.exists ? a.device == b.device && a.node == b.node : a.canonical == b.canonical;
}

void OutputGuard::reads(const std::string& path, std::string what) {
    if (!path.empty()) inputs_.push_back(fileOf(path, std::move(what)));
}

void OutputGuard::writes(const std::string& path, std::string option) {
    if (!path.empty()) outputs_.push_back(fileOf(path, std::move(option)));
}

void OutputGuard::writesConfiguration(const std::string& path, std::string option) {
    writes(path, std::move(option));
    if (!path.empty()) outputs_.back().configuration = true;
}

std::string OutputGuard::conflict() const {
    for (const File& output : outputs_) {
        for (const File& input : inputs_) {
            if (!input.exists || !same(output, input)) continue;
            const std::string read = input.what.empty() ? "the input" : input.what;
            const std::string also = input.path == output.path ? "" : fmt::format(" '{}'", input.path);
            return fmt::format("{} '{}' would overwrite {}{}; name another file", output.what, output.path,
                               read, also);
        }
        if (isSourceName(output.path, output.configuration) && output.ordinary)
            return fmt::format(
                "{} '{}' has the name of a module, a program or a configuration; name a file of "
                "another type",
                output.what, output.path);
    }
    for (size_t i = 0; i < outputs_.size(); ++i) {
        for (size_t k = 0; k < i; ++k)
            if (same(outputs_[i], outputs_[k]))
                return fmt::format("{} '{}' and {} '{}' are one file; give each a file of its own",
                                   outputs_[k].what, outputs_[k].path, outputs_[i].what, outputs_[i].path);
        if (standardOutput_.exists && same(outputs_[i], standardOutput_))
            return fmt::format(
                "{} '{}' is the file that the standard output goes to; give each a file of its own",
                outputs_[i].what, outputs_[i].path);
    }
    for (const File& input : inputs_)
        if (standardOutput_.exists && same(input, standardOutput_))
            return fmt::format("the standard output goes to '{}', which is read; send it to another file",
                               input.path);
    return {};
}

} // namespace rapid::config
