// How the program's processes say how they ended, beside 0.
#pragma once

namespace proveta {

/// The user's input, the calculation, the disk.
constexpr int exit_input = 2;
constexpr int exit_calculation = 3;
constexpr int exit_files = 4;
/// The exit code of work that a signal ended early is this and the signal's number, as shells have it: 130 for SIGINT, 143 for SIGTERM, 129
/// for SIGHUP.
constexpr int exit_signal = 128;

} // namespace proveta
