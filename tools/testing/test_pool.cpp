#include "tools/testing/test_pool.h"

#include "config/atomic_file.h"
#include "runtime/host/stop_signals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <list>
#include <map>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

namespace testing {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMostOutput = std::size_t{1} << 20; // bytes kept of each stream
constexpr std::chrono::seconds kPatience{2};              // from SIGTERM to SIGKILL
constexpr int kMostPollMs = 200;

enum Stream { kOut, kErr, kResult, kStreams };

/// A test in progress.
struct Running {
    std::size_t number = 0; ///< of the test
    pid_t pid = -1;
    int fds[kStreams] = {-1, -1, -1};
    std::string bytes[kStreams];
    bool wasCut[kStreams] = {false, false, false};
    Clock::time_point began, deadline;
    bool isTimeout = false; ///< SIGTERM was sent for that
    bool isKilled = false;
};

void closeAll(int (&fds)[kStreams][2]) {
    for (auto& pair : fds)
        for (const int fd : pair)
            if (fd >= 0) close(fd);
}

[[noreturn]] void executeTest(const TestCase& test, const TestBody& body, int (&fds)[kStreams][2]) {
    setpgid(0, 0); // Ctrl-C reaches the parent, which ends the tests
    dup2(fds[kOut][1], STDOUT_FILENO);
    dup2(fds[kErr][1], STDERR_FILENO);
    const int result = fds[kResult][1];
    for (const int stream : {kOut, kErr})
        close(fds[stream][1]);
    for (auto& pair : fds)
        close(pair[0]);
    if (std::freopen("/dev/null", "r", stdin) == nullptr) std::_Exit(1); // no answer comes from a terminal
    const TestResult outcome = body(test);
    std::fflush(stdout);
    std::fflush(stderr);
    std::_Exit(rapid::config::writeAll(result, pack(outcome)) == 0 ? 0 : 1);
}

class Pool {
  public:
    Pool(const std::vector<TestCase>& tests, const PoolOptions& options, const TestBody& body,
         const TestDone& done)
        : tests_(tests), options_(options), body_(body), done_(done) {}

    bool run() {
        while (reported_ < tests_.size()) {
            if (rt::StopSignals::received() != 0) {
                endAll();
                return false;
            }
            start();
            deliver();
            if (!running_.empty()) wait();
        }
        return true;
    }

  private:
    void start() {
        while (next_ < tests_.size() && running_.size() < options_.jobs) {
            const TestCase& test = tests_[next_];
            TestResult result;
            result.spot = {test.file, test.module, test.name, test.line, test.column};
            if (!test.problem.empty()) {
                result.outcome = Outcome::Error;
                result.message = test.problem;
                finished_.emplace(next_, std::move(result));
            } else if (test.skip) {
                result.outcome = Outcome::Skipped;
                result.message = *test.skip;
                finished_.emplace(next_, std::move(result));
            } else if (std::string problem = launch(next_); !problem.empty()) {
                result.outcome = Outcome::Error;
                result.message = std::move(problem);
                finished_.emplace(next_, std::move(result));
            }
            ++next_;
        }
    }

    std::string launch(std::size_t number) {
        int fds[kStreams][2] = {{-1, -1}, {-1, -1}, {-1, -1}};
        for (auto& pair : fds)
            if (pipe2(pair, O_CLOEXEC) != 0) {
                const int problem = errno;
                closeAll(fds);
                return fmt::format("cannot start a process for the test: {}", std::strerror(problem));
            }
        std::fflush(stdout);
        std::fflush(stderr);
        Running test;
        test.number = number;
        test.began = Clock::now();
        const double limit = tests_[number].timeout.value_or(options_.timeout);
        test.deadline =
            test.began + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(limit));
        test.pid = fork();
        if (test.pid < 0) {
            const int problem = errno;
            closeAll(fds);
            return fmt::format("cannot start a process for the test: {}", std::strerror(problem));
        }
        if (test.pid == 0) executeTest(tests_[number], body_, fds);
        for (int stream = 0; stream < kStreams; ++stream) {
            close(fds[stream][1]);
            test.fds[stream] = fds[stream][0];
        }
        running_.push_back(std::move(test));
        return {};
    }

