#pragma once
// From IR to machine code: in memory (ORC JIT) or as an object file. Free of LLVM headers, so that the rest of the
// compiler does not pay for them. A module must have passed ir::verify (ir::runPasses does that).

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ir {
struct Module;
}
namespace rt {
struct ProgramDesc;
struct UnitImage;
} // namespace rt

namespace codegen {

/// IR instructions of a program from which on it takes seconds to compile it as a whole, and from which on a person notices.
inline constexpr size_t kLargeProgram = 15'000, kSmallProgram = 1'500;

/// Makes a routine of the module ready to be compiled. False and a message when it is not well formed.
using PrepareRoutine = std::function<bool(uint32_t routine, std::string& error)>;

/// Natives whose bodies are known (codegen/bodies): optimised programs inline them.
struct NativeBodies {
    std::string_view bitcode;
    std::span<const std::string_view> names; ///< in ascending order

    bool contains(std::string_view name) const {
        return std::binary_search(names.begin(), names.end(), name);
    }
};

/// Frees the instructions of a routine of the module: no code will be generated from them any more.
using ReleaseRoutine = std::function<void(uint32_t routine)>;

/// Holds a table as long as the code that refers to it, and returns where it lies. On any thread.
using HoldTable = std::function<const uint32_t*(std::vector<uint32_t> table)>;

struct CodegenOptions {
    bool optimise =
        true; ///< LLVM's O2 pipeline; off for the stepping profile, where variables stay in memory
    bool debugInfo =
        true; ///< DWARF line tables that name the lines of the source; in the JIT gdb gets them, too
    NativeBodies bodies = {}; ///< none: every native is called
    /// IR instructions of a program from which on it is compiled in parts: by jit() each routine when it is called first, by
    /// emitObjects() a module of the source at a time, on all processors.
    size_t partsAbove = kLargeProgram;
    /// Called once for each routine of such a program before it is compiled, on any thread, never twice at a time for one; empty:
    /// all are ready.
    PrepareRoutine prepare = {};
    /// Called by jit() for a huge routine of such a program when its words are written; empty: its instructions remain.
    ReleaseRoutine release = {};
    /// Takes the words of huge routines, which an object would hold several times while it is made; empty: they are part of it.
    HoldTable holdTable = {};
    /// The program is executed once from its beginning to its end: jit() leaves out the optimiser when few instructions can be
    /// executed at all, since it would take longer than they do.
    bool isExecutedOnce = false;
    bool namesValues = false;     ///< LLVM values have names: for people who read them
    bool interpretsAll = false;   ///< every routine is interpreted, not only huge ones: for tests
    bool trustCache = true;       ///< off: objects are made again and replace those in the cache
    std::string cacheFolder = {}; ///< where emitObjects() keeps the objects of parts; empty: nowhere
};

/// A C function (or datum) that compiled code may refer to.
struct NativeSymbol {
    std::string_view name;
    const void* address = nullptr;
};

/// Compiled code in memory. The code lives as long as this object.
class JitProgram {
  public:
    virtual ~JitProgram() = default;
    /// The description that the runtime starts a program from (symbol `rapidc_program`).
    virtual const rt::ProgramDesc* program() const = 0;
};

/// Compiles `module` in memory. Natives and globals of kind External are looked up in `symbols`; names that are
/// missing there make it fail. Returns null and a message in `error` on failure. `module` must outlive the program.
std::unique_ptr<JitProgram> jit(const ir::Module& module, const CodegenOptions& options,
                                const std::vector<NativeSymbol>& symbols, std::string& error);

/// LLVM calls `outOfMemory`, which does not return, instead of ending the process when memory runs out. Once, at the start.
void guardMemory(void (*outOfMemory)());

/// Writes a relocatable object (position independent) that defines `rapidc_program`. The same bytes for the same
/// module, whatever the host's processor.
bool emitObject(const ir::Module& module, const std::string& path, const CodegenOptions& options,
                std::string& error);

/// Writes the objects of `module` into an existing folder: one, or those of its parts. Their paths are added to `paths`. Parts
/// that are the same as in an earlier build come from the cache.
bool emitObjects(const ir::Module& module, const std::string& folder, const CodegenOptions& options,
                 std::vector<std::string>& paths, std::string& error);

/// Compiles `module` into an image that any process can map, without debug information. False and a message in `error` on
/// failure.
bool emitImage(const ir::Module& module, const CodegenOptions& options, rt::UnitImage& image,
               std::string& error);

/// Text of the LLVM IR (after optimisation when asked for) or of the assembly; empty with `error` set on failure.
std::string emitLlvm(const ir::Module& module, const CodegenOptions& options, std::string& error);
std::string emitAsm(const ir::Module& module, const CodegenOptions& options, std::string& error);

struct LinkOptions {
    std::vector<std::string>
        libraries; ///< paths of static libraries and objects, in link order (may refer to
                   ///< each other in circles)
    std::vector<std::string>
        extraArguments; ///< passed on to the linker driver after the libraries, e.g. "-lpthread"
    std::string driver; ///< compiler driver; empty: clang++-19, clang++, g++-12, g++, c++ in turn
    std::vector<std::string> wholeLibraries; ///< as `libraries`, but nothing in them is left out
    bool stripDebug = false;
};

/// How `error` begins when the linker objects.
inline constexpr std::string_view kLinkingFailed = "linking failed";
/// Links objects and libraries into an executable. `error` names what is missing (a linker driver, a library, a symbol).
bool linkExecutable(const std::vector<std::string>& objects, const std::string& outputPath,
                    const LinkOptions& options, std::string& error);

} // namespace codegen
