// codegen.h for executables that load code generation when they need it. Not thread safe before the first call has returned.

#include "codegen/plugin/backend.h"

#include <dlfcn.h>
#include <filesystem>

namespace codegen {

namespace {

void (*outOfMemoryHandler)() = nullptr;

const Backend* load(std::string& error) {
    std::error_code ignored;
    const auto self = std::filesystem::read_symlink("/proc/self/exe", ignored);
    const std::string path = (self.parent_path() / kBackendPath).string();
    // Stays loaded: compiled code and its objects refer to it.
    void* library = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    void* entry = library ? ::dlsym(library, kBackendSymbol) : nullptr;
    if (!entry) {
        const char* reason = ::dlerror();
        error = "cannot load the code generator: " + std::string(reason ? reason : path.c_str()) +
                "; the installation of rapidc is incomplete";
        return nullptr;
    }
    const Backend* backend = reinterpret_cast<decltype(&rapidc_codegen_backend)>(entry)();
    if (backend->layout != layoutOfInterface()) {
        error = "the code generator " + path + " belongs to another version of rapidc; install both again";
        return nullptr;
    }
    if (outOfMemoryHandler) backend->guardMemory(outOfMemoryHandler);
    return backend;
}

/// Null and `error` when the library cannot be loaded.
const Backend* backend(std::string& error) {
    static const Backend* loaded = nullptr;
    if (!loaded) loaded = load(error);
    return loaded;
}

} // namespace

void guardMemory(void (*outOfMemory)()) {
    outOfMemoryHandler = outOfMemory; // there is nothing to guard before the library is loaded
}

std::unique_ptr<JitProgram> jit(const ir::Module& module, const CodegenOptions& options,
                                const std::vector<NativeSymbol>& symbols, std::string& error) {
    const Backend* used = backend(error);
    return used ? used->jit(module, options, symbols, error) : nullptr;
}

bool emitObject(const ir::Module& module, const std::string& path, const CodegenOptions& options,
                std::string& error) {
    const Backend* used = backend(error);
    return used && used->emitObject(module, path, options, error);
}

bool emitObjects(const ir::Module& module, const std::string& folder, const CodegenOptions& options,
                 std::vector<std::string>& paths, std::string& error) {
    const Backend* used = backend(error);
    return used && used->emitObjects(module, folder, options, paths, error);
}

bool emitImage(const ir::Module& module, const CodegenOptions& options, rt::UnitImage& image,
               std::string& error) {
    const Backend* used = backend(error);
    return used && used->emitImage(module, options, image, error);
}

std::string emitLlvm(const ir::Module& module, const CodegenOptions& options, std::string& error) {
    const Backend* used = backend(error);
    return used ? used->emitLlvm(module, options, error) : std::string();
}

std::string emitAsm(const ir::Module& module, const CodegenOptions& options, std::string& error) {
    const Backend* used = backend(error);
    return used ? used->emitAsm(module, options, error) : std::string();
}

bool linkExecutable(const std::vector<std::string>& objects, const std::string& outputPath,
                    const LinkOptions& options, std::string& error) {
    const Backend* used = backend(error);
    return used && used->linkExecutable(objects, outputPath, options, error);
}

} // namespace codegen