    /// Waits for output, the end of a test, or a time limit.
    void wait() {
        std::vector<pollfd> polled;
        std::vector<std::pair<Running*, int>> owners;
        const Clock::time_point now = Clock::now();
        int patience = kMostPollMs;
        for (Running& test : running_) {
            const auto left = std::chrono::ceil<std::chrono::milliseconds>(test.deadline - now).count();
            patience = std::clamp<int>(static_cast<int>(std::min<long>(left, kMostPollMs)), 0, patience);
            for (int stream = 0; stream < kStreams; ++stream) {
                if (test.fds[stream] < 0) continue;
                polled.push_back({test.fds[stream], POLLIN, 0});
                owners.emplace_back(&test, stream);
            }
        }
        if (poll(polled.data(), polled.size(), patience) > 0)
            for (std::size_t i = 0; i < polled.size(); ++i)
                if (polled[i].revents != 0) read(*owners[i].first, owners[i].second);
        for (auto test = running_.begin(); test != running_.end();)
            test = isOver(*test) ? running_.erase(test) : std::next(test);
    }

    static void read(Running& test, int stream) {
        char buffer[65536];
        const ssize_t count = ::read(test.fds[stream], buffer, sizeof buffer);
        if (count < 0 && (errno == EINTR || errno == EAGAIN)) return;
        if (count <= 0) {
            close(test.fds[stream]);
            test.fds[stream] = -1;
            return;
        }
        std::string& bytes = test.bytes[stream];
        const std::size_t room = stream == kResult ? SIZE_MAX : kMostOutput - bytes.size();
        test.wasCut[stream] = test.wasCut[stream] || static_cast<std::size_t>(count) > room;
        bytes.append(buffer, std::min(room, static_cast<std::size_t>(count)));
    }

    bool isOver(Running& test) {
        if (std::all_of(std::begin(test.fds), std::end(test.fds), [](int fd) { return fd < 0; })) {
            int status = 0;
            while (waitpid(test.pid, &status, 0) < 0 && errno == EINTR) {
            }
            finished_.emplace(test.number, resultOf(test, status));
            return true;
        }
        if (Clock::now() < test.deadline) return false;
        if (!test.isTimeout) {
            test.isTimeout = true;
            kill(-test.pid, SIGTERM);
        } else {
            test.isKilled = true;
            kill(-test.pid, SIGKILL);
        }
        test.deadline = Clock::now() + kPatience;
        return false;
    }

    TestResult resultOf(Running& test, int status) {
        const TestCase& which = tests_[test.number];
        TestResult result;
        const bool isWhole = unpack(test.bytes[kResult], result);
        if (!isWhole) {
            result = {};
            result.outcome = Outcome::Error;
            result.spot = {which.file, which.module, which.name, which.line, which.column};
            if (WIFSIGNALED(status))
                result.message =
                    fmt::format("the process of the test was ended by {}", sigdescr_np(WTERMSIG(status)));
            else
                result.message = fmt::format("the process of the test ended with status {} and no result",
                                             WEXITSTATUS(status));
        }
        if (test.isTimeout) {
            result.outcome = Outcome::Timeout;
            result.message = fmt::format("the test has not ended after {:g} s of the wall clock",
                                         which.timeout.value_or(options_.timeout));
        }
        for (const int stream : {kOut, kErr})
            if (test.wasCut[stream])
                test.bytes[stream] += fmt::format("\n(cut off after {} bytes)\n", kMostOutput);
        result.output = std::move(test.bytes[kOut]);
        result.events = std::move(test.bytes[kErr]);
        result.wallTime = std::chrono::duration<double>(Clock::now() - test.began).count();
        return result;
    }

    void deliver() {
        for (auto next = finished_.find(reported_); next != finished_.end();
             next = finished_.find(reported_)) {
            done_(tests_[reported_], next->second);
            finished_.erase(next);
            ++reported_;
        }
    }

    void endAll() {
        for (const Running& test : running_)
            kill(-test.pid, SIGTERM);
        const Clock::time_point limit = Clock::now() + kPatience;
        for (Running& test : running_) {
            int status = 0;
            while (waitpid(test.pid, &status, WNOHANG) == 0) {
                if (Clock::now() > limit) kill(-test.pid, SIGKILL);
                usleep(10'000);
            }
            for (const int fd : test.fds)
                if (fd >= 0) close(fd);
        }
        running_.clear();
    }

    const std::vector<TestCase>& tests_;
    const PoolOptions& options_;
    const TestBody& body_;
    const TestDone& done_;
    std::size_t next_ = 0, reported_ = 0;
    std::list<Running> running_;
    std::map<std::size_t, TestResult> finished_; // and not reported
};

} // namespace

bool runTests(const std::vector<TestCase>& tests, const PoolOptions& options, const TestBody& body,
              const TestDone& done) {
    return Pool(tests, options, body, done).run();
}

} // namespace testing
