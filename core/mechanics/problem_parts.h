#pragma once
// The parts of a problem whose mesh has volumes, polygons and links: a body can be of cells of one dimension.

#include <cstdint>
#include <vector>

#include "core/plain/problem.h"

namespace dartboard {

/// The volumes, the polygons or the links of a mesh as a problem of their own.
struct ProblemPart {
  Problem problem;
  int dimension = 0;                     // of its cells: 3, 2 or, of links, 1
  std::vector<std::uint32_t> point;      // of the whole mesh, by point; ascending
  std::vector<std::uint32_t> cell;       // of the whole mesh, by cell, ascending; links follow all cells
  std::vector<MaterialNumber> material;  // of the whole problem, by material; empty where that has one
};

/// The parts that have any cells or links, solids first, chains last. A part has the materials of its cells alone, and
/// is homogeneous where that is one. Points of no cell and no link belong to the first.
///
/// throws  InputError for a point of cells of several dimensions
std::vector<ProblemPart> parts_of(const Problem& problem);

}  // namespace dartboard
