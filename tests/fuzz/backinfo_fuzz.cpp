// libFuzzer target: any bytes as backinfo.txt. Tasks have folders and names, modules have files.

#include "frontend/project/backinfo.h"
#include "fuzz_support.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using rapid::fuzz::require;
    const rapid::project::BackupInfo info = rapid::project::readBackupInfo(rapid::fuzz::bytesOf(data, size));
    size_t modules = 0;
    for (const rapid::project::ListedTask& task : info.tasks) {
        require(!task.folder.empty() && !task.name.empty(), "a task without a name");
        modules += task.modules.size();
        for (const rapid::project::ListedModule& module : task.modules)
            require(!module.file.empty() && module.file.find('/') == std::string::npos,
                    "a module without a file");
    }
    require(modules + info.tasks.size() <= size, "more modules than bytes");
    return 0;
}
