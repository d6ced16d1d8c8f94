#pragma once
// Steps that Load and WaitLoad have in common.

#include "runtime/host/controller.h"

#include <string>

namespace rt::lib {

/// A module file that has been read.
struct ModuleFile {
    std::string path;  ///< on the host
    std::string shown; ///< as the program wrote it
    std::string bytes;
    int64_t time = -1; ///< of its last change
};

/// Why a file cannot be loaded; kOk: it can.
struct ReadProblem {
    Status number = kOk;
    std::string text;
};

/// Finds and reads it: ERR_FILNOTFND, ERR_IOERROR or ERR_PRGMEMFULL.
ReadProblem tryReadModule(TaskCore* task, const String& directory, const String* file, ModuleFile& out);
/// The same; raises the problem.
Status readModule(TaskCore* task, const String& directory, const String* file, ModuleFile& out);
/// How long loading takes, in virtual time.
Time loadingTime(const ModuleFile& file);
/// Compiles and links. Raises ERR_SYNTAX, ERR_LOADED, ERR_PRGMEMFULL, ERR_IOERROR and, with `checkReferences`,
/// ERR_LINKREF; the module is not in memory then.
Status linkModule(TaskCore* task, const ModuleFile& file, bool dynamic, bool checkReferences);
/// Takes a module that was loaded from a file out of memory. Raises ERR_UNLOAD.
Status unloadFile(TaskCore* task, const String& directory, const String* file);
/// References of the task that nothing declares: ERR_LINKREF.
Status checkReferencesOf(TaskCore* task);

} // namespace rt::lib
