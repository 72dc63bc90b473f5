#include "validation/contact/pressed_operations.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "core/contact/contacts.h"
#include "core/elements/tetrahedra.h"
#include "core/mechanics/adapt.h"
#include "core/mechanics/cell_nodes.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/operations/dissociate_face.h"
#include "core/operations/remove_volume.h"
#include "core/operations/tear_fan.h"
#include "core/plain/nan_maximum.h"
#include "core/plain/random.h"
#include "core/scene/run/scene_contact.h"
#include "core/time/integrators.h"
#include "core/time/system/energy.h"
#include "core/topology/check.h"
#include "core/views/element_nodes_view.h"
#include "core/views/skin.h"
#include "core/views/skin_solids_view.h"
#include "reference/elements/cell_energy.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

constexpr double cube_edge = 0.05;             // [m]
constexpr double time_step = 1e-4;             // [s]; h omega is 0.1 to 0.2
constexpr std::size_t settling = 600;          // steps before the first operation, in which the boxes meet
constexpr std::size_t between = 4;             // steps from an operation to the next
constexpr double lid_speed = 0.02;             // [m/s]
constexpr double gap = 0.0002;                 // [m] between the boxes at first
constexpr int cubes_high = 2, cubes_wide = 3;  // cubes of six cells

/// Three boxes with cells of all shapes, each a little aside of the one below. `first_cell`: of each.
Mesh stack_of_boxes(std::uint64_t seed, std::vector<std::size_t>& first_cell) {
  Mesh all;
  SplitMix64 random(seed);
  for (int k = 0; k < 3; ++k) {
    Mesh box = kuhn_box(cubes_wide, cubes_wide, cubes_high, cube_edge, 0.1, seed * 3 + static_cast<std::uint64_t>(k));
    const Vector3d aside(0.004 * random.next_signed(), 0.004 * random.next_signed(),
                         gap + k * (cubes_high * cube_edge + 2.0 * gap));
    for (Vector3d& x : box.points) x += aside;
    first_cell.push_back(all.cell_count());
    append(all, box);
  }
  return all;
}

/// The sums over a stack, and the sums of the sizes of their terms.
struct Sums {
  double kinetic = 0.0, elastic = 0.0, gravitational = 0.0, contact = 0.0;
  Vector3d momentum{0, 0, 0}, angular{0, 0, 0};
  double momentum_size = 0.0, angular_size = 0.0;

  double energy() const { return kinetic + elastic + gravitational + contact; }
};

/// The energy of a contact, and the vertices on which it depends.
struct ContactPart {
  std::array<std::uint32_t, 4> sample{};
  std::array<std::uint32_t, 8> nodes{};
  std::size_t count = 0;
  double energy = 0.0;

  void add(std::span<const std::uint32_t> some) {
    for (const std::uint32_t k : some) nodes[count++] = k;
  }
};

class PressedStack {
 public:
  using Body = MassSpringBody<TetMap, Held::by_every_dart>;

