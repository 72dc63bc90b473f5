#pragma once
// The expectations of a scene about its end, compared with the result.

#include <optional>
#include <string>
#include <vector>

#include "core/scene/run/scene_run.h"

namespace dartboard {

struct ExpectedRow {
  std::string what, expected, actual;
  bool holds;
};

/// The centre of mass of the component of a vertex; no value for a vertex that has been removed.
std::optional<Eigen::Vector3d> centre_of_part(const SimulatedBody& body, std::uint32_t vertex);

/// One row for each expectation of the scene, in the order of the reference page.
///
/// A mass holds to 12 digits: within 5e-12 of the expected one for the decimals, and 2 n 2^-53 for the two sums of n
/// masses of cells (of a chain, links), each of which rounds n - 1 times by at most 2^-53 of the sum.
std::vector<ExpectedRow> compare_with_expectation(const SceneFile& scene, const Simulation& simulation,
                                                  const RunResult& result);

}  // namespace dartboard
