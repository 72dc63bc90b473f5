#include "validation/statics/newton_matrices.h"

#include <Eigen/Core>
#include <span>
#include <utility>

#include "core/plain/error.h"
#include "validation/statics/linearised.h"
#include "validation/statics/static_problem.h"
#include "validation/statics/static_rest.h"
#include "validation/statics/warped_stiffness.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

NewtonRun run(double traction, std::string_view name, const StaticProblem& problem, const SimulatedBody& body,
              const StaticMatrix& matrix) {
  NewtonRun run{.traction = traction, .matrix = std::string(name)};
  const auto& start = body.vertices().position;
  try {
    const StaticRest rest = static_rest(body.system(), start, forces_on(problem, body),
                                        {.residual = NewtonRun::residual, .most = NewtonRun::most}, matrix);
    run.iterations = rest.iterations;
    std::vector<Vector3d> u(start.size());
    for (std::size_t k = 0; k < u.size(); ++k) u[k] = rest.x[k] - start[k];
    run.bent = largest_displacement(u);
  } catch (const SolverError&) {  // not found is a result, too
  }
  return run;
}

}  // namespace

std::vector<NewtonRun> newton_runs(int across) {
  std::vector<NewtonRun> runs;
  const double far = bends_far(CellKind::tetrahedron, across);
  for (const double traction : {0.5 * far, far}) {
    const StaticProblem problem = loaded_beam(CellKind::tetrahedron, across, traction, true);
    const auto body = body_of(problem, Model::corotational);
    const SpringSystem system = body->system();
    const auto of = [&](Compression compression) -> StaticMatrix {
      return
          [&system, compression](std::span<const Vector3d> x) { return linearised(system, x, compression).stiffness; };
    };
    for (const auto& [name, matrix] :
         {std::pair(NewtonRun::exact, of(Compression::exact)),
          std::pair(NewtonRun::projected, of(Compression::projected)),
          std::pair(NewtonRun::warped, StaticMatrix(WarpedStiffness(system, body->vertices().position)))})
      runs.push_back(run(traction, name, problem, *body, matrix));
  }
  return runs;
}

}  // namespace dartboard
