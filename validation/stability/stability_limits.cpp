#include "validation/stability/stability_limits.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/mechanics/adapt.h"
#include "core/operations/dissociate_face.h"
#include "core/operations/remove_volume.h"
#include "core/plain/random.h"
#include "core/time/watch/stable_step.h"
#include "core/views/spring_ends.h"
#include "validation/stability/frequency_oracle.h"
#include "validation/stability/growth_run.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;
using TetBody = MassSpringBody<TetMap, Held::by_every_dart>;

constexpr double ratios[]{0.0, 0.05, 0.2, 0.5, 1.0};
constexpr double mesh_ratios[]{0.0, 0.2};  // a step of a mesh costs a thousand times as much

/// A body with the frequencies that matter and the shape of the fastest.
struct Subject {
  std::string name;
  SpringColumns body;
  std::vector<double> frequencies;  // those with limits of their own: all, or the highest
  GrowthRun run;
  double tolerance;  // a thousandth where frequencies are closed forms
  int halvings;
};

Subject oscillator_subject() {
  return {"oscillator", extreme_body("oscillator"), {10.0}, {.omega = 10.0, .shape = {{0, 0, 0}, {1, 0, 0}}}, 1e-3, 8};
}

Subject chain_subject() {
  Subject chain{"chain", extreme_body("chain"), {}, {}, 1e-3, 8};
  const std::size_t n = chain.body.x.size() - 2;
  const double angle = std::numbers::pi / static_cast<double>(n + 1);
  for (std::size_t j = n; j >= 1; --j) chain.frequencies.push_back(20.0 * std::sin(static_cast<double>(j) * angle / 2));
  for (std::size_t i = 0; i < n + 2; ++i)
    chain.run.shape.push_back({std::sin(static_cast<double>(i * n) * angle), 0, 0});
  chain.run.shape.front().setZero();
  chain.run.shape.back().setZero();
  chain.run.omega = chain.frequencies.front();
  return chain;
}

Subject mesh_subject(const MeshBody& mesh, bool quick) {
  return {mesh.name, mesh.body, {mesh.omega}, {mesh.omega, mesh.shape, quick ? 1000u : 2000u}, 5e-3, 5};
}

void measure(const Subject& subject, std::span<const double> damping_ratios, std::span<const IntegratorEntry> entries,
             std::vector<StabilityLimit>& limits) {
  for (const IntegratorEntry& entry : entries) {
    const auto integrator = entry.make();
    const Scheme& scheme = integrator->scheme();
    if (scheme.implicit) continue;
    for (const double zeta : damping_ratios) {
      // Symplectic Euler damps spring by spring. In a network that is less than its scheme states for one damper, and
      // its limit, unlike that of the symmetric methods, depends on it.
      if (scheme.symplectic && !scheme.symmetric && zeta > 0.0 && subject.name != "oscillator") continue;
      const double omega = subject.run.omega;
      SpringColumns body = subject.body;
      for (Spring& s : body.springs) s.damping = 2 * zeta / omega * s.stiffness;
      StabilityLimit limit{subject.name, std::string(entry.name), zeta, Scheme::unlimited, 0.0, subject.tolerance};
      for (const double frequency : subject.frequencies)
        limit.theory = std::min(limit.theory, omega / frequency *
                                                  stable_limit(scheme, zeta * frequency / omega,
                                                               subject.run.measured_steps(), subject.run.gain));
      if (!std::isfinite(limit.theory)) continue;
      double low = 0.99 * limit.theory, high = (subject.tolerance > 4e-3 ? 1.006 : 1.004) * limit.theory;
      if (is_stable(subject.run, body, *integrator, low / omega) &&
          !is_stable(subject.run, body, *integrator, high / omega)) {
        for (int k = 0; k < subject.halvings; ++k) {
          const double middle = (low + high) / 2;
          (is_stable(subject.run, body, *integrator, middle / omega) ? low : high) = middle;
        }
        limit.measured = (low + high) / 2;
      }
      limits.push_back(std::move(limit));
    }
  }
}

MeshBody with_frequency(std::string name, SpringColumns body) {
  MeshBody made{.name = std::move(name), .body = std::move(body)};
  FastestMode mode = fastest_mode(made.body);
  made.omega = mode.omega;
  made.error = mode.error;
  made.proven = mode.proven;
  StableStepEstimate estimate;
  const StableStep bracket = estimate.refresh(made.body.system(), made.body.x);
  made.lower = bracket.lower;
  made.upper = bracket.upper;
  double edges = 0.0;
  for (const Spring& s : made.body.springs) edges += s.rest_length / static_cast<double>(made.body.springs.size());
  for (Vector3d& p : mode.shape) p *= edges;
  made.shape = std::move(mode.shape);
  return made;
}

SpringColumns columns_of(const TetBody& body) {
  SpringEndsView ends;
  ends.rebuild(body);
  const VertexColumns& v = body.vertices;
  SpringColumns columns;
  columns.ends.assign(ends.ends.begin(), ends.ends.end());
  columns.springs.assign(body.springs.begin(), body.springs.end());
  columns.mass.assign(v.mass.begin(), v.mass.end());
  columns.inverse_mass.assign(v.inverse_mass.begin(), v.inverse_mass.end());
  columns.viscosity.assign(v.viscosity.begin(), v.viscosity.end());
  columns.fixed.assign(v.fixed.begin(), v.fixed.end());
  columns.x.assign(v.position.begin(), v.position.end());
  columns.v.assign(v.position.size(), Vector3d::Zero());
  return columns;
}

}  // namespace

bool StabilityLimit::holds() const { return std::abs(measured / theory - 1.0) <= tolerance; }

std::vector<StabilityLimit> measure_stability_limits(bool quick, std::span<const IntegratorEntry> entries) {
  std::vector<StabilityLimit> limits;
  measure(oscillator_subject(), ratios, entries, limits);
  measure(chain_subject(), ratios, entries, limits);
  for (const char* name : {"box", "sheet"})
    measure(mesh_subject(with_frequency(name, extreme_body(name)), quick), ratios, entries, limits);
  return limits;
}

std::vector<MeshBody> mesh_bodies(const std::string& name, const Mesh& mesh, int operations, std::uint64_t seed) {
  Problem problem;
  problem.mesh = mesh;
  problem.material = {.density = 1000.0, .stiffness = 100.0, .damping = 0.0, .viscosity = 0.0};
  TetBody body = build_body<TetMap, Held::by_every_dart>(problem);
  std::vector<MeshBody> bodies{with_frequency(name, columns_of(body))};
  SplitMix64 random(seed);
  for (int k = 0; k < operations && body.map.dart_count() > 24; ++k) {
    Dart d{random.below(body.map.capacity())};
    while (!body.map.is_live(d)) d = Dart{random.below(body.map.capacity())};
    adapt(body, k % 10 == 9 ? remove_volume(body.map, d) : dissociate_face(body.map, d));
  }
  bodies.push_back(with_frequency(name + ", cut", columns_of(body)));
  bodies.back().rise = bodies.back().omega / bodies.front().omega;
  return bodies;
}

std::vector<StabilityLimit> measure_mesh_limits(std::span<const MeshBody> bodies, bool quick,
                                                std::span<const IntegratorEntry> entries) {
  std::vector<StabilityLimit> limits;
  for (const MeshBody& mesh : bodies)
    measure(mesh_subject(mesh, quick), std::span(mesh_ratios).first(quick ? 1 : 2), entries, limits);
  return limits;
}

}  // namespace dartboard
