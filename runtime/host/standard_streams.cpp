#include "runtime/host/standard_streams.h"

#include "runtime/host/run_options.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fcntl.h>
#include <fmt/format.h>
#include <new>
#include <system_error>
#include <unistd.h>

namespace rt {
namespace {

/// Always takes everything: fmt::print throws when a stream does not, here through compiled code as well.
ssize_t writeToStandardError(void* /*cookie*/, const char* text, size_t size) {
    size_t done = 0;
    while (done < size) {
        const ssize_t written = ::write(STDERR_FILENO, text + done, size - done);
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) break;
        done += static_cast<size_t>(written);
    }
    return static_cast<ssize_t>(size);
}

const char* programName = "rapidc";

/// Not every library asks for memory by `new`, and some throw where nothing can catch.
[[noreturn]] void endAfterException() {
    try {
        if (std::current_exception()) throw;
    } catch (const std::bad_alloc&) {
        endOutOfMemory();
    } catch (const std::system_error& problem) {
        const auto condition = problem.code().default_error_condition();
        if (condition == std::errc::not_enough_memory ||
            condition == std::errc::resource_unavailable_try_again)
            endOutOfMemory();
    } catch (...) { // a mistake of the program itself
    }
    std::abort();
}

} // namespace

void endOutOfMemory() {
    const auto say = [](const char* text) { writeToStandardError(nullptr, text, std::strlen(text)); };
    say(programName);
    say(": out of memory: give the process more (ulimit -v), or split the input\n");
    std::_Exit(kOutOfMemory);
}

void guardLimits(const char* program) {
    programName = program;
    std::signal(SIGXFSZ, SIG_IGN); // the write fails with EFBIG then
    std::set_new_handler(endOutOfMemory);
    std::set_terminate(endAfterException);
}

void guardStandardStreams() {
    // Open in the wrong direction: what is written is still refused.
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (::fcntl(descriptor, F_GETFD) < 0 && errno == EBADF)
            static_cast<void>(::open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY));
    cookie_io_functions_t functions{};
    functions.write = writeToStandardError;
    FILE* patient = ::fopencookie(nullptr, "w", functions);
    if (patient == nullptr) return;
    std::setvbuf(patient, nullptr, _IONBF, 0);
    stderr = patient;
}

int finishStandardOutput(const std::string& program, int status) {
    errno = 0;
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return status;
    const std::string reason = errno == 0 ? "" : fmt::format(": {}", std::strerror(errno));
    fmt::print(stderr, "{}: output is lost, standard output cannot be written{}\n", program, reason);
    return status == 0 ? static_cast<int>(ExitStatus::BadUsage) : status;
}

} // namespace rt
