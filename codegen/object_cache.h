#pragma once
// Objects of parts that have been compiled before. The key is everything that decides the object: the unoptimised bitcode,
// the options and the code generator itself.

#include <llvm/IR/Module.h>

#include <string>

#include "codegen/codegen.h"

namespace codegen {

class ObjectCache {
  public:
    /// `folder`: created when it is missing; empty: nothing is kept. `bodies`: natives that programs inline.
    ObjectCache(std::string folder, const NativeBodies& bodies);

    /// The key of an object that is to be made from `module`; "" when nothing is kept.
    std::string keyOf(const llvm::Module& module, const CodegenOptions& options) const;
    /// Puts the object at `path`. False when there is none.
    bool fetch(const std::string& key, const std::string& path) const;
    /// Failures are not reported: the object is made again the next time.
    void keep(const std::string& key, const std::string& path) const;
    /// Removes the objects that have not been used for longest until the others take at most `bytes`.
    void shrink(uint64_t bytes) const;

  private:
    std::string fileOf(const std::string& key) const;

    std::string folder_, generator_; ///< the code generator and the bodies, as part of keys
};

} // namespace codegen
