#include "config/read_file.h"

#include <cerrno>
#include <chrono>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

namespace rapid::config {

namespace {

struct Descriptor {
    int number = -1;
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    explicit Descriptor(int opened) : number(opened) {}
    ~Descriptor() {
        if (number >= 0) ::close(number);
    }
};

std::string systemProblem() {
    return errno != 0 ? std::strerror(errno) : "reading failed";
}

/// "" for an ordinary file.
std::string notOrdinary(mode_t mode) {
    if (S_ISREG(mode)) return {};
    if (S_ISDIR(mode)) return "it is a folder";
    const char* kind = S_ISFIFO(mode) ? "pipe" : S_ISSOCK(mode) ? "socket" : "device";
    return fmt::format("it is a {}, not an ordinary file", kind);
}

/// Never waits for the other end of a pipe.
int openToRead(const std::string& path) {
    int file = -1;
    do
        file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
    while (file < 0 && errno == EINTR);
    return file;
}

/// Appends up to one step; the result of read().
ssize_t readStep(int file, std::string& bytes, size_t step) {
    const size_t length = bytes.size();
    bytes.resize(length + step);
    ssize_t got = -1;
    do
        got = ::read(file, bytes.data() + length, step);
    while (got < 0 && errno == EINTR);
    const int error = errno;
    bytes.resize(length + (got > 0 ? static_cast<size_t>(got) : 0));
    errno = error;
    return got;
}

constexpr size_t kStep = size_t{1} << 16;

/// Waits until the pipe has data or its writer is gone. False when the time is over.
bool waitFor(int file, std::chrono::steady_clock::time_point end, bool hasWriter) {
    constexpr int kLook = 100; // ms; poll does not report a writer that opens the pipe
    pollfd entry{file, POLLIN, 0};
    ::poll(&entry, 1, kLook);
    return entry.revents != 0 || hasWriter || std::chrono::steady_clock::now() < end;
}

/// While a pipe has never had a writer, read() says "end" at once; once it has one, "try again".
std::string readPipe(int file, std::string& bytes, double waitSeconds) {
    const auto end =
        std::chrono::steady_clock::now() + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                                               std::chrono::duration<double>(waitSeconds));
    bool hasWriter = false;
    for (;;) {
        pollfd entry{file, POLLIN, 0};
        ::poll(&entry, 1, 0);
        hasWriter = hasWriter || entry.revents != 0; // it may have written and gone
        const ssize_t got = readStep(file, bytes, kStep);
        if (bytes.size() > kLargestStream) return "it is larger than 256 MB";
        if (got > 0) continue;
        if (got == 0 && hasWriter) return {};
        if (got < 0 && errno != EAGAIN) return systemProblem();
        hasWriter = hasWriter || got < 0;
        if (!waitFor(file, end, hasWriter))
            return fmt::format("no program has opened this pipe for writing within {:g} s", waitSeconds);
    }
}

std::string readToEnd(int file, std::string& bytes) {
    for (;;) {
        const ssize_t got = readStep(file, bytes, kStep);
        if (got == 0) return {};
        if (got < 0 && errno != EAGAIN) return systemProblem();
        if (bytes.size() > kLargestStream) return "it is larger than 256 MB";
        if (got > 0) continue;
        pollfd entry{file, POLLIN, 0};
        ::poll(&entry, 1, -1);
    }
}

/// The size is a hint: a growing file is read to its end all the same.
std::string readOrdinary(int file, size_t expected, std::string& bytes) {
    if (expected > kLargestFile) return "it is larger than 1 GB";
    for (ssize_t got = 1; got > 0 && bytes.size() < expected;)
        if (got = readStep(file, bytes, expected - bytes.size()); got < 0) return systemProblem();
    for (std::string rest;; rest.clear()) {
        const ssize_t got = readStep(file, rest, kStep);
        if (got == 0) return {};
        if (got < 0) return systemProblem();
        bytes += rest;
        if (bytes.size() > kLargestFile) return "it is larger than 1 GB";
    }
}

} // namespace

std::string readFile(const std::string& path, std::string& bytes) {
    bytes.clear();
    errno = 0;
    struct stat status{};
    if (::stat(path.c_str(), &status) != 0) return systemProblem();
    if (std::string problem = notOrdinary(status.st_mode); !problem.empty()) return problem;
    const Descriptor file(openToRead(path));
    if (file.number < 0 || ::fstat(file.number, &status) != 0) return systemProblem();
    if (std::string problem = notOrdinary(status.st_mode); !problem.empty()) return problem;
    return readOrdinary(file.number, static_cast<size_t>(status.st_size), bytes);
}

std::string readStream(const std::string& path, std::string& bytes, double waitSeconds) {
    bytes.clear();
    errno = 0;
    // Opening /dev/stdin again fails for sockets and would lose the position in a file.
    if (path == "-" || path == "/dev/stdin") return readToEnd(STDIN_FILENO, bytes);
    struct stat status{};
    if (::stat(path.c_str(), &status) != 0) return systemProblem();
    if (S_ISREG(status.st_mode)) return readFile(path, bytes);
    if (!S_ISFIFO(status.st_mode) && !S_ISCHR(status.st_mode)) return notOrdinary(status.st_mode);
    const Descriptor file(openToRead(path));
    if (file.number < 0) return systemProblem();
    return S_ISFIFO(status.st_mode) ? readPipe(file.number, bytes, waitSeconds)
                                    : readToEnd(file.number, bytes);
}

} // namespace rapid::config
