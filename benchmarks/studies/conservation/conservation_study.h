#pragma once
// `dartboard validate conservation`: what is kept while a moving body is taken apart.

#include <cstddef>
#include <cstdint>
#include <string>

#include "benchmarks/report/report.h"
#include "benchmarks/report/study_log.h"
#include "core/plain/mesh.h"

namespace dartboard {

struct ConservationStudyPlan {
  Mesh mesh;
  std::string mesh_name;           // as it was given
  std::size_t operations = 10000;  // random ones, per body
  std::uint64_t seed = 1;
};

/// The mesh on each storage that holds it, refined where it can be, and generated bodies beside it; up to the first on
/// which something is not conserved.
///
/// throws  IoError for a mesh that no body can be built of
Report conservation_study(const ConservationStudyPlan& plan, StudyLog& log);

}  // namespace dartboard
