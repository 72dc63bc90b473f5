#pragma once
// Costs of the forces of each model on one mesh, over several processes.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "benchmarks/harness/paired.h"
#include "benchmarks/report/study_log.h"
#include "core/plain/material.h"
#include "core/plain/mesh.h"

namespace dartboard {

struct ModelCost {
  Model model;
  CellKind cells = CellKind::tetrahedron;
  std::size_t pieces = 0;      // springs, or elements
  double ns = 0.0;             // processor time of one evaluation of all forces
  double frequency = 0.0;      // [1/s] the highest
  Figure over_springs{1, {}};  // processor time for the same simulated time

  /// Processor seconds for one simulated second: evaluations at Verlet's limit, 2 over the frequency.
  double per_second() const { return 0.5 * frequency * ns * 1e-9; }
};

/// "neo-hookean hexahedra"
std::string in_words(Model model, CellKind cells);

struct ElementCostPlan {
  int processes = 6, rounds = 40, evaluations = 200;
  int across = 4;  // of the mesh
  int process = 0;
};

/// Time all models interleaved in this process, and report every sample.
void measure_element_costs(const ElementCostPlan& plan, const std::function<void(const Sample&)>& sink);

/// Springs, tetrahedra of each law, and hexahedra, from processes of their own.
///
/// throws  SolverError if repeating an evaluation has left different forces
std::vector<ModelCost> element_costs(const ElementCostPlan& plan, StudyLog& log);

}  // namespace dartboard
