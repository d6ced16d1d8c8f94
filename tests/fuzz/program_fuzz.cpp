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
    fuzz::tryProgram(runner, program.tasks, program.hasTime, program.optimise);
    return 0;
}