  PressedStack(std::uint64_t seed, const PressedOperationsPlan& plan, PressedOperations& found)
      : plan_(plan),
        found_(found),
        random_(seed),
        law_{.pressure = 200'000.0, .depth = 0.01, .restitution = 0.5, .friction = 0.4} {
    problem_.mesh = stack_of_boxes(seed, first_cell_);
    problem_.material = {.density = 1000.0,
                         .stiffness = 0.0,
                         .damping = 0.0,
                         .viscosity = 0.0,
                         .young = 2e5,
                         .poisson = 0.3,
                         .model = Model::neo_hookean};
    body_ = build_body<TetMap, Held::by_every_dart>(problem_);
    body_.vertices.keep_rest();
    for (std::uint32_t c = 0; c < problem_.mesh.cell_count(); ++c) mesh_cell_.push_back(c);
    nodes_.rebuild(body_);
    skin_.rebuild(body_);
    solids_.rebuild(body_);
    tetrahedra_ = make_tetrahedra(body_.cell_materials(),
                                  {nodes_.nodes, std::get<std::vector<RestShape>>(body_.elements), body_.cell_mass});
    ContactLaw smooth = law_;
    smooth.friction = 0.0;  // so that nothing acts on the stack sideways
    const double height = 3.0 * (cubes_high * cube_edge + 2.0 * gap);
    obstacles_ = std::make_unique<ObstacleContact>(
        std::vector<ContactLaw>{smooth, smooth},
        std::vector<Obstacle>{{.shape = HalfSpace{{0, 0, 0}, {0, 0, 1}}},
                              {.shape = HalfSpace{{0, 0, height}, {0, 0, -1}}, .velocity = {0, 0, -lid_speed}}},
        skin_.samples());
    ContactLaw weak = law_;
    weak.pressure *= plan.strength;
    std::vector<ContactPair> pairs;
    for (std::uint32_t a = 0; a < first_cell_.size(); ++a)
      for (std::uint32_t b = a; b < first_cell_.size(); ++b) pairs.push_back({a, b, weak});
    bodies_ = std::make_unique<BodyContact>(skin_.samples(), solids_.solids(), pairs);
    contact_ = std::make_unique<SceneContact>(Contacts(obstacles_.get(), bodies_.get()), false);
    terms_ = {tetrahedra_.get(), obstacles_.get(), bodies_.get()};
    whole_ = body_.cell_dart.size();
    altitude_ = bodies_->least_altitude(body_.vertices.position);
    contact_->system_changed(system(), body_.vertices.position);
    ++found_.stacks;
    now_ = sums();
    most_energy_ = energy_above_floor(now_);
  }

  PressedStack(const PressedStack&) = delete;
  PressedStack& operator=(const PressedStack&) = delete;

  bool is_used_up() const { return 10 * body_.cell_dart.size() < 9 * whole_; }

  /// Some steps; false if one fails.
  bool move(std::size_t count) {
    const Sums before = now_;
    const ContactLosses lost = contact_->losses();
    for (std::size_t k = 0; k < count; ++k, ++steps_, ++found_.steps) {
      const double time = static_cast<double>(steps_) * time_step;
      const Motion motion{body_.vertices.position, body_.vertices.velocity};
      if (!contact_->step(*verlet_, system(), motion, time, time_step).ok()) return false;
    }
    now_ = sums();
    account_for_steps(before, lost, count);
    return true;
  }

  void operate() {
    const std::vector<ContactPart> contacts = contact_parts();
    const Sums before = now_;
    const std::uint32_t what = random_.below(8);
    TopologyChange change;
    if (what < 7) change = separate_something(what == 6);
    if (change.empty()) {
      remove(before);
      return;
    }
    ++(what < 6 ? found_.dissociated : found_.torn);
    const ChangedEmbeddings changed = follow(change);
    now_ = sums();
    compare_sums(before, Sums{});
    // What contact has at vertices that have not changed is there still, and no contact is across the cut.
    std::vector<std::uint8_t> has_changed(body_.vertices.size(), 0);
    for (const std::uint32_t k : changed.vertices) has_changed[k] = 1;
    for (const std::uint32_t f : changed.faces)
      for (const Dart d : detail::around_face(body_.map, body_.face_dart[f]))
        has_changed[body_.vertex(body_.map, d)] = 1;
    const std::vector<ContactPart> after = contact_parts();
    std::set<std::array<std::uint32_t, 4>> affected;
    for (const auto* parts : {&contacts, &after})
      for (const ContactPart& part : *parts)
        if (std::any_of(part.nodes.begin(), part.nodes.begin() + static_cast<std::ptrdiff_t>(part.count),
                        [&has_changed](std::uint32_t k) { return has_changed[k] != 0; }))
          affected.insert(part.sample);
    double kept = 0.0;
    for (const ContactPart& part : after) kept += affected.contains(part.sample) ? 0.0 : part.energy;
    for (const ContactPart& part : contacts) kept -= affected.contains(part.sample) ? 0.0 : part.energy;
    if (before.contact > 0.0) found_.contact = max_or_nan(found_.contact, std::abs(kept) / before.contact);
    if (now_.contact > 0.0) found_.across = max_or_nan(found_.across, energy_across_cuts() / now_.contact);
  }

