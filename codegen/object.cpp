// Object files and text.

#include <llvm/ADT/SmallVector.h>
#include <llvm/Support/FileSystem.h>
#include <llvm/Support/raw_ostream.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <mutex>
#include <numeric>
#include <thread>

#include "codegen/compile.h"
#include "codegen/object_cache.h"
#include "codegen/parts.h"

namespace codegen {

bool compileTo(const ir::Module& module, const CodegenOptions& options, llvm::CodeGenFileType type,
               llvm::SmallVectorImpl<char>& out, std::string& error) {
    auto machine = makeTargetMachine(options, error);
    if (!machine) return false;
    llvm::LLVMContext context;
    auto compiled = compile(module, options, *machine, context, error);
    return compiled && generate(*compiled, *machine, type, out, error);
}

namespace {

bool writeFile(const std::string& path, llvm::StringRef bytes, std::string& error) {
    std::error_code failure;
    llvm::raw_fd_ostream file(path, failure);
    if (!failure) {
        file.write(bytes.data(), bytes.size());
        file.close();
        failure = file.error();
        file.clear_error();
    }
    if (failure) error = "cannot write " + path + ": " + failure.message();
    return !failure;
}

} // namespace

bool emitObject(const ir::Module& module, const std::string& path, const CodegenOptions& options,
                std::string& error) {
    llvm::SmallVector<char, 0> bytes;
    return compileTo(module, options, llvm::CodeGenFileType::ObjectFile, bytes, error) &&
           writeFile(path, {bytes.data(), bytes.size()}, error);
}

namespace {

/// The parts of a large program, compiled on all processors.
class PartCompiler {
  public:
    PartCompiler(const ir::Module& module, const CodegenOptions& options, const std::string& folder)
        : module_(module), options_(options), folder_(folder), cache_(options.cacheFolder, options.bodies) {}

    bool run(std::vector<std::string>& paths, std::string& error) {
        if (options_.prepare)
            onAllProcessors(module_.routines.size(), [this](size_t routine, std::string& problem) {
                return options_.prepare(static_cast<uint32_t>(routine), problem);
            });
        if (error_.empty()) {
            parts_ = divide(module_, options_);
            const std::vector<size_t> order = longestFirst();
            onAllProcessors(parts_.size(), [this, &order](size_t i, std::string& problem) {
                return compilePart(order[i], problem);
            });
        }
        for (size_t i = 0; i < parts_.size(); ++i)
            paths.push_back(pathOf(i));
        cache_.shrink(kCacheBytes);
        error = error_;
        return error.empty();
    }

  private:
    static constexpr uint64_t kCacheBytes = uint64_t{1} << 30;

    std::string pathOf(size_t part) const { return folder_ + "/part" + std::to_string(part) + ".o"; }

    /// The parts in an order that keeps all processors busy to the end: what takes long is not left for the last.
    std::vector<size_t> longestFirst() const {
        constexpr size_t kPacedShare = 4; // optimised little: a quarter of the time of other instructions
        std::vector<size_t> sizes(parts_.size(), 0), order(parts_.size());
        for (size_t i = 0; i < parts_.size(); ++i) {
            for (const uint32_t routine : parts_[i].routines)
                sizes[i] += module_.routines[routine].insts.size();
            if (parts_[i].isPaced) sizes[i] /= kPacedShare;
            if (parts_[i].tables) sizes[i] = std::numeric_limits<size_t>::max();
        }
        std::iota(order.begin(), order.end(), size_t{0});
        std::sort(order.begin(), order.end(),
                  [&](size_t a, size_t b) { return sizes[a] != sizes[b] ? sizes[a] > sizes[b] : a < b; });
        return order;
    }

    /// Each number below `count` is given to `work` once. The first failure ends it.
    template <class Work> void onAllProcessors(size_t count, Work work) {
        std::atomic<size_t> next = 0;
        const auto loop = [&] {
            for (size_t i = next++; i < count && !failed_; i = next++) {
                std::string problem;
                if (work(i, problem)) continue;
                const std::lock_guard lock(mutex_);
                failed_ = true;
                error_ = std::move(problem);
            }
        };
        std::vector<std::thread> others;
        for (unsigned i = 1; i < std::min<size_t>(std::thread::hardware_concurrency(), count); ++i)
            others.emplace_back(loop);
        loop();
        for (std::thread& other : others)
            other.join();
    }

    bool compilePart(size_t i, std::string& error) const {
        CodegenOptions options = options_;
        options.optimise = options_.optimise && !parts_[i].tables; // nothing in them takes time
        auto machine = makeTargetMachine(options, error);
        if (!machine) return false;
        llvm::LLVMContext context;
        auto emitted = emit(module_, options, *machine, context, error, &parts_[i]);
        if (!emitted) return false;
        const std::string key = cache_.keyOf(*emitted, options);
        if (options_.trustCache && cache_.fetch(key, pathOf(i))) return true;
        llvm::SmallVector<char, 0> bytes;
        if (!finish(*emitted, options, *machine, error)) return false;
        if (parts_[i].isPaced) machine->setOptLevel(llvm::CodeGenOptLevel::None);
        if (!generate(*emitted, *machine, llvm::CodeGenFileType::ObjectFile, bytes, error) ||
            !writeFile(pathOf(i), {bytes.data(), bytes.size()}, error))
            return false;
        cache_.keep(key, pathOf(i));
        return true;
    }

    const ir::Module& module_;
    const CodegenOptions& options_;
    const std::string& folder_;
    std::vector<Part> parts_;
    const ObjectCache cache_;
    std::mutex mutex_;
    std::atomic<bool> failed_ = false;
    std::string error_;
};

} // namespace

bool emitObjects(const ir::Module& module, const std::string& folder, const CodegenOptions& options,
                 std::vector<std::string>& paths, std::string& error) {
    if (module.instructionCount() > options.partsAbove)
        return PartCompiler(module, options, folder).run(paths, error);
    paths.push_back(folder + "/program.o");
    return emitObject(module, paths.back(), options, error);
}

std::string emitLlvm(const ir::Module& module, const CodegenOptions& options, std::string& error) {
    auto machine = makeTargetMachine(options, error);
    if (!machine) return {};
    llvm::LLVMContext context;
    CodegenOptions named = options;
    named.namesValues = true;
    auto compiled = compile(module, named, *machine, context, error);
    if (!compiled) return {};
    std::string text;
    llvm::raw_string_ostream stream(text);
    compiled->print(stream, nullptr);
    return stream.str();
}

std::string emitAsm(const ir::Module& module, const CodegenOptions& options, std::string& error) {
    llvm::SmallVector<char, 0> text;
    if (!compileTo(module, options, llvm::CodeGenFileType::AssemblyFile, text, error)) return {};
    return {text.data(), text.size()};
}

} // namespace codegen
