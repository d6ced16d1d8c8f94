// libFuzzer target: any bytes as a program file. The names in it are file names that exist in some spelling.

#include "frontend/project/program_file.h"
#include "fuzz_support.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using rapid::fuzz::require;
    std::vector<std::string> modules;
    rapid::project::readProgramFile(rapid::fuzz::bytesOf(data, size), modules);
    size_t bytes = 0;
    for (const std::string& name : modules) {
        require(!name.empty() && name.find('\\') == std::string::npos, "a name that is none");
        bytes += name.size();
    }
    require(bytes <= 2 * size, "names longer than the file");
    return 0;
}