  void look() {
    ++found_.looks;
    const std::vector<Vector3d>& x = body_.vertices.position;
    const auto touching = bodies_->touching({x});
    const std::size_t contacts = touching.size(), lost = bodies_->out_of_reach().size();
    found_.contacts = std::max(found_.contacts, contacts);
    found_.out_of_reach += lost;
    std::vector<BodyTouch> lost_by_force;
    const std::vector<BodyTouch> by_force = bodies_->touching_by_brute_force({x}, &lost_by_force);
    const bool agree = std::ranges::equal(bodies_->touching({x}), by_force,
                                          [](const BodyTouch& a, const BodyTouch& b) {
                                            return a.sample == b.sample && a.tetrahedron == b.tetrahedron &&
                                                   a.triangle == b.triangle && a.depth == b.depth;
                                          }) &&
                       lost == lost_by_force.size();
    found_.invalid += !agree || !check(body_.map).empty();

    std::vector<CellCorners> cells(nodes_.nodes.begin(), nodes_.nodes.end());
    std::set<std::pair<std::uint32_t, std::uint32_t>> judged;
    for (const JudgedOverlap& one : judged_overlaps(*bodies_, x, cells, [](auto, auto) { return true; })) {
      judged.insert({one.overlap.first, one.overlap.second});
      found_.by_depth.add(one.overlap.depth / altitude_, one.felt);
    }
    for (const reference::Overlap& one : reference::overlaps(x, cells))
      if (!judged.contains({one.first, one.second})) found_.of_neighbours.add(one.depth / altitude_, true);
  }

 private:
  Dart some_dart() {
    for (;;)
      if (const Dart d{random_.below(body_.map.capacity())}; body_.map.is_live(d)) return d;
  }

  /// A change with an effect, or none where hardly a face is left to dissociate.
  TopologyChange separate_something(bool tears) {
    for (int tries = 0; tries < 1000; ++tries) {
      const Dart d = some_dart();
      if (TopologyChange change = tears ? tear_fan(body_.map, d) : dissociate_face(body_.map, d); !change.empty())
        return change;
    }
    return {};
  }

  SpringSystem system_of_terms(ForceTerms terms) const {
    SpringSystem all;
    all.mass = body_.vertices.mass;
    all.inverse_mass = body_.vertices.inverse_mass;
    all.gravity = problem_.surroundings.gravity;
    all.terms = terms;
    return all;
  }
  SpringSystem system() const { return system_of_terms(terms_); }

  Sums sums() const {
    const VertexColumns& v = body_.vertices;
    const SpringSystem elastic = system_of_terms(ForceTerms(terms_).first(1));
    Sums s;
    s.kinetic = kinetic_energy(elastic, v.velocity);
    s.elastic = elastic_energy(elastic, v.position);
    s.gravitational = gravity_energy(elastic, v.position);
    s.contact = obstacles_->energy(v.position) + bodies_->energy(v.position);
    s.momentum = linear_momentum(elastic, v.velocity);
    s.angular = angular_momentum(elastic, v.position, v.velocity);
    for (std::size_t k = 0; k < v.size(); ++k) {
      s.momentum_size += v.mass[k] * v.velocity[k].norm();
      s.angular_size += v.mass[k] * v.velocity[k].norm() * v.position[k].norm();
    }
    return s;
  }

  /// What deforms, moves or touches: the energy that an error of a step can be a part of.
  static double energy_above_floor(const Sums& s) { return s.kinetic + s.elastic + s.contact; }

