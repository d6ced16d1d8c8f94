#include "runtime/host/rapidc_process.h"

#include "config/atomic_file.h"
#include "runtime/base/descriptor.h"

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

/// To be read from the beginning. 0 or the number of the error.
int writeInput(int file, std::string_view bytes) {
    if (const int error = rapid::config::writeAll(file, bytes); error != 0) return error;
    return ::lseek(file, 0, SEEK_SET) == 0 ? 0 : errno;
}

std::string readAll(int file) {
    std::string text;
    if (::lseek(file, 0, SEEK_SET) != 0) return text;
    char buffer[4096];
    for (;;) {
        const ssize_t done = ::read(file, buffer, sizeof buffer);
        if (done < 0 && errno == EINTR) continue;
        if (done <= 0) return text;
        text.append(buffer, static_cast<std::size_t>(done));
    }
}

} // namespace

RapidcAnswer askRapidc(std::vector<std::string> arguments, std::string_view input) {
    RapidcAnswer answer;
    const char* named = std::getenv(kRapidcVariable);
    answer.program = named != nullptr && *named != '\0' ? named : "rapidc";
    arguments.insert(arguments.begin(), answer.program);
    // Its output goes to memory: no process has to read while it writes.
    const Descriptor in{::memfd_create("input", MFD_CLOEXEC)}, out{::memfd_create("output", MFD_CLOEXEC)},
        said{::memfd_create("said", MFD_CLOEXEC)};
    const bool areOpen = in.number() >= 0 && out.number() >= 0 && said.number() >= 0;
    if (const int error = areOpen ? writeInput(in.number(), input) : errno; error != 0) {
        answer.status = -1;
        answer.error = error;
        return answer;
    }
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, in.number(), STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, out.number(), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, said.number(), STDERR_FILENO);
    std::vector<char*> argv;
    for (std::string& argument : arguments)
        argv.push_back(argument.data());
    argv.push_back(nullptr);
    pid_t child = 0;
    answer.error = ::posix_spawnp(&child, argv[0], &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (answer.error != 0) {
        answer.status = -1;
        return answer;
    }
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    answer.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128;
    answer.out = readAll(out.number());
    answer.said = readAll(said.number());
    while (!answer.said.empty() && answer.said.back() == '\n')
        answer.said.pop_back();
    return answer;
}

std::string RapidcAnswer::notStarted(std::string_view purpose) const {
    return fmt::format(
        "an executable needs the installed rapidc to {}, and '{}' could not be started ({}): put it "
        "in PATH, or name it in the environment variable {}",
        purpose, program, std::strerror(error), kRapidcVariable);
}

StoreResult RapidcProcess::store(const ModuleText& text) {
    std::string input;
    for (const SavedValue& value : text.values)
        input += fmt::format("{}.{}={}\n", value.module, value.name, value.text);
    StoreResult result;
    const RapidcAnswer answer =
        askRapidc({"set-value", "--values=-", "--output=" + text.destination, text.source}, input);
    if (answer.status < 0)
        result.problem = answer.notStarted("write modules");
    else if (answer.status != 0)
        result.problem = answer.said.empty()
                             ? fmt::format("{} ended with status {}", answer.program, answer.status)
                             : answer.said;
    else if (!answer.said.empty())
        result.notes.push_back(answer.said);
    return result;
}

} // namespace rt
