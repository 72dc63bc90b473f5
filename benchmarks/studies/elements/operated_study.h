#pragma once
// `dartboard validate elements --operations`: do elements keep their energies and forces whatever happens to the map?

#include <string>
#include <utility>
#include <vector>

#include "benchmarks/report/report.h"
#include "benchmarks/report/study_log.h"
#include "core/plain/mesh.h"
#include "validation/elements/operated_elements.h"

namespace dartboard {

struct OperatedPlan {
  std::vector<std::pair<std::string, Mesh>> bodies;
  ElementOperationsPlan each;  // of every body and model
};

struct OperatedBody {
  std::string body;
  std::size_t cells = 0;
  ElementOperations found;
};

std::vector<Claim> claims_of(const std::vector<OperatedBody>& bodies);
Table operations_table(const std::vector<OperatedBody>& bodies);

Report operated_study(const OperatedPlan& plan, StudyLog& log);

}  // namespace dartboard
