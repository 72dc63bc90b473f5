#pragma once
// The spring system that a problem will become, computed from its mesh alone: what plans calibrate and analyse.

#include <Eigen/Core>
#include <vector>

#include "core/plain/problem.h"
#include "core/scene/plan/mesh_tally.h"
#include "core/time/system/spring_system.h"

namespace dartboard {

/// Columns in the order that the body will have them; their sums over cells may differ from its by rounding.
struct SystemArrays {
  std::vector<SpringEnds> ends;
  Springs springs;
  std::vector<double> mass, inverse_mass, viscosity;  // viscosity: empty without any
  std::vector<std::uint8_t> fixed;                    // empty where nothing is
  Eigen::Vector3d gravity{0, 0, 0};
  std::vector<Eigen::Vector3d> x, v;

  SystemArrays(const Problem& problem, const MeshTally& tally);

  SpringSystem system() const { return {ends, springs, mass, inverse_mass, viscosity, fixed, gravity}; }
  Motion motion() { return {x, v}; }
};

}  // namespace dartboard
