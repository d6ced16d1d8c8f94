#include "codegen/plugin/backend.h"

#include <malloc.h>

namespace {

/// LLVM allocates and frees much in small pieces: memory that is kept costs less than memory that is returned and fetched again.
void keepMemory() {
#ifdef __GLIBC__
    constexpr int kMegabyte = 1 << 20;
    mallopt(M_TOP_PAD, 16 * kMegabyte);
    mallopt(M_TRIM_THRESHOLD, 256 * kMegabyte);
    mallopt(M_MMAP_THRESHOLD, 32 * kMegabyte);
#endif
}

} // namespace

const codegen::Backend* rapidc_codegen_backend() {
    using namespace codegen;
    static const Backend backend = {layoutOfInterface(), &jit,         &guardMemory,
                                    &emitObject,         &emitObjects, &emitImage,
                                    &emitLlvm,           &emitAsm,     &linkExecutable};
    [[maybe_unused]] static const bool kReady = (keepMemory(), true);
    return &backend;
}
