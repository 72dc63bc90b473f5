#pragma once
// `dartboard validate conservation`: conserved quantities while a moving body is taken apart.

#include <cstddef>
#include <cstdint>
#include <string>

#include "benchmarks/report/report.h"
#include "benchmarks/report/study_log.h"
#include "core/plain/mesh.h"

namespace dartboard {

struct ConservationStudyPlan {
  Mesh mesh;
  std::string mesh_name;           // as the command line names it
  std::size_t operations = 10000;  // random ones, per body
  std::uint64_t seed = 1;
};

/// The mesh on each storage that holds it, refined where it can be, and generated bodies in addition; stops at the
/// first body on which something is not conserved.
///
/// throws  IoError for a mesh that no body can be built of
Report conservation_study(const ConservationStudyPlan& plan, StudyLog& log);

}  // namespace dartboard
