#pragma once
// `dartboard recommend --audit --long`: does recommend predict?

#include <cstdint>

#include "benchmarks/report/report.h"
#include "benchmarks/report/study_log.h"

namespace dartboard {

/// Recommend for long motions and errors drawn from a seed, from pilots that take a twentieth of the run at most;
/// follow the recommendations, and compare with codes that share nothing with ours and with sweeps of all methods.
Report foretold_study(std::uint64_t seed, bool quick, StudyLog& log);

}  // namespace dartboard