  void account_for_steps(const Sums& before, const ContactLosses& lost, std::size_t count) {
    const ContactLosses& losses = contact_->losses();
    unaccounted_ += (now_.energy() - before.energy()) + (losses.damped - lost.damped) + (losses.rubbed - lost.rubbed) -
                    (losses.supplied - lost.supplied);
    most_energy_ = std::max(most_energy_, energy_above_floor(now_));
    found_.energy = max_or_nan(found_.energy, std::abs(unaccounted_) / most_energy_);

    // In each step forces are added twice, and each addition is rounded; a term pushes both ways with the same numbers.
    const VertexColumns& v = body_.vertices;
    std::vector<double> force(v.size(), 0.0);
    for (const ForceTerm* term : terms_) {
      std::vector<Vector3d> of_term(v.size(), Vector3d::Zero());
      term->add_forces({v.position}, of_term);
      for (std::size_t k = 0; k < v.size(); ++k) force[k] += of_term[k].norm();
    }
    double momentum = now_.momentum_size, angular = now_.angular_size;
    for (std::size_t k = 0; k < v.size(); ++k) {
      momentum += time_step * force[k];
      angular += time_step * force[k] * v.position[k].norm();
    }
    momentum_size_ += static_cast<double>(count) * momentum;
    angular_size_ += static_cast<double>(count) * angular;
    drift_ += now_.momentum - before.momentum;
    turn_ += now_.angular - before.angular;
    found_.momentum = max_or_nan(found_.momentum, drift_.head<2>().norm() / momentum_size_);
    found_.angular = max_or_nan(found_.angular, std::abs(turn_.z()) / angular_size_);
  }

  ChangedEmbeddings follow(const TopologyChange& change) {
    ChangedEmbeddings changed = adapt(body_, change);
    changed.move_cells(mesh_cell_);
    nodes_.apply(body_, changed);
    if (!plan_.forgets || !plan_.forgets(found_.operations())) {
      skin_.apply(body_, changed);
      solids_.apply(body_, changed);
    }
    Skin skin;
    skin.rebuild(body_);
    SkinSolidsView solids = solids_of_cells();
    solids.rebuild(body_);
    if (!(skin == skin_) || !(solids == solids_)) {
      ++found_.strangers;
      skin_.rebuild(body_);
      solids_.rebuild(body_);
    }
    verlet_->restart();
    contact_->system_changed(system(), body_.vertices.position);
    if (plan_.meddles) plan_.meddles(found_.operations(), body_.vertices);
    return changed;
  }

