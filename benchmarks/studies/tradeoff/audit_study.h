#pragma once
// `dartboard recommend --audit [--long]`: unseen scenes, their recommendations, and the outcome of following
// them.

#include <cstdint>
#include <filesystem>
#include <vector>

#include "benchmarks/report/report.h"
#include "benchmarks/report/study_log.h"
#include "benchmarks/studies/tradeoff/audit_plan.h"

namespace dartboard {

/// Recommend for scenes and errors drawn from a seed, and for those of the gallery, follow the recommendations, and
/// compare with references and with sweeps of all methods. For long motions pilots may take a twentieth of the run at
/// most, and the references are codes that share nothing with ours.
Report audit_study(AuditKind kind, std::uint64_t seed, bool quick, const std::vector<std::filesystem::path>& gallery,
                   StudyLog& log);

}  // namespace dartboard
