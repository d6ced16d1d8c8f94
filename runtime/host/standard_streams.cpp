#include "runtime/host/standard_streams.h"

#include "runtime/host/run_options.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
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

} // namespace

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
