#include "config/read_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <sys/stat.h>

namespace rapid::config {

namespace {

std::string systemProblem() {
    return errno != 0 ? std::strerror(errno) : "reading failed";
}

} // namespace

std::string readFile(const std::string& path, std::string& bytes) {
    struct stat status{};
    errno = 0;
    if (::stat(path.c_str(), &status) != 0) return systemProblem();
    if (S_ISDIR(status.st_mode)) return "it is a folder";
    if (!S_ISREG(status.st_mode)) return "it is no ordinary file";
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
    if (!file) return systemProblem();
    constexpr size_t kStep = size_t{1} << 16;
    const auto expected = static_cast<size_t>(status.st_size);
    size_t length = 0;
    do { // one byte more than expected shows the end; a growing file is read to its end all the same
        if (expected > kLargestFile || length > kLargestFile) return "it is larger than 1 GB";
        bytes.resize(length + (length == 0 ? expected + 1 : kStep));
        length += std::fread(bytes.data() + length, 1, bytes.size() - length, file.get());
    } while (length == bytes.size());
    bytes.resize(length);
    return std::ferror(file.get()) != 0 ? systemProblem() : std::string();
}

} // namespace rapid::config
