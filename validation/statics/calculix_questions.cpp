#include "validation/statics/calculix_questions.h"

#include <utility>

#include "validation/statics/calculix_deck.h"
#include "validation/statics/static_problem.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

constexpr double small = 1.0;  // [Pa] bends it by a thousandth of its length

CalculixQuestion of_core(std::string what, CellKind cells, int across, bool large) {
  const StaticProblem problem = loaded_beam(cells, across, large ? bends_far(cells, across) : small, large);
  return {std::move(what), large, calculix_deck(problem), displacements_by_core(problem)};
}

CalculixQuestion of_reference(int across) {
  const StaticProblem problem = loaded_beam(CellKind::tetrahedron, across, small, false);
  const reference::QuadraticSolid solid(problem.mesh, {problem.young, problem.poisson, 1000.0});
  const std::vector<std::uint32_t> held = solid.nodes_where([](const Vector3d& x) { return x[0] < 1e-9; });
  const Eigen::VectorXd force = solid.load([](const Vector3d& x) { return x[0] > 1.0 - 1e-9; },
                                           [](const Vector3d&) { return Vector3d(0.0, 0.6 * small, 0.8 * small); });
  CalculixQuestion question{
      "quadratic tetrahedra (C3D10), small displacements", false, calculix_deck(problem, solid, held, force), {}};
  const Eigen::VectorXd bent = solid.held_at(held).displacements(force);
  for (Eigen::Index k = 0; k < bent.size(); k += 3) question.ours.push_back(bent.segment<3>(k));
  return question;
}

}  // namespace

std::vector<CalculixQuestion> calculix_questions(int across) {
  constexpr CellKind tetrahedra = CellKind::tetrahedron, hexahedra = CellKind::hexahedron;
  return {of_core("tetrahedra (C3D4), small displacements", tetrahedra, across, false),
          of_core("hexahedra (C3D8), small displacements", hexahedra, across, false), of_reference(across / 2),
          of_core("tetrahedra (C3D4), large displacements", tetrahedra, across, true),
          of_core("hexahedra (C3D8), large displacements", hexahedra, across, true)};
}

double apart(const CalculixQuestion& question, std::string_view printed) {
  return displacements_apart(question.ours, calculix_displacements(printed, question.ours.size()));
}

}  // namespace dartboard
