#include "runtime/host/stop_signals.h"

#include <csignal>
#include <cstdio>
#include <iterator>

namespace rt {
namespace {

constexpr int kStopSignals[] = {SIGINT, SIGTERM, SIGHUP, SIGPIPE};

struct sigaction previous[std::size(kStopSignals)];
volatile std::sig_atomic_t noted = 0;

void killBy(int signal) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

// Runs at any moment: nothing but what is async-signal-safe.
extern "C" void noteSignal(int signal) {
    if (noted == 0)
        noted = signal;
    else if (signal != SIGPIPE) // each further write to the closed pipe brings one
        killBy(signal);
}

} // namespace

StopSignals::StopSignals() {
    noted = 0;
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
