#include "validation/contenders/contenders.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/mechanics/mass_spring_body.h"
#include "core/plain/error.h"
#include "core/time/integrators.h"
#include "core/time/system/accelerations.h"
#include "core/topology/storage/hash.h"
#include "core/views/spring_ends.h"
#include "core/walks/cell_arrays.h"
#include "core/walks/dart_coverage.h"
#include "core/walks/embedding_lists.h"
#include "core/walks/runge_kutta_4.h"
#include "reference/adjacency_graph.h"
#include "reference/cgal/cgal_body.h"

namespace dartboard {
namespace {

/// A body of the core and one way to walk it.
template <class Map, Held held, class Walk>
class CoreContender : public ContenderBody {
 public:
  explicit CoreContender(const Problem& problem) : body_(build_body<Map, held>(problem)), h_(problem.h) {
    if constexpr (requires { walk_.rebuild(body_); }) walk_.rebuild(body_);
  }
  void step(int n) override {
    for (int k = 0; k < n; ++k) integrator_.step(walk_, body_, h_);
  }
  PointState state() const override { return body_.state(); }
  void set_state(const PointState& state) override { body_.set_state(state); }
  std::vector<Eigen::Vector3d> forces() override {
    VertexColumns& v = body_.vertices;
    add_spring_forces(walk_, body_);
    std::vector<Eigen::Vector3d> f(v.size());
    for (std::size_t k = 0; k < v.size(); ++k) {
      f[v.point[k]] = v.force[k] - v.viscosity[k] * v.velocity[k];
      v.force[k].setZero();
    }
    return f;
  }

 private:
  MassSpringBody<Map, held> body_;
  Walk walk_;
  RungeKutta4 integrator_;
  double h_;
};

/// A body of the core whose columns are stepped as those of a scene are: by an integrator of core/time, over views.
class ColumnsContender : public ContenderBody {
 public:
  explicit ColumnsContender(const Problem& problem)
      : body_(build_body<Map3, Held::by_every_dart>(problem)), integrator_(make_integrator("rk4")), h_(problem.h) {
    ends_.rebuild(body_);
  }
  void step(int n) override {
    for (int k = 0; k < n; ++k) integrator_->step(system(), {body_.vertices.position, body_.vertices.velocity}, h_);
  }
  PointState state() const override { return body_.state(); }
  void set_state(const PointState& state) override { body_.set_state(state); }
  std::vector<Eigen::Vector3d> forces() override {
    const VertexColumns& v = body_.vertices;
    return spring_and_drag_forces(system(), v.position, v.velocity, v.point);
  }

 private:
  SpringSystem system() const {
    const VertexColumns& v = body_.vertices;
    return {.ends = ends_.ends,
            .springs = body_.springs,
            .mass = v.mass,
            .inverse_mass = v.inverse_mass,
            .viscosity = v.viscosity,
            .fixed = v.fixed,
            .gravity = body_.surroundings.gravity};
  }

  MassSpringBody<Map3, Held::by_every_dart> body_;
  SpringEndsView ends_;
  std::unique_ptr<Integrator> integrator_;
  double h_;
};

/// A witness from reference/, which has the same interface in its own class.
template <class Body>
class ReferenceContender : public ContenderBody {
 public:
  template <class... Arguments>
  explicit ReferenceContender(const Arguments&... arguments) : body_(arguments...) {}
  void step(int n) override { body_.step(n); }
  PointState state() const override { return body_.state(); }
  void set_state(const PointState& state) override { body_.set_state(state); }
  std::vector<Eigen::Vector3d> forces() override { return body_.spring_and_drag_forces(); }

 private:
  Body body_;
};

template <class Map, Held held, class Walk>
std::unique_ptr<ContenderBody> core(const Problem& problem) {
  return std::make_unique<CoreContender<Map, held, Walk>>(problem);
}

std::unique_ptr<ContenderBody> graph(const Problem& problem) {
  return std::make_unique<ReferenceContender<reference::AdjacencyGraph>>(problem);
}

template <reference::CgalWalk walk>
std::unique_ptr<ContenderBody> cgal(const Problem& problem) {
  return std::make_unique<ReferenceContender<reference::CgalBody>>(problem, walk);
}

}  // namespace

std::span<const Contender> contenders() {
  constexpr auto one = Held::by_one_dart;
  constexpr auto every = Held::by_every_dart;
  static const std::array<Contender, 9> table{{
      {"coverage", "full dart coverage with marks; one dart of the orbit holds the embedding", "4.2, 5.1", 12.0,
       Carrier::core_map, core<Map3, one, DartCoverage>},
      {"coverage-every", "the same; every dart holds the embedding", "4.2, 5.1", 12.0, Carrier::core_map,
       core<Map3, every, DartCoverage>},
      {"lists", "lists of embeddings; one dart holds", "5.2", 8.0, Carrier::core_map, core<Map3, one, EmbeddingLists>},
      {"lists-every", "the same; every dart holds", "5.2", 8.0, Carrier::core_map, core<Map3, every, EmbeddingLists>},
      {"arrays", "cell arrays Cell{dart, embedding}", "5.2", 2.0, Carrier::core_map, core<Map3, every, CellArrays>},
      {"columns", "the columns of a scene, four springs at a time where the processor has AVX2", "", 0.0,
       Carrier::core_map, [](const Problem& problem) { return std::make_unique<ColumnsContender>(problem); }},
      {"graph", "indexed adjacency graph, the baseline", "5.1", 2.0, Carrier::adjacency_graph, graph},
      {"cgal-coverage", "CGAL linear cell complex, one_dart_per_cell", "", 0.0, Carrier::cgal_map,
       cgal<reference::CgalWalk::coverage>},
      {"cgal-attributes", "CGAL linear cell complex, attribute ranges", "", 0.0, Carrier::cgal_map,
       cgal<reference::CgalWalk::attributes>},
  }};
  return table;
}

std::vector<Eigen::Vector3d> spring_and_drag_forces(SpringSystem system, std::span<const Eigen::Vector3d> x,
                                                    std::span<const Eigen::Vector3d> v,
                                                    std::span<const std::uint32_t> point) {
  // the accelerations of vertices of 1 kg, none of them fixed, without gravity
  const std::vector<double> ones(x.size(), 1.0);
  system.mass = system.inverse_mass = ones;
  system.gravity.setZero();
  Terms terms = terms_of(system);
  terms.fixed = false;
  std::vector<Eigen::Vector3d> of_vertices(x.size()), f(x.size());
  accelerations(system, terms, x, v, of_vertices);
  for (std::size_t k = 0; k < x.size(); ++k) f[point[k]] = of_vertices[k];
  return f;
}

const Contender& contender(std::string_view id) {
  const auto all = contenders();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Contender& c) { return c.id == id; });
  if (found != all.end()) return *found;
  std::string known;
  for (const Contender& c : all) known += (known.empty() ? "" : ", ") + c.id;
  throw InputError(fmt::format("no contender is called '{}'; there are {}", id, known));
}

std::uint64_t state_hash(const PointState& state) {
  Hash h;
  h.add(state.x);
  h.add(state.v);
  return h.value();
}

}  // namespace dartboard
