#include "lab/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdio>

namespace proveta {

namespace {

volatile std::sig_atomic_t interrupt_count = 0;
volatile std::sig_atomic_t first_signal = SIGINT;

extern "C" void on_interrupt(int signal) {
    if (interrupt_count == 0) {
        first_signal = signal;
    }
    interrupt_count = interrupt_count + 1; // more of them say nothing new: what was measured is being written down
}

} // namespace

void catch_interrupts() {
    std::signal(SIGINT, on_interrupt);
    std::signal(SIGTERM, on_interrupt);
    if (std::signal(SIGHUP, on_interrupt) == SIG_IGN) { // as nohup leaves it
        std::signal(SIGHUP, SIG_IGN);
    }
}

bool interrupted() { return interrupt_count > 0; }

int interrupt_signal() { return first_signal; }

Progress::Progress(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0), next_(std::chrono::steady_clock::now()) {}

Progress::~Progress() { end_line(); }

void Progress::show(const std::string& text) {
    const auto now = std::chrono::steady_clock::now();
    if (quiet_ || now < next_) {
        return;
    }
    next_ = now + std::chrono::milliseconds(terminal_ ? 200 : 5000);
    if (terminal_) {
        const std::string pad(shown_ > text.size() ? shown_ - text.size() : 0, ' ');
        std::fprintf(stderr, "\r%s%s", text.c_str(), pad.c_str());
        shown_ = text.size();
    } else {
        std::fprintf(stderr, "%s\n", text.c_str());
    }
    std::fflush(stderr);
}

void Progress::end_line() {
    if (terminal_ && shown_ > 0) {
        std::fprintf(stderr, "\n");
        shown_ = 0;
    }
}

std::string Progress::left(double seconds, double done) {
    constexpr double least = 1e-5; // below, a guess of the rest is none
    return done >= least ? "at most " + duration(seconds * (1.0 / done - 1.0)) + " left" : "time left unknown: next to nothing is done yet";
}

std::string Progress::duration(double seconds) {
    if (!(seconds < 1e7)) {
        return "more than 100 days";
    }
    const auto s = std::lround(seconds);
    if (s < 60) {
        return fmt::format("{} s", s);
    }
    return s < 3600 ? fmt::format("{} min {} s", s / 60, s % 60) : fmt::format("{} h {} min", s / 3600, s % 3600 / 60);
}

} // namespace proveta
