// libFuzzer target: the bytes choose a program of several tasks. Output, events, signals with their times and errors must be the
// same in the release profile, the stepping profile and the interpreter.

#include "tests/fuzz/fuzz_support.h"
#include "tests/fuzz/program_runner.h"
#include "tests/fuzz/tasks_maker.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static rapid::fuzz::ProgramRunner runner;
    rapid::fuzz::TasksMaker maker(data, size);
    const rapid::fuzz::TaskTexts tasks = maker.make();
    rapid::fuzz::require(rapid::fuzz::tryTasks(runner, tasks, maker.robots()), "the program is refused");
    return 0;
}
