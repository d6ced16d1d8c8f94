#include "runtime/host/stop_signals.h"

#include <csignal>
#include <cstdio>
#include <ctime>
#include <iterator>
#include <string_view>
#include <unistd.h>

namespace rt {
namespace {

constexpr int kStopSignals[] = {SIGINT, SIGTERM, SIGHUP, SIGPIPE};

struct sigaction previous[std::size(kStopSignals)];
volatile std::sig_atomic_t noted = 0;

struct sigaction previousAlarm;
timer_t patienceTimer;
itimerspec patienceTime;
volatile std::sig_atomic_t isPatienceLimited = 0;

void killBy(int signal) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

// Runs at any moment: nothing but what is async-signal-safe.
extern "C" void noteSignal(int signal) {
    if (noted == 0) {
        noted = signal;
        if (isPatienceLimited != 0) timer_settime(patienceTimer, 0, &patienceTime, nullptr);
    } else if (signal != SIGPIPE) // each further write to the closed pipe brings one
        killBy(signal);
}

extern "C" void endWithoutOrder(int /*signal*/) {
    constexpr std::string_view kMessage = "rapidc: ended while work was in progress\n";
    [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, kMessage.data(), kMessage.size());
    _exit(StopSignals::kStatus + noted);
}

void limitPatience(std::chrono::milliseconds patience) {
    struct sigaction action{};
    action.sa_handler = endWithoutOrder;
    sigemptyset(&action.sa_mask);
    sigevent event{};
    event.sigev_notify = SIGEV_SIGNAL;
    event.sigev_signo = SIGALRM;
    if (timer_create(CLOCK_MONOTONIC, &event, &patienceTimer) != 0) return;
    sigaction(SIGALRM, &action, &previousAlarm);
    const auto seconds = std::chrono::floor<std::chrono::seconds>(patience);
    patienceTime = {};
    patienceTime.it_value.tv_sec = seconds.count();
    patienceTime.it_value.tv_nsec = std::chrono::nanoseconds(patience - seconds).count();
    isPatienceLimited = 1;
}

} // namespace

StopSignals::StopSignals(std::chrono::milliseconds patience) {
    noted = 0;
    if (patience.count() > 0) limitPatience(patience);
    struct sigaction action{};
    action.sa_handler = noteSignal;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    for (std::size_t i = 0; i < std::size(kStopSignals); ++i) {
        sigaction(kStopSignals[i], nullptr, &previous[i]);
        if (previous[i].sa_handler != SIG_IGN) sigaction(kStopSignals[i], &action, nullptr);
    }
}

StopSignals::~StopSignals() {
    for (std::size_t i = 0; i < std::size(kStopSignals); ++i)
        sigaction(kStopSignals[i], &previous[i], nullptr);
    if (isPatienceLimited != 0) {
        isPatienceLimited = 0;
        timer_delete(patienceTimer);
        sigaction(SIGALRM, &previousAlarm, nullptr);
    }
    noted = 0;
}

int StopSignals::received() {
    return noted;
}

const char* StopSignals::name(int signal) {
    switch (signal) {
    case SIGINT: return "Ctrl-C (SIGINT)";
    case SIGTERM: return "the signal SIGTERM";
    case SIGHUP: return "the end of the terminal (SIGHUP)";
    case SIGPIPE: return "the end of the program that reads its output (SIGPIPE)";
    default: return "a signal";
    }
}

void StopSignals::endIfReceived() {
    if (noted == 0) return;
    std::fflush(nullptr);
    killBy(noted);
}

} // namespace rt
