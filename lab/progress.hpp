// How long work shows that it lives: a line that rewrites itself on a terminal, a line every few seconds otherwise.
#pragma once

#include <chrono>
#include <string>

namespace proveta {

class Progress {
  public:
    explicit Progress(bool quiet);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Shows a text, unless one was shown only just before.
    void show(const std::string& text);
    /// Ends the line on a terminal, so that a log line can follow.
    void end_line();

    /// "1 min 20 s"
    static std::string duration(double seconds);
    /// How long the rest may take of which a share is done after some seconds, in words; where nothing tells, that and why.
    static std::string left(double seconds, double done);

  private:
    bool quiet_;
    bool terminal_;
    std::size_t shown_ = 0;
    std::chrono::steady_clock::time_point next_;
};

/// Ctrl-C, SIGTERM and a terminal that closes (SIGHUP, unless it is ignored) ask the calculation to end where its state is whole, however
/// many of them come: terminals, schedulers and parents send several.
void catch_interrupts();
bool interrupted();
/// Number of the signal that asked for the end; SIGINT before any has.
int interrupt_signal();

} // namespace proveta
