#pragma once
// Vertices whose motion is recorded, and the file it is recorded in.

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/scene/body/simulated_body.h"
#include "core/scene/file/scene_file.h"

namespace dartboard {

struct VertexMotion {
  Eigen::Vector3d position, velocity;  // [m], [m/s]
};

/// All probes at a moment; no value for those whose vertex has been removed.
struct ProbeRow {
  double time = 0.0;  // [s]
  std::vector<std::optional<VertexMotion>> probes;
};

/// Let the body track the vertex of each probe.
///
/// pre     nothing has happened to the body since it was built
/// throws  InputError "/output/probes/0/...: ..." for a point that the body does not have
void track_probes(std::span<const Probe> probes, SimulatedBody& body);

/// The heads of the columns, with units, and one row; real numbers with 17 digits. Both end with a line break.
std::string probes_header(std::span<const Probe> probes);
std::string probes_row(const ProbeRow& row);

}  // namespace dartboard
