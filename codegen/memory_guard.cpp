#include "codegen/codegen.h"

#include <llvm/Support/ErrorHandling.h>

namespace codegen {

void guardMemory(void (*outOfMemory)()) {
    llvm::install_bad_alloc_error_handler([](void* handler, const char* /*reason*/,
                                             bool /*crash*/) { reinterpret_cast<void (*)()>(handler)(); },
                                          reinterpret_cast<void*>(outOfMemory));
}

} // namespace codegen
