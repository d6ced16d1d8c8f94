#include "runtime/base/output_file.h"

#include <cerrno>
#include <chrono>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

namespace rt {
namespace {

constexpr std::chrono::seconds kWaitForReader{10};

bool isPipe(const std::string& path) {
    struct stat status{};
    return ::stat(path.c_str(), &status) == 0 && S_ISFIFO(status.st_mode);
}

/// -1 with errno; ENXIO: no program has opened the pipe for reading.
int openToWrite(const std::string& path) {
    const auto end = std::chrono::steady_clock::now() + kWaitForReader;
    const bool pipe = isPipe(path);
    for (;;) {
        const int file =
            ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | (pipe ? O_NONBLOCK : 0), 0666);
        const bool wait = file < 0 && (errno == EINTR || (pipe && errno == ENXIO));
        if (!wait || std::chrono::steady_clock::now() >= end) {
            if (file >= 0 && pipe) ::fcntl(file, F_SETFL, ::fcntl(file, F_GETFL) & ~O_NONBLOCK);
            return file;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
}

std::string cannotWrite(const std::string& path, int error) {
    return fmt::format("cannot write {}: {}", path,
                       error == ENXIO ? "no program reads this pipe" : std::strerror(error));
}

} // namespace

bool OutputFile::open(const std::string& path, std::string& error) {
    path_ = path;
    const int file = openToWrite(path);
    file_ = file < 0 ? nullptr : ::fdopen(file, "w");
    if (file_ != nullptr) return true;
    error = cannotWrite(path, errno);
    if (file >= 0) ::close(file);
    return false;
}

void OutputFile::fail() {
    if (!failed_)
        fmt::print(stderr, "error: {} could not be written in full: {}\n", path_,
                   errno != 0 ? std::strerror(errno) : "writing failed");
    failed_ = true;
}

void OutputFile::write(std::string_view text) {
    errno = 0;
    if (file_ != nullptr && std::fwrite(text.data(), 1, text.size(), file_) != text.size()) fail();
}

void OutputFile::flush() {
    errno = 0;
    if (file_ != nullptr && std::fflush(file_) != 0) fail();
}

bool OutputFile::close() {
    errno = 0;
    if (file_ != nullptr && std::fclose(file_) != 0) fail();
    file_ = nullptr;
    return !failed_;
}

std::string writeWhole(const std::string& path, std::string_view text) {
    const int file = openToWrite(path);
    if (file < 0) return cannotWrite(path, errno);
    int error = 0;
    while (!text.empty() && error == 0) {
        const ssize_t done = ::write(file, text.data(), text.size());
        if (done < 0 && errno != EINTR) error = errno;
        if (done > 0) text.remove_prefix(static_cast<std::size_t>(done));
    }
    if (::close(file) != 0 && error == 0) error = errno;
    return error == 0 ? std::string() : cannotWrite(path, error);
}

} // namespace rt
