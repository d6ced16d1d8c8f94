// Position-independent images: the object is linked here for an imaginary place, far from everything it imports, so that
// each address that depends on the real place or on an import has 8 bytes of its own; those are listed.

#include <llvm/ADT/SmallVector.h>
#include <llvm/ExecutionEngine/JITLink/JITLink.h>
#include <llvm/ExecutionEngine/JITLink/aarch64.h>
#include <llvm/ExecutionEngine/JITLink/x86_64.h>
#include <llvm/Support/MemoryBuffer.h>

#include "codegen/compile.h"
#include "ir/core/ir.h"
#include "runtime/abi/unit_image.h"

namespace codegen {
namespace {

namespace jitlink = llvm::jitlink;
namespace orc = llvm::orc;

constexpr uint64_t kPage = 4096;
constexpr uint64_t kPlace = uint64_t{1} << 45;
constexpr uint64_t kImports = uint64_t{1} << 44;
constexpr uint64_t kImportStep = 4096;

bool allows(const orc::AllocGroup& group, orc::MemProt wanted) {
    return (static_cast<unsigned>(group.getMemProt()) & static_cast<unsigned>(wanted)) != 0;
}

/// Lays the segments out one after the other and keeps their bytes.
class ImageMemory : public jitlink::JITLinkMemoryManager {
  public:
    explicit ImageMemory(rt::UnitImage& image) : image_(image) {}

    void allocate(const jitlink::JITLinkDylib*, jitlink::LinkGraph& graph,
                  OnAllocatedFunction onAllocated) override {
        jitlink::BasicLayout layout(graph);
        for (auto& entry : layout.segments()) {
            auto& segment = entry.second;
            rt::UnitImage::Segment& made = image_.segments.emplace_back();
            made.offset = image_.size;
            made.size = segment.ContentSize + segment.ZeroFillSize;
            made.writable = allows(entry.first, orc::MemProt::Write);
            made.executable = allows(entry.first, orc::MemProt::Exec);
            made.bytes.resize(segment.ContentSize);
            image_.size += llvm::alignTo(made.size, kPage);
        }
        size_t next = 0; // only now do the buffers stay where they are
        for (auto& entry : layout.segments()) {
            rt::UnitImage::Segment& made = image_.segments[next++];
            entry.second.Addr = orc::ExecutorAddr(kPlace + made.offset);
            entry.second.WorkingMem = made.bytes.data();
        }
        if (auto problem = layout.apply())
            onAllocated(std::move(problem));
        else
            onAllocated(std::make_unique<InFlight>());
    }
    using JITLinkMemoryManager::allocate;

    void deallocate(std::vector<FinalizedAlloc> done, OnDeallocatedFunction onDeallocated) override {
        for (FinalizedAlloc& one : done)
            one.release();
        onDeallocated(llvm::Error::success());
    }
    using JITLinkMemoryManager::deallocate;

  private:
    class InFlight : public InFlightAlloc {
        void abandon(OnAbandonedFunction onAbandoned) override { onAbandoned(llvm::Error::success()); }
        void finalize(OnFinalizedFunction onFinalized) override {
            onFinalized(FinalizedAlloc(orc::ExecutorAddr(kPlace)));
        }
    };
    rt::UnitImage& image_;
};

/// Links one object; everything happens within jitlink::link.
class ImageContext : public jitlink::JITLinkContext {
  public:
    ImageContext(rt::UnitImage& image, std::string& error)
        : JITLinkContext(nullptr), image_(image), memory_(image), error_(error) {}

    jitlink::JITLinkMemoryManager& getMemoryManager() override { return memory_; }
    void notifyFailed(llvm::Error failure) override { error_ = llvm::toString(std::move(failure)); }
    llvm::Error notifyResolved(jitlink::LinkGraph&) override { return llvm::Error::success(); }
    void notifyFinalized(jitlink::JITLinkMemoryManager::FinalizedAlloc done) override { done.release(); }

    void lookup(const LookupMap& symbols,
                std::unique_ptr<jitlink::JITLinkAsyncLookupContinuation> next) override {
        jitlink::AsyncLookupResult result;
        for (const auto& entry : symbols) {
            result[entry.first] = {orc::ExecutorAddr(kImports + kImportStep * image_.imports.size()),
                                   llvm::JITSymbolFlags::Exported};
            numbers_[entry.first] = static_cast<int32_t>(image_.imports.size());
            image_.imports.push_back(entry.first.str());
        }
        next->run(std::move(result));
    }

    llvm::Error modifyPassConfig(jitlink::LinkGraph&, jitlink::PassConfiguration& passes) override {
        passes.PostFixupPasses.push_back([this](jitlink::LinkGraph& graph) { return listPatches(graph); });
        return llvm::Error::success();
    }

  private:
    static llvm::Error unexpected(const jitlink::LinkGraph& graph, const jitlink::Edge& edge) {
        return llvm::make_error<llvm::StringError>(std::string("internal error: relocation ") +
                                                       graph.getEdgeKindName(edge.getKind()) +
                                                       " depends on where the code lies",
                                                   llvm::inconvertibleErrorCode());
    }

    static bool isAbsolute(const jitlink::LinkGraph& graph, jitlink::Edge::Kind kind) {
        return graph.getTargetTriple().isAArch64() ? kind == jitlink::aarch64::Pointer64
                                                   : kind == jitlink::x86_64::Pointer64;
    }

    llvm::Error listPatches(jitlink::LinkGraph& graph) {
        for (jitlink::Block* block : graph.blocks()) {
            if (block->getSection().getMemLifetime() == orc::MemLifetime::NoAlloc) continue;
            for (const jitlink::Edge& edge : block->edges()) {
                if (!edge.isRelocation()) continue;
                const jitlink::Symbol& target = edge.getTarget();
                if (isAbsolute(graph, edge.getKind())) {
                    rt::UnitImage::Patch patch;
                    patch.offset = block->getAddress().getValue() + edge.getOffset() - kPlace;
                    patch.addend = edge.getAddend();
                    if (target.isExternal())
                        patch.import = numbers_.lookup(target.getName());
                    else
                        patch.addend += static_cast<int64_t>(target.getAddress().getValue() - kPlace);
                    image_.patches.push_back(patch);
                } else if (!target.isDefined()) {
                    return unexpected(graph, edge);
                }
            }
        }
        for (const jitlink::Symbol* symbol : graph.defined_symbols())
            if (symbol->hasName() && symbol->getName() == kProgramSymbol)
                image_.program = symbol->getAddress().getValue() - kPlace;
        return llvm::Error::success();
    }

    rt::UnitImage& image_;
    ImageMemory memory_;
    std::string& error_;
    llvm::DenseMap<llvm::StringRef, int32_t> numbers_;
};

} // namespace

bool emitImage(const ir::Module& module, const CodegenOptions& options, rt::UnitImage& image,
               std::string& error) {
    CodegenOptions plain = options;
    plain.debugInfo = false; // it would not be read
    llvm::SmallVector<char, 0> bytes;
    if (!compileTo(module, plain, llvm::CodeGenFileType::ObjectFile, bytes, error)) return false;
    image = {};
    error.clear();
    auto graph = jitlink::createLinkGraphFromObject(
        llvm::MemoryBufferRef(llvm::StringRef(bytes.data(), bytes.size()), module.name));
    if (graph)
        jitlink::link(std::move(*graph), std::make_unique<ImageContext>(image, error));
    else
        error = llvm::toString(graph.takeError());
    return error.empty();
}

} // namespace codegen
