#include "benchmarks/studies/reproduce/paper_answers.h"

#include <fmt/format.h>

#include "benchmarks/paper/paper_claims.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/topology/build.h"
#include "validation/contact/collisions.h"
#include "validation/contact/contact_scenes.h"
#include "validation/paper/embeddings_held.h"
#include "validation/paper/indexed_structure.h"
#include "validation/paper/maps/connectivity_by_marks.h"
#include "validation/paper/maps/cost_of_coverage.h"
#include "validation/paper/maps/fans_take_apart.h"
#include "validation/paper/maps/free_darts.h"
#include "validation/paper/maps/orbits_come_apart.h"
#include "validation/paper/maps/table_of_darts.h"
#include "validation/paper/other_cells.h"
#include "validation/paper/pinched_vertex.h"
#include "validation/paper/removals_share.h"
#include "validation/paper/shares_after_cuts.h"

namespace dartboard {
namespace {

constexpr std::uint64_t seed = 1;

/// Fig. 6 and 7 show a surface, the text describes a solid.
ClaimAnswer orbits_of_both(const Problem& problem) {
  const ClaimAnswer solid = try_orbits(build_map<Map3>(problem.mesh).map, 200, seed);
  const ClaimAnswer surface = try_orbits(build_map<Map2>(triangle_sheet(12, 12, 1.0)).map, 200, seed);
  return {solid.holds && surface.holds, fmt::format("solid: {}; surface: {}", solid.measured, surface.measured)};
}

std::vector<Mesh> bodies_of_all_sizes(const Mesh& paper) {
  std::vector<Mesh> bodies{paper};
  for (int layers = 1; layers <= 6; ++layers) bodies.push_back(tetrahedron_ball(layers, 0.1));
  return bodies;
}

}  // namespace

Claim tried_out(PaperClaimId id, const ClaimAnswer& tried, std::string where) {
  const bool is_met = tried.holds != is_impossibility(id);
  return answered(id, met(is_met), tried.measured, std::move(where));
}

std::vector<Claim> answer_by_trials(const Problem& problem) {
  const SharesAfterCuts shares = try_dissociations(problem, 1000, seed);
  const FanAnswers fans = try_fans(problem.mesh);
  const RemovalAnswers removals = try_removals(problem, 200, seed);
  const std::string exact = "masses in exact rationals, cells by mesh point";
  return {
      tried_out(
          "quasi-manifold", try_pinched_vertex(kuhn_box(2, 2, 2, 0.1), pinched_body(3)),
          "27 points in a box and a drum of 6 tetrahedra; links counted in the mesh, motion in extended precision"),
      tried_out("dart-table", is_fig_5(map_of_fig_5()), "Fig. 5; exact"),
      tried_out("free-boundary", try_free_darts(problem.mesh),
                "the paper's body, a sphere, a torus; sides of the mesh"),
      tried_out("held-either-way", try_both_ways_to_hold(problem, 5), "the paper's body, coverage and lists; exact"),
      tried_out("orbits-separate", orbits_of_both(problem),
                "the paper's body and a sheet; union-find over plain alphas"),
      tried_out("removal-shares", removals.shares, "the paper's body; " + exact),
      tried_out("removal-frees", removals.free_faces, "the paper's body; sides of the cells left"),
      tried_out("other-cells", try_other_cells(mixed_box(4, 3, 4, 0.05), 200, seed), "a box of all kinds; " + exact),
      tried_out("mass-split", shares.mass, "the paper's body; " + exact),
      tried_out("stiffness-split", shares.stiffness, "the paper's body; k times the cells around each part"),
      tried_out("viscosity-split", shares.viscosity, "the paper's body; " + exact),
      tried_out("rest-shape", shares.rest_shape, "the paper's body, sheared and stretched; " + exact),
      tried_out("state-duplicated", shares.state, "the paper's body, sheared and in motion; exact"),
      tried_out("one-face-seldom", fans.one_face, "every inner face of the uncut body; <= 10 %, cells by mesh point"),
      tried_out("fan-separates", fans.whole_fan, "every inner face and corner of the uncut body; cells by mesh point"),
      tried_out("fan-ends", fans.ends, "the same fans; section 5.1 by its letter on plain alphas"),
      tried_out("collisions", try_collision(scene_of_collision(), 20),
                "two boxes that run into each other; overlaps of cells by CGAL"),
      tried_out("coverage-darts", try_coverages(bodies_of_all_sizes(problem.mesh)),
                "balls and the paper's body; look-ups of alphas counted, within 1 %"),
      tried_out("sews-translated", translate_operations(problem, 200, seed),
                "the paper's body; arrays against the cells left, after each operation"),
      tried_out("connectivity-marks", try_marking(problem.mesh, 2, seed), "the paper's body; cells joined by sides"),
      tried_out("parts-collide", try_collision(scene_of_cut(), 20),
                "a box cut in two while it runs together; overlaps of cells by CGAL"),
  };
}

}  // namespace dartboard
