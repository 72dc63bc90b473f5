#pragma once
// `dartboard validate contact --with ipctk`: are contacts where ipctk finds that surfaces cross, and as deep?

#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/harness/claim.h"
#include "benchmarks/harness/table.h"
#include "benchmarks/report/study_log.h"
#include "core/plain/mesh.h"
#include "validation/contact/ipctk/ipctk_placements.h"
#include "validation/contact/ipctk/ipctk_shots.h"

namespace dartboard {

struct IpctkResults {
  std::vector<IpctkPlacementsFound> placements;  // by pair of bodies
  IpctkShotsFound shots;
};

std::vector<Claim> claims_of(const IpctkResults& results);
/// A row for each pair of bodies; and the figures of the shots.
Table ipctk_table(const IpctkResults& results);
Table ipctk_shots_table(const IpctkShotsFound& shots);

/// Makes answers from questions (validation/contact/ipctk/ipctk_questions.h).
using AskIpctk = std::function<std::string(const std::string& questions)>;
/// throws  IoError where an answer is missing or no number
IpctkPlacementsFound certified(const IpctkPlacements& placements, const AskIpctk& ask);
IpctkShotsFound certified(std::span<const IpctkShot> shots, const AskIpctk& ask);

/// "1.6.1"
/// throws  IoError where `python3` of the PATH does not import ipctk
std::string ipctk_version();
/// The text of the answers that reference/ipctk/certify.py writes; it runs in a folder of its own, of which nothing is
/// left.
/// throws  IoError where it fails
std::string run_ipctk(const std::string& questions);

}  // namespace dartboard