  void remove(const Sums& before) {
    const Dart d = some_dart();
    const std::uint32_t c = body_.cell(body_.map, d);
    Sums taken;
    std::array<Vector3d, 4> rest, now;
    const VertexColumns& v = body_.vertices;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::uint32_t node = nodes_.nodes[c][k];
      const double mass = body_.node_share[c];
      rest[k] = problem_.mesh.points[v.point[node]];
      now[k] = v.position[node];
      taken.kinetic += 0.5 * mass * v.velocity[node].squaredNorm();
      taken.gravitational -= mass * problem_.surroundings.gravity.dot(v.position[node]);
      taken.momentum += mass * v.velocity[node];
      taken.angular += mass * v.position[node].cross(v.velocity[node]);
    }
    taken.elastic = static_cast<double>(reference::tetrahedron_energy(problem_.material, rest, now));
    ++found_.removed;
    follow(remove_volume(body_.map, d));
    now_ = sums();
    compare_sums(before, taken);
  }

  void compare_sums(const Sums& before, const Sums& taken) {
    const auto difference = [](double from, double to, double less) {
      return from == 0.0 ? std::abs(to) : std::abs((from - to) - less) / std::abs(from);
    };
    found_.elastic = max_or_nan(found_.elastic, difference(before.elastic, now_.elastic, taken.elastic));
    found_.sums = max_or_nan(found_.sums, difference(before.kinetic, now_.kinetic, taken.kinetic));
    found_.sums = max_or_nan(found_.sums, difference(before.gravitational, now_.gravitational, taken.gravitational));
    found_.sums =
        max_or_nan(found_.sums, (before.momentum - now_.momentum - taken.momentum).norm() / before.momentum_size);
    found_.sums = max_or_nan(found_.sums, (before.angular - now_.angular - taken.angular).norm() / before.angular_size);
    found_.reopened = max_or_nan(found_.reopened, std::abs(now_.contact - before.contact) / energy_above_floor(before));
  }

  std::vector<ContactPart> contact_parts() const {
    std::vector<ContactPart> parts;
    Contacts(obstacles_.get(), bodies_.get()).for_each_touch({body_.vertices.position}, [&](const Touch& touch) {
      ContactPart& part = parts.emplace_back();
      part.sample = skin_.samples()[touch.sample].nodes;
      part.add(skin_.samples()[touch.sample].corners());
      if (touch.in_body != nullptr) part.add(solids_.solids().tetrahedra()[touch.in_body->tetrahedron].nodes);
      part.energy = touch.law->energy(touch.area, touch.depth);
    });
    return parts;
  }

  /// Energy of contacts of a sample with a cell that has corners where all of its nodes are: across a fresh cut.
  double energy_across_cuts() const {
    const std::vector<Vector3d>& x = body_.vertices.position;
    double sum = 0.0;
    for (const BodyTouch& touch : bodies_->touching({x})) {
      const auto& corners = solids_.solids().tetrahedra()[touch.tetrahedron].nodes;
      if (std::ranges::all_of(skin_.samples()[touch.sample].corners(), [&](std::uint32_t k) {
            return std::ranges::any_of(corners, [&](std::uint32_t j) { return x[j] == x[k]; });
          }))
        sum += bodies_->laws()[touch.law].energy(touch.area, touch.depth);
    }
    return sum;
  }

  SkinSolidsView solids_of_cells() const {
    return SkinSolidsView([this](std::uint32_t c) {
      const auto next = std::ranges::upper_bound(first_cell_, mesh_cell_[c]);
      return static_cast<std::uint32_t>(next - first_cell_.begin()) - 1;
    });
  }

  const PressedOperationsPlan& plan_;
  PressedOperations& found_;
  SplitMix64 random_;
  ContactLaw law_;
  std::vector<std::size_t> first_cell_;
  Problem problem_;
  Body body_;
  std::vector<std::uint32_t> mesh_cell_;  // by cell: its number in the mesh
  ElementNodesView<TetrahedronNodes> nodes_{true};
  Skin skin_;
  SkinSolidsView solids_ = solids_of_cells();
  std::unique_ptr<ForceTerm> tetrahedra_;
  std::unique_ptr<ObstacleContact> obstacles_;
  std::unique_ptr<BodyContact> bodies_;
  std::unique_ptr<SceneContact> contact_;
  std::vector<const ForceTerm*> terms_;
  std::unique_ptr<Integrator> verlet_ = make_integrator("verlet");
  double altitude_ = 0.0;  // [m] the least of a cell at rest
  std::size_t whole_ = 0, steps_ = 0;
  Sums now_;
  // over all steps: the sums of what is not accounted for, and of the sizes
  double unaccounted_ = 0.0, most_energy_ = 0.0, momentum_size_ = 0.0, angular_size_ = 0.0;
  Vector3d drift_{0, 0, 0}, turn_{0, 0, 0};
};

}  // namespace

PressedOperations operate_under_pressure(const PressedOperationsPlan& plan,
                                         const std::function<void(std::size_t)>& looked) {
  PressedOperations found;
  std::uint64_t seed = plan.seed * 1'000'003;
  std::unique_ptr<PressedStack> pressed;
  for (std::size_t k = 1; k <= plan.operations; ++k) {
    if (!pressed || pressed->is_used_up()) {
      pressed = std::make_unique<PressedStack>(seed++, plan, found);
      if (!pressed->move(settling)) return found;
    }
    pressed->operate();
    if (!pressed->move(between)) return found;
    if (k % plan.look_every == 0 || k == plan.operations) {
      pressed->look();
      if (looked) looked(k);
    }
  }
  found.ended = true;
  return found;
}

}  // namespace dartboard
