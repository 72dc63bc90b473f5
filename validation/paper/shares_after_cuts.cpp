#include "validation/paper/shares_after_cuts.h"

#include <fmt/format.h>

#include "core/operations/dissociate_face.h"
#include "validation/conservation/conserved_sums.h"
#include "validation/paper/worst_share.h"

namespace dartboard {
namespace {

using Numbers = std::vector<std::uint32_t>;

Numbers copy(std::span<const std::uint32_t> numbers) { return {numbers.begin(), numbers.end()}; }

/// One of the cells that are about to part, its corner or edge, and the number of that in the other cell.
struct Place {
  std::uint32_t here, there;
  Numbers whole;  // before: all corners or edges that are one with it
  double mass = 0.0, stiffness = 0.0, damping = 0.0;
  Eigen::Vector3d position{0, 0, 0}, velocity{0, 0, 0};
};

/// The volume of the first cell in the present shape, over that at rest.
double stretch(const CutSubject& s) {
  Mesh now = s.start->mesh;
  for (std::size_t k = 0; k < s.body.vertices.size(); ++k)
    now.points[s.body.vertices.point[k]] = s.body.vertices.position[k];
  return reference::exact_measure(now, 0) / reference::exact_measure(s.start->mesh, 0);
}

}  // namespace

SharesAfterCuts try_dissociations(const Problem& problem, int dissociations, std::uint64_t seed, const Adapt& follow) {
  CutSubject s(problem);
  s.deform();
  const double stretched = stretch(s);
  SplitMix64 random(seed);
  const Material& material = problem.material;

  WorstShare mass_sum, mass_of_part, stiffness_sum, viscosity;
  bool stiffness_counted = true, state_kept = true, own_embeddings = true;
  int done = 0, vertices_apart = 0, edges_apart = 0;
  for (; done < dissociations; ++done) {
    const auto side = s.cells.joined_side(random);
    if (!side) break;
    const std::uint32_t other = s.cell_of_side(s.cells.opposite(*side));
    std::vector<Place> vertices, edges;
    for (const std::uint32_t k : s.corners_of(*side)) {
      const std::uint32_t v = s.vertex(k);
      vertices.push_back({k, s.cells.same_corner(k, other), copy(s.cells.vertex(k))});
      vertices.back().mass = s.body.vertices.mass[v];
      vertices.back().position = s.body.vertices.position[v];
      vertices.back().velocity = s.body.vertices.velocity[v];
    }
    for (const std::uint32_t k : s.edges_of(*side)) {
      const Spring spring = s.body.springs[s.edge(k)];
      edges.push_back({k, s.cells.same_edge(k, other), copy(s.cells.edge(k)), 0.0, spring.stiffness, spring.damping});
    }

    follow(s.body, dissociate_face(s.body.map, s.places.side[*side]));
    s.cells.dissociate(*side);

    for (const Place& p : vertices) {
      const Numbers here = copy(s.cells.vertex(p.here)), there = copy(s.cells.vertex(p.there));
      const bool apart = std::ranges::find(here, p.there) == here.end();
      const std::uint32_t v = s.vertex(p.here), w = s.vertex(p.there);
      const VertexColumns& columns = s.body.vertices;
      own_embeddings = own_embeddings && (v != w) == apart;
      vertices_apart += apart ? 1 : 0;
      // n shares, summed in one piece before and in two after
      if (apart) mass_sum.compare(columns.mass[v] + columns.mass[w], p.mass, gamma(2 * p.whole.size()) * p.mass);
      for (const auto& [number, corners] : {std::pair(v, &here), std::pair(w, &there)}) {
        const auto [exact, bound] = s.mass_of(*corners);
        mass_of_part.compare(columns.mass[number], exact, bound);
        viscosity.compare(columns.viscosity[number], material.viscosity * exact,
                          material.viscosity * (bound + gamma(2) * exact));
        state_kept = state_kept && columns.position[number] == p.position && columns.velocity[number] == p.velocity;
      }
    }
    for (const Place& p : edges) {
      const Numbers here = copy(s.cells.edge(p.here)), there = copy(s.cells.edge(p.there));
      const bool apart = std::ranges::find(here, p.there) == here.end();
      const std::uint32_t e = s.edge(p.here), f = s.edge(p.there);
      own_embeddings = own_embeddings && (e != f) == apart;
      edges_apart += apart ? 1 : 0;
      // a whole number times k is rounded once
      const auto counted = [&](std::uint32_t number, const Numbers& around) {
        const double n = static_cast<double>(around.size());
        return s.body.springs[number].stiffness == n * material.stiffness &&
               s.body.springs[number].damping == n * material.damping;
      };
      stiffness_counted = stiffness_counted && counted(e, here) && counted(f, there);
      if (!apart) continue;
      const double sum = s.body.springs[e].stiffness + s.body.springs[f].stiffness;
      stiffness_sum.compare(sum, p.stiffness, gamma(3) * p.stiffness);
      stiffness_sum.compare(s.body.springs[e].damping + s.body.springs[f].damping, p.damping, gamma(3) * p.damping);
    }
  }

  const bool some = vertices_apart > 0 && edges_apart > 0;
  const auto apart = [&](int count, const char* what) { return fmt::format("{} {} came apart", count, what); };
  SharesAfterCuts answers;
  answers.mass = {
      some && mass_sum.within() && mass_of_part.within(),
      fmt::format("{} in {} dissociations; m1 + m2 off by {:.2g} of the rounding bound, m1 and m2 by {:.2g}",
                  apart(vertices_apart, "vertices"), done, mass_sum.share(), mass_of_part.share())};
  answers.stiffness = {
      some && stiffness_sum.within() && stiffness_counted,
      fmt::format("{}; k1 + k2 off by {:.2g} of the rounding bound, k1 and k2 {} of their cells",
                  apart(edges_apart, "edges"), stiffness_sum.share(), stiffness_counted ? "those" : "NOT those")};
  answers.viscosity = {some && viscosity.within(), fmt::format("{}; off by {:.2g} of the rounding bound",
                                                               apart(vertices_apart, "vertices"), viscosity.share())};
  answers.rest_shape = {some && mass_of_part.within() && std::abs(stretched - 1.0) > 0.01,
                        fmt::format("a body of {:.3g} times its volume: masses of parts off by {:.2g} of the rounding "
                                    "bound",
                                    stretched, mass_of_part.share())};
  answers.state = {some && state_kept && own_embeddings,
                   fmt::format("{}, {}: states {}, embeddings {}", apart(vertices_apart, "vertices"),
                               apart(edges_apart, "edges"), state_kept ? "duplicated" : "NOT duplicated",
                               own_embeddings ? "apart where the cells are" : "NOT apart where the cells are")};
  return answers;
}

}  // namespace dartboard
