#pragma once
// `dartboard recommend --audit`: unseen scenes, their recommendations, and what happens when they are followed.

#include <cstdint>

#include "benchmarks/report/report.h"
#include "benchmarks/report/study_log.h"

namespace dartboard {

/// Recommend for scenes and errors drawn from a seed, follow the recommendations, and compare with certified
/// references and with sweeps of all methods.
Report audit_study(std::uint64_t seed, bool quick, StudyLog& log);

}  // namespace dartboard
