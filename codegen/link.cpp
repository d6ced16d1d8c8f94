// Linking an executable by way of an installed compiler driver.

#include <llvm/Support/FileSystem.h>
#include <llvm/Support/FileUtilities.h>
#include <llvm/Support/MemoryBuffer.h>
#include <llvm/Support/Program.h>

#include <optional>

#include "codegen/codegen.h"

namespace codegen {
namespace {

constexpr const char* kDrivers[] = {"clang++-19", "clang++", "g++-12", "g++", "c++"};

std::string findDriver(const std::string& wanted, std::string& error) {
    if (!wanted.empty()) {
        auto path = llvm::sys::findProgramByName(wanted);
        if (path) return *path;
        error = "the linker driver '" + wanted + "' was not found";
        return {};
    }
    for (const char* name : kDrivers)
        if (auto path = llvm::sys::findProgramByName(name)) return *path;
    error = "no linker driver was found: linking an executable needs clang++ or g++ on the PATH "
            "(Debian: apt install clang-19 lld-19, or g++)";
    return {};
}

bool canUseLld() {
    return bool(llvm::sys::findProgramByName("ld.lld"));
}

/// Runs the driver; what it says goes to a temporary file and from there into `error`.
bool runDriver(const std::vector<std::string>& arguments, std::string& error) {
    llvm::SmallString<64> log;
    if (llvm::sys::fs::createTemporaryFile("rapidc-link", "txt", log)) {
        error = "cannot create a temporary file";
        return false;
    }
    const llvm::FileRemover remover(log);
    std::vector<llvm::StringRef> views(arguments.begin(), arguments.end());
    llvm::StringRef file = log.str();
    std::string message;
    int status = llvm::sys::ExecuteAndWait(arguments[0], views, std::nullopt, {std::nullopt, file, file}, 0,
                                           0, &message);
    std::string said;
    if (auto buffer = llvm::MemoryBuffer::getFile(file)) said = (*buffer)->getBuffer().str();
    if (status == 0) return true;
    error = std::string(kLinkingFailed) + " (" + arguments[0] + ", status " + std::to_string(status) + ")";
    if (!message.empty()) error += ": " + message;
    if (!said.empty()) error += ":\n" + said;
    return false;
}

} // namespace

bool linkExecutable(const std::vector<std::string>& objects, const std::string& outputPath,
                    const LinkOptions& options, std::string& error) {
    std::string driver = findDriver(options.driver, error);
    if (driver.empty()) return false;
    for (const auto* libraries : {&options.libraries, &options.wholeLibraries})
        for (const std::string& library : *libraries) {
            if (llvm::sys::fs::exists(library)) continue;
            error = "the library " + library + " is missing: the installation of rapidc is incomplete";
            return false;
        }
    std::vector<std::string> arguments{driver};
    arguments.insert(arguments.end(), objects.begin(), objects.end());
    // written, not mapped into memory: so a full disk is an error of the linker, not a signal that kills it
    if (canUseLld()) arguments.insert(arguments.end(), {"-fuse-ld=lld", "-Wl,--no-mmap-output-file"});
    if (options.stripDebug) arguments.push_back("-Wl,--strip-debug");
    if (!options.wholeLibraries.empty()) {
        arguments.push_back("-Wl,--whole-archive");
        arguments.insert(arguments.end(), options.wholeLibraries.begin(), options.wholeLibraries.end());
        arguments.push_back("-Wl,--no-whole-archive");
    }
    arguments.push_back("-Wl,--start-group");
    arguments.insert(arguments.end(), options.libraries.begin(), options.libraries.end());
    arguments.push_back("-Wl,--end-group");
    arguments.insert(arguments.end(), options.extraArguments.begin(), options.extraArguments.end());
    arguments.insert(arguments.end(), {"-o", outputPath});
    return runDriver(arguments, error);
}

} // namespace codegen
