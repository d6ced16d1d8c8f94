#include "stdlib/impl/files/open_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <ctime>
#include <utility>

namespace rt::lib {
namespace {

constexpr std::size_t kPendingBytes = std::size_t{64} << 10;
constexpr std::size_t kReadBytes = std::size_t{64} << 10;

bool isPipe(int file) {
    struct stat status{};
    return ::fstat(file, &status) == 0 && S_ISFIFO(status.st_mode);
}

} // namespace

OpenFile::OpenFile(std::string name, Mode mode, Descriptor input, Descriptor output, bool isDevice)
    : name_(std::move(name)), mode_(mode), input_(std::move(input)), output_(std::move(output)),
      isDevice_(isDevice) {
    if (!isDevice_ && mode_.writes) pending_.reserve(kPendingBytes);
}

bool OpenFile::canPoll() const {
    return isPipe(input_.number());
}

std::string OpenFile::write(std::string_view bytes) {
    if (!backToPosition()) return std::strerror(errno);
    if (pending_.size() + bytes.size() > kPendingBytes || (isDevice_ && !pending_.empty()))
        if (std::string problem = send(); !problem.empty()) return problem;
    const std::size_t before = pending_.size();
    pending_ += bytes;
    written_ = true;
    if (!isDevice_) return {};
    std::string problem = send();
    if (pending_.size() < before + bytes.size())
        return {}; // some of it has gone: the rest follows with the next
    pending_.resize(before);
    return problem;
}

/// Data that cannot be written stay pending.
std::string OpenFile::send() {
    std::size_t sent = 0;
    int problem = 0;
    while (sent < pending_.size()) {
        const ssize_t count = ::write(out().number(), pending_.data() + sent, pending_.size() - sent);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) {
            problem = count == 0 ? EIO : errno;
            break;
        }
        sent += static_cast<std::size_t>(count);
    }
    pending_.erase(0, sent);
    if (problem == EAGAIN) return "nothing takes what is written";
    return problem == 0 ? std::string() : std::strerror(problem);
}

std::string OpenFile::flush(int64_t calendar) {
    if (!written_) return {};
    if (std::string problem = send(); !problem.empty()) return problem;
    const timespec moment{static_cast<time_t>(calendar), 0};
    const timespec both[] = {moment, moment};
    ::futimens(out().number(), both); // FIFOs and foreign files keep theirs
    written_ = false;
    return {};
}

/// Writing after reading begins at the byte that would be read next.
bool OpenFile::backToPosition() {
    const std::size_t ahead = buffer_.size() - next_;
    if (buffer_.empty() || isDevice_) return true;
    buffer_.clear();
    next_ = 0;
    return ahead == 0 || ::lseek(input_.number(), -static_cast<off_t>(ahead), SEEK_CUR) >= 0;
}

OpenFile::Fill OpenFile::fill(std::string& problem) {
    buffer_.erase(0, std::exchange(next_, 0));
    const std::size_t before = buffer_.size();
    buffer_.resize(before + kReadBytes);
    ssize_t count = 0;
    do
        count = ::read(input_.number(), buffer_.data() + before, kReadBytes);
    while (count < 0 && errno == EINTR);
    const int error = count < 0 ? errno : 0;
    buffer_.resize(before + static_cast<std::size_t>(count > 0 ? count : 0));
    if (count > 0) return Fill::More;
    if (count == 0) return isDevice_ ? Fill::Later : Fill::End;
    if (error == EAGAIN) return Fill::Later;
    problem = std::strerror(error);
    return Fill::Failed;
}

void OpenFile::discardInput() {
    std::string ignored;
    do
        next_ = buffer_.size();
    while (fill(ignored) == Fill::More);
    next_ = buffer_.size();
}

std::string OpenFile::rewind() {
    if (isDevice_ || canPoll()) return "a device has no beginning to go back to";
    if (std::string problem = send(); !problem.empty()) return problem;
    buffer_.clear();
    next_ = 0;
    return ::lseek(input_.number(), 0, SEEK_SET) < 0 ? std::strerror(errno) : std::string();
}

} // namespace rt::lib
