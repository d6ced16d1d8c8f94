// The whole runtime linked without the standard library and without the compiler: that it links is the test. It runs a task
// that waits for a second of virtual time.

#include "unit/runtime/test_program.h"

int main() { // NOLINT(bugprone-exception-escape): out of memory may end it
    const auto body = [](rt::TaskCore* core, rt::Frame*) -> rt::Status {
        return rt::taskOf(core).sleepFor(rt::kSecond);
    };
    testing::Run run;
    run.task("T_ROB1", body);
    return run.run() == rt::ExitStatus::Ended && run.now() == rt::kSecond ? 0 : 1;
}
