// StopSignals: the end of a process that does not look at the signal.

#include "runtime/host/stop_signals.h"

#include <catch2/catch.hpp>
#include <csignal>
#include <sys/wait.h>
#include <unistd.h>

// Serve contract, line 3: SIGTERM ends the controller with status 143, whatever it is at.
TEST_CASE("A process that does not look at the signal ends with its status", "[runtime]") {
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        const rt::StopSignals signals(std::chrono::milliseconds{20});
        std::raise(SIGTERM);
        for (;;)
            pause();
    }
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    CHECK(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 128 + SIGTERM);
}
