#include "runtime/host/rapidc_process.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace rt {
namespace {

/// Closes a file descriptor at the end.
struct Descriptor {
    int number = -1;
    ~Descriptor() { close(); }
    void close() {
        if (number >= 0) ::close(number);
        number = -1;
    }
};

bool writeAll(int file, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t done = ::write(file, bytes.data(), bytes.size());
        if (done < 0 && errno == EINTR) continue;
        if (done < 0) return false;
        bytes.remove_prefix(static_cast<std::size_t>(done));
    }
    return ::lseek(file, 0, SEEK_SET) == 0;
}

std::string readAll(int file) {
    std::string text;
    char buffer[4096];
    for (;;) {
        const ssize_t done = ::read(file, buffer, sizeof buffer);
        if (done < 0 && errno == EINTR) continue;
        if (done <= 0) return text;
        text.append(buffer, static_cast<std::size_t>(done));
    }
}

/// What the child says on its error output, and its exit status; -1 when it could not be started (errno).
int runChild(const std::vector<std::string>& arguments, std::string_view input, std::string& said) {
    Descriptor in{::memfd_create("values", MFD_CLOEXEC)}, out, childOut;
    int ends[2];
    if (in.number < 0 || !writeAll(in.number, input) || ::pipe2(ends, O_CLOEXEC) != 0) return -1;
    out.number = ends[0];
    childOut.number = ends[1];
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, in.number, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, childOut.number, STDERR_FILENO);
    std::vector<char*> argv;
    for (const std::string& argument : arguments)
        argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    pid_t child = 0;
    const int error = ::posix_spawnp(&child, argv[0], &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    errno = error;
    if (error != 0) return -1;
    childOut.close();
    said = readAll(out.number);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

} // namespace

StoreResult RapidcProcess::store(const ModuleText& text) {
    const char* named = std::getenv(kVariable);
    const std::string program = named != nullptr && *named != '\0' ? named : "rapidc";
    std::string input, said;
    for (const SavedValue& value : text.values)
        input += fmt::format("{}.{}={}\n", value.module, value.name, value.text);
    StoreResult result;
    const int status = runChild(
        {program, "set-value", "--values=-", "--output=" + text.destination, text.source}, input, said);
    if (status < 0) {
        result.problem =
            fmt::format("an executable needs the installed rapidc to write modules, and '{}' could not be "
                        "started ({}): put it in PATH, or name it in the environment variable {}",
                        program, std::strerror(errno), kVariable);
        return result;
    }
    while (!said.empty() && said.back() == '\n')
        said.pop_back();
    if (status != 0)
        result.problem = said.empty() ? fmt::format("{} ended with status {}", program, status) : said;
    else if (!said.empty())
        result.notes.push_back(said);
    return result;
}

} // namespace rt
