#pragma once
// The two clocks of every measurement, and the date.

#include <cstdint>
#include <string>

namespace dartboard {

/// Processor time that the calling thread has used [ns]. Time spent waiting for a processor does not count, so a noisy
/// neighbour disturbs it little; neither does the work of other threads, so a threaded task needs the wall clock.
std::int64_t thread_cpu_ns();

/// Processor time that all threads of the process have used [ns].
std::int64_t process_cpu_ns();

/// Wall time on a clock that is never set back [ns].
std::int64_t steady_wall_ns();

/// Now, in universal time: "2026-01-31T12:00:00Z".
std::string utc_time();

}  // namespace dartboard
