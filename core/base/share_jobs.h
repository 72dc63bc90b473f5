#pragma once
// Work that the threads in use share, job by job.

#include <cstddef>
#include <functional>
#include <span>

namespace dartboard {

/// Calls each job once: on the threads in use (thread_team.h) where so many cells are worth it, otherwise one after the
/// other. Long jobs come first.
///
/// pre     no job changes what another one uses, and none uses the team
/// throws  what a job throws, the first of several
void share_jobs(std::size_t cells, std::span<const std::function<void()>> jobs);

}  // namespace dartboard
