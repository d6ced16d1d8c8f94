#include "codegen/object_cache.h"

#include <llvm/ADT/StringExtras.h>
#include <llvm/Bitcode/BitcodeWriter.h>
#include <llvm/Support/SHA256.h>

#include <algorithm>
#include <dlfcn.h>
#include <filesystem>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

namespace codegen {

namespace fs = std::filesystem;

namespace {

/// Names the file that contains the code generator, and its version by time and size.
std::string describeGenerator() {
    Dl_info info{};
    struct stat status{};
    if (dladdr(reinterpret_cast<const void*>(&describeGenerator), &info) == 0 || !info.dli_fname ||
        stat(info.dli_fname, &status) != 0)
        return {};
    return std::string(info.dli_fname) + ' ' + std::to_string(status.st_size) + ' ' +
           std::to_string(status.st_mtim.tv_sec) + ' ' + std::to_string(status.st_mtim.tv_nsec);
}

/// A link where possible: the cache may drop its own name of the file at any time. Never over an existing file.
bool copyFile(const std::string& from, const std::string& to) {
    std::error_code failure;
    fs::create_hard_link(from, to, failure);
    if (!failure) return true;
    failure.clear();
    return fs::copy_file(from, to, failure) && !failure;
}

} // namespace

ObjectCache::ObjectCache(std::string folder, const NativeBodies& bodies) : folder_(std::move(folder)) {
    if (folder_.empty()) return;
    generator_ = describeGenerator();
    std::error_code failure;
    fs::create_directories(folder_, failure);
    if (failure || generator_.empty() || access(folder_.c_str(), W_OK) != 0) folder_.clear();
    llvm::SHA256 hash;
    hash.update({bodies.bitcode.data(), bodies.bitcode.size()});
    generator_ += ' ' + llvm::toHex(hash.final(), true);
}

std::string ObjectCache::keyOf(const llvm::Module& module, const CodegenOptions& options) const {
    if (folder_.empty()) return {};
    llvm::SmallVector<char, 0> bitcode;
    llvm::raw_svector_ostream stream(bitcode);
    llvm::WriteBitcodeToFile(module, stream);
    llvm::SHA256 hash;
    hash.update(generator_);
    hash.update(options.optimise ? "optimised" : "quick");
    hash.update(llvm::StringRef(bitcode.data(), bitcode.size()));
    return llvm::toHex(hash.final(), true);
}

std::string ObjectCache::fileOf(const std::string& key) const {
    return folder_ + "/" + key + ".o";
}

bool ObjectCache::fetch(const std::string& key, const std::string& path) const {
    if (key.empty() || !copyFile(fileOf(key), path)) return false;
    std::error_code ignored;
    fs::last_write_time(path, fs::file_time_type::clock::now(), ignored);
    return true;
}

void ObjectCache::keep(const std::string& key, const std::string& path) const {
    if (key.empty()) return;
    const std::string own = fileOf(key) + "." + std::to_string(getpid());
    std::error_code ignored;
    if (copyFile(path, own)) fs::rename(own, fileOf(key), ignored);
    fs::remove(own, ignored);
}

void ObjectCache::shrink(uint64_t bytes) const {
    if (folder_.empty()) return;
    struct Entry {
        fs::file_time_type time;
        uint64_t size;
        fs::path path;
    };
    std::vector<Entry> entries;
    uint64_t total = 0;
    std::error_code failure;
    for (fs::directory_iterator at(folder_, failure), end; !failure && at != end; at.increment(failure)) {
        std::error_code gone;
        const Entry entry{at->last_write_time(gone), at->file_size(gone), at->path()};
        if (gone) continue;
        total += entry.size;
        entries.push_back(entry);
    }
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.time < b.time; });
    for (const Entry& entry : entries) {
        if (total <= bytes) return;
        total -= entry.size;
        fs::remove(entry.path, failure);
    }
}

} // namespace codegen
