#pragma once

namespace dartboard {

// Exit codes: the run agrees, it disagrees, the command line is wrong, reading or writing failed.
inline constexpr int exit_agrees = 0;
inline constexpr int exit_disagrees = 1;
inline constexpr int exit_usage = 2;
inline constexpr int exit_io = 3;

}  // namespace dartboard
