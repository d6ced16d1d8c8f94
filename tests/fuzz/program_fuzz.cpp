// libFuzzer target: the bytes choose a well-typed program. It must come through to machine code and a bounded run, and
// print the same in the release and the stepping profile.

#include "fuzz_support.h"
#include "stdlib/native_table.h"
#include "tests/fuzz/program_maker.h"
#include "tests/fuzz/program_runner.h"

namespace {

using namespace rapid;

bool isImplemented(std::string_view name) {
    return rt::findNativeAddress("rt_" + std::string(name)) != nullptr;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static fuzz::ProgramRunner runner;
    static const fuzz::Catalog catalog(runner.library(), isImplemented);
    fuzz::ProgramMaker maker(catalog, data, size);
    const fuzz::MadeProgram program = maker.make();
    static const bool shows = std::getenv("RAPIDC_FUZZ_SHOW") != nullptr;
    if (shows)
        for (const auto& task : program.tasks)
            for (const std::string& text : task)
                std::fprintf(stderr, "%s", text.c_str());
    const bool accepted = fuzz::tryProgram(runner, program.tasks, program.hasTime);
    if (shows && !accepted) std::fprintf(stderr, "%s", runner.errors().c_str());
    static size_t all = 0, good = 0;
    ++all;
    good += accepted ? 1u : 0u;
    if (all % 1000 == 0) std::fprintf(stderr, "%zu programs, %zu accepted\n", all, good);
    return 0;
}
