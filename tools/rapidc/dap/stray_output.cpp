#include "tools/rapidc/dap/stray_output.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/types.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace rapidc::dap {

StrayOutput::StrayOutput() {
    std::fflush(nullptr);
    output_ = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
    errors_ = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
    memory_ = ::memfd_create("output", MFD_CLOEXEC);
    if (output_ < 0 || errors_ < 0 || memory_ < 0)
        throw std::system_error(errno, std::generic_category(), "standard output");
    ::fcntl(memory_, F_SETFL, O_APPEND);
    ::dup2(memory_, STDOUT_FILENO);
    ::dup2(memory_, STDERR_FILENO);
}

StrayOutput::~StrayOutput() {
    if (memory_ < 0) return;
    std::fflush(nullptr);
    ::dup2(output_, STDOUT_FILENO);
    ::dup2(errors_, STDERR_FILENO);
    ::close(output_);
    ::close(errors_);
    ::close(memory_);
}

void StrayOutput::take(const std::function<void(std::string_view line)>& action) {
    constexpr long kMostKept = 1 << 20;
    if (memory_ < 0) return;
    std::fflush(stdout);
    std::fflush(stderr);
    char bytes[4096];
    for (;;) {
        const ssize_t got = ::pread(memory_, bytes, sizeof bytes, taken_);
        if (got <= 0) break;
        taken_ += got;
        unfinished_.append(bytes, static_cast<std::size_t>(got));
    }
    std::size_t begin = 0;
    for (std::size_t end = unfinished_.find('\n'); end != std::string::npos;
         end = unfinished_.find('\n', begin)) {
        action(std::string_view(unfinished_).substr(begin, end - begin));
        begin = end + 1;
    }
    unfinished_.erase(0, begin);
    if (taken_ < kMostKept) return;
    (void)!::ftruncate(memory_, 0);
    taken_ = 0;
}

} // namespace rapidc::dap
