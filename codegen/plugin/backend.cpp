#include "codegen/plugin/backend.h"

const codegen::Backend* rapidc_codegen_backend() {
    using namespace codegen;
    static const Backend backend = {layoutOfInterface(), &jit,         &guardMemory,
                                    &emitObject,         &emitObjects, &emitImage,
                                    &emitLlvm,           &emitAsm,     &linkExecutable};
    return &backend;
}
