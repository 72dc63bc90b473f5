#pragma once
// Materials by region of a mesh, for bodies that are operated on; and their springs by the references.

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/elements/attachments.h"
#include "core/plain/problem.h"
#include "reference/rebuild.h"

namespace dartboard {

/// The materials of a body: one, or two by the side of the plane across x through the middle of the mesh.
struct RegionMix {
  std::string name;
  std::vector<Material> materials;
  bool is_attached = false;  // points on one side to cells on the other
};

/// A body of one model of elements.
RegionMix uniform(Model model);
/// The models of elements alone, then mixes: stiffness, springs, laws, springs and elements, these with attachments.
std::vector<RegionMix> region_mixes();

Problem problem_of(const Mesh& mesh, const RegionMix& mix);

/// Attachments of the points on one side to cells on the other that are drawn at random, so stiff that their energy is
/// of the size of that of a strain of a tenth; empty if the mix has none.
std::vector<Attachment> attachments_of(const Problem& problem, const RegionMix& mix);

/// The springs of the cells that have any, by the references; where two materials meet, an edge has one of each.
std::vector<reference::Spring> springs_of(const Mesh& mesh, const CellMaterials& materials);
/// [J] With the points of the mesh at x.
long double energy_of(std::span<const reference::Spring> springs, std::span<const Eigen::Vector3d> x);

}  // namespace dartboard
