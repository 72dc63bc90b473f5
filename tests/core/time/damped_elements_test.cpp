// Elements that are damped, in time: the requested ratio, every integrator, the limits of steps.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/elements/solids.h"
#include "core/forces/term_damping.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/eigenvalues.h"
#include "core/plain/material.h"
#include "core/time/explicit/frozen_damping.h"
#include "core/time/integrators.h"
#include "core/time/system/energy.h"
#include "core/time/watch/divergence.h"
#include "core/time/watch/stable_step.h"
#include "tests/support/bodies/bar_of_elements_for_tests.h"

namespace dartboard::damped_elements_test {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

constexpr double young = 2e4, density = 1000.0;

/// A system of bare columns.
struct Body {
  std::vector<double> mass, inverse_mass;
  std::vector<Vector3d> rest, x, v;
  std::vector<SolidNodes> nodes;
  std::vector<SolidShape> shape;
  Material material;
  std::unique_ptr<ForceTerm> term;
  const ForceTerm* terms = nullptr;

  SpringSystem system() const {
    SpringSystem system;
    system.mass = mass;
    system.inverse_mass = inverse_mass;
    system.terms = {&terms, 1};
    return system;
  }
  Motion motion() { return {x, v}; }
};

/// A bar of hexahedra along x, of Poisson's ratio 0: its axial motions are those of a chain.
std::unique_ptr<Body> bar_of_hexahedra(int cells, double side, double damping_time) {
  auto body = std::make_unique<Body>();
  const Mesh mesh = hexahedron_box(cells, 1, 1, side);
  body->material = {.density = density,
                    .stiffness = 0.0,
                    .damping = 0.0,
                    .young = young,
                    .poisson = 0.0,
                    .model = Model::neo_hookean,
                    .damping_time = damping_time};
  body->rest = body->x = mesh.points;
  body->v.assign(mesh.points.size(), Vector3d(0, 0, 0));
  body->mass.assign(mesh.points.size(), 0.0);
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    SolidNodes n;
    std::vector<Vector3d> at;
    for (const std::uint32_t p : mesh.cell(c)) {
      n.at[n.count++] = p;
      at.push_back(mesh.points[p]);
      body->mass[p] += density * side * side * side / 8;
    }
    body->nodes.push_back(n);
    body->shape.push_back(solid_shape_of(mesh.kinds[c], at));
  }
  for (const double m : body->mass) body->inverse_mass.push_back(1.0 / m);
  body->term = make_solids(body->material, {body->nodes, body->shape});
  body->terms = body->term.get();
  return body;
}

// Free, a bar of n cells that is started as cos(pi x / L) oscillates in this shape with omega = 2 c / side sin(pi / (2
// n)): an exact mode of masses of cells of equal size. Its ratio is the requested one times its frequency over the
// reference frequency, and in a period it loses exp(-2 pi zeta / sqrt(1 - zeta^2)). The error of an integrator of order
// p in a period of N steps is some (2 pi)^(p+1) / N^p of the amplitude; strains of 1e-7 are linear to their size.
TEST(DampedElements, LoseInAPeriodWhatTheRatioSays) {
  const int n = 8;
  const double side = 0.1, length = n * side, speed = std::sqrt(young / density);
  const double omega = 2.0 * speed / side * std::sin(pi / (2 * n)), frequency = 3.0, ratio = 0.08;
  const double zeta = ratio * omega / (2.0 * pi * frequency);
  const double period = 2.0 * pi / (omega * std::sqrt(1.0 - zeta * zeta));
  const double left = std::exp(-2.0 * pi * zeta / std::sqrt(1.0 - zeta * zeta));
  ASSERT_LT(left, 0.7);
  for (const IntegratorEntry& entry : integrators()) {
    const auto method = make_integrator(entry.name);
    const int order = method->scheme().order, steps = order == 1 ? 2000 : 400;
    const auto body = bar_of_hexahedra(n, side, damping_time_of(ratio, frequency));
    const double amplitude = 1e-7 * length;
    for (std::size_t i = 0; i < body->x.size(); ++i)
      body->x[i][0] += amplitude * std::cos(pi * body->rest[i][0] / length);
    for (int k = 0; k < steps; ++k) {
      const StepResult result = method->step(body->system(), body->motion(), period / steps);
      ASSERT_TRUE(result.ok()) << entry.name << ": " << to_string(result);
    }
    const double tolerance = order == 1 ? 40.0 / steps : 250.0 / steps / steps;
    for (std::size_t i = 0; i < body->x.size(); ++i) {
      const double moved = (body->x[i][0] - body->rest[i][0]) / amplitude;
      EXPECT_NEAR(moved, left * std::cos(pi * body->rest[i][0] / length), tolerance + 1e-6) << entry.name;
      EXPECT_NEAR((body->x[i] - body->rest[i]).tail<2>().norm() / amplitude, 0.0, tolerance + 1e-6) << entry.name;
    }
  }
}

constexpr double strong = 0.02;  // [s]

/// M^-1/2 A M^-1/2, entry by entry.
Eigen::MatrixXd over_masses(const ElementBody& body, const BlockMatrix& matrix) {
  const auto n = static_cast<Eigen::Index>(3 * body.x.size());
  Eigen::MatrixXd dense(n, n);
  std::vector<Vector3d> unit(body.x.size(), Vector3d(0, 0, 0)), column(body.x.size());
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k / 3);
    unit[i][k % 3] = body.fixed[i] ? 0.0 : std::sqrt(body.inverse_mass[i]);
    matrix.multiply(unit, column);
    unit[i][k % 3] = 0.0;
    for (std::size_t j = 0; j < column.size(); ++j)
      dense.block<3, 1>(3 * static_cast<Eigen::Index>(j), k) =
          body.fixed[j] ? Vector3d(0, 0, 0) : Vector3d(std::sqrt(body.inverse_mass[j]) * column[j]);
  }
  return dense;
}
Eigen::MatrixXd stiffness(const ElementBody& body) {
  BlockMatrix k;
  k.pattern = node_pattern_of(body.system());
  stiffness_of_terms(body.system(), {{body.x}, TermTangents::Kind::projected}, k);
  return over_masses(body, k);
}
Eigen::MatrixXd damping(const ElementBody& body) {
  BlockMatrix c;
  c.pattern = node_pattern_of(body.system());
  damping_of_terms(body.system(), {{body.x}, TermTangents::Kind::projected}, c);
  return over_masses(body, c);
}

// Every mode of any body has the ratio omega tau / 2: of tetrahedra, by its own matrix. Two modes, of which the second
// has at least one and a half times the frequency.
TEST(DampedElements, DampEveryModeByItsFrequency) {
  ElementBody body(kuhn_box(3, 1, 2, 0.1, 0.15, 5), Model::corotational, young, 0.3, density, 1e-3);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(stiffness(body));
  double before = 0.0;
  for (const Eigen::Index mode : {6, 14}) {
    const double omega = std::sqrt(modes.eigenvalues()[mode]), zeta = omega * 1e-3 / 2;
    EXPECT_GT(omega, 1.5 * before);
    before = omega;
    const double root = std::sqrt(1.0 - zeta * zeta), period = 2.0 * pi / (omega * root);
    const auto displaced = [&](double size) {
      std::vector<Vector3d> u;
      for (std::size_t i = 0; i < body.x.size(); ++i)
        u.push_back(size * std::sqrt(body.inverse_mass[i]) *
                    modes.eigenvectors().col(mode).segment<3>(3 * static_cast<Eigen::Index>(i)));
      return u;
    };
    const double size = 1e-8;  // strains below 1e-6
    const std::vector<Vector3d> start = displaced(size), end = displaced(size * std::exp(-2.0 * pi * zeta / root));
    for (const char* integrator : {"verlet", "rk4", "implicit-midpoint"}) {
      body.x = body.rest;
      for (std::size_t i = 0; i < start.size(); ++i) body.x[i] += start[i];
      body.v.assign(body.v.size(), Vector3d(0, 0, 0));
      const auto method = make_integrator(integrator);
      // an amplitude is wrong by some (2 pi)^3 / N^2 at order 2; and the fastest motion has to be stable
      const int steps = 1000;
      for (int k = 0; k < steps; ++k)
        ASSERT_TRUE(method->step(body.system(), body.motion(), period / steps).ok()) << integrator;
      double wrong = 0.0, whole = 0.0;
      for (std::size_t i = 0; i < start.size(); ++i) {
        wrong += (body.x[i] - body.rest[i] - end[i]).squaredNorm();
        whole += start[i].squaredNorm();
      }
      EXPECT_LT(std::sqrt(wrong / whole), 250.0 / steps / steps + 1e-5) << integrator << ", " << zeta;
    }
  }
}

// Halving a step divides the error by 2^p, with damping ratios up to 0.4 and a body that turns and is deformed.
TEST(DampedElements, KeepTheOrderOfEveryIntegrator) {
  const double duration = 0.02, damping_time = 1e-3;
  const ElementBody truth = run(bar(Model::neo_hookean, damping_time, true), "rk4", duration, 8192).body;
  EXPECT_GT(distance(truth, run(bar(Model::neo_hookean, 0.0, true), "rk4", duration, 8192).body), 1e-4);
  for (const IntegratorEntry& entry : integrators()) {
    const Scheme& scheme = scheme_of(entry.name);
    if (scheme.compensated || std::string(entry.name) == "local-global") continue;  // as ElementMotion has it
    const int coarse = scheme.order == 4 ? 64 : scheme.order == 5 ? 32 : 512;
    const BarOutcome first = run(bar(Model::neo_hookean, damping_time, true), entry.name, duration, coarse),
                     second = run(bar(Model::neo_hookean, damping_time, true), entry.name, duration, 2 * coarse);
    ASSERT_TRUE(first.result.ok() && second.result.ok()) << entry.name << ": " << to_string(first.result);
    const double order = std::log2(distance(first.body, truth) / distance(second.body, truth));
    EXPECT_NEAR(order, scheme.order, scheme.order >= 4 ? 0.35 : 0.15)
        << entry.name << ": " << distance(first.body, truth) << ", " << distance(second.body, truth);
  }
}

TEST(DampedElements, KeepLinearAndAngularMomentum) {
  for (const char* integrator :
       {"verlet", "symplectic-euler", "blanes-moan-4", "implicit-midpoint", "energy-momentum"}) {
    const ElementBody start = bar(Model::neo_hookean, strong);
    const bool splits = std::string(integrator) == "verlet" || std::string(integrator) == "symplectic-euler";
    // blanes-moan-4 is stable for weak damping alone
    const bool weak = std::string(integrator) == "blanes-moan-4";
    const BarOutcome end = run(bar(Model::neo_hookean, weak ? 1e-3 : strong), integrator, 0.1, 400);
    ASSERT_TRUE(end.result.ok()) << integrator << ": " << to_string(end.result);
    const SpringSystem system = end.body.system();
    const Vector3d p = linear_momentum(system, start.v), l = angular_momentum(system, start.x, start.v);
    // explicit: roundings of 400 steps, of 2 sweeps of 216 impulses each; implicit: Newton's residual, too
    const double bound = std::string(integrator) == "implicit-midpoint" ? 1e-8 : splits ? 1e-11 : 1e-12;
    EXPECT_LT((linear_momentum(system, end.body.v) - p).norm(), bound * p.norm()) << integrator;
    EXPECT_LT((angular_momentum(system, end.body.x, end.body.v) - l).norm(), bound * l.norm()) << integrator;
    EXPECT_LT(total_energy(system, end.body.x, end.body.v), 0.9 * total_energy(start.system(), start.x, start.v));
  }
}

// Damping a hundred thousand times critical: sweeps and implicit methods damp the motion within the body, and the
// motion as a whole goes on. Energy never grows: at these steps oscillations have hardly begun.
TEST(DampedElements, AreStableHoweverStrongTheyAreDamped) {
  for (const char* integrator : {"verlet", "symplectic-euler", "backward-euler", "baraff-witkin", "sdirk2", "bdf2"})
    for (const double damping_time : {1.0, 1e4}) {
      ElementBody body = bar(Model::corotational, damping_time);
      double mass = 0.0;
      for (const double m : body.mass) mass += m;
      const Vector3d p = linear_momentum(body.system(), body.v);
      double energy = total_energy(body.system(), body.x, body.v);
      const auto method = make_integrator(integrator);
      for (int k = 0; k < 100; ++k) {
        const StepResult result = method->step(body.system(), body.motion(), 1e-4);
        ASSERT_TRUE(result.ok()) << integrator << ": " << to_string(result);
        const double now = total_energy(body.system(), body.x, body.v);
        EXPECT_LE(now, energy * (1.0 + 1e-4)) << integrator << ", " << damping_time << ", step " << k;
        energy = now;
      }
      EXPECT_GT(kinetic_energy(body.system(), body.v), p.squaredNorm() / mass / 2 * (1.0 - 1e-6)) << integrator;
    }
}

// Local/global iterations end where backward Euler does.
TEST(DampedElements, AreSolvedForByAConstantMatrixToo) {
  const BarOutcome newton = run(bar(Model::neo_hookean, 1e-3, true), "backward-euler", 0.02, 40),
                   constant = run(bar(Model::neo_hookean, 1e-3, true), "local-global", 0.02, 40),
                   undamped = run(bar(Model::neo_hookean, 0.0, true), "local-global", 0.02, 40);
  ASSERT_TRUE(newton.result.ok() && constant.result.ok());
  // twenty iterations leave a hundredth of the effect of damping
  EXPECT_LT(distance(newton.body, constant.body), 0.02 * distance(newton.body, undamped.body));
}

// Frozen, velocities decay as exp(-t M^-1 C), to the third power of the step in one.
TEST(DampedElements, DecayWithOrder2WhereTheyAreFrozen) {
  const ElementBody start = bar(Model::neo_hookean, 1e-3);
  const SpringSystem system = start.system();
  const Terms terms = terms_of(system);
  EXPECT_TRUE(terms.damping);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> rates(damping(start));
  Eigen::VectorXd scaled(rates.eigenvalues().size());
  for (std::size_t i = 0; i < start.x.size(); ++i)
    scaled.segment<3>(3 * static_cast<Eigen::Index>(i)) = std::sqrt(start.mass[i]) * start.v[i];
  std::vector<double> errors;
  for (const double theta : {0.2, 0.1}) {
    const double h = theta / rates.eigenvalues().maxCoeff();
    const Eigen::VectorXd exact =
        rates.eigenvectors() *
        ((-h * rates.eigenvalues()).array().exp() * (rates.eigenvectors().transpose() * scaled).array()).matrix();
    std::vector<Vector3d> v = start.v;
    FrozenDamping frozen;
    frozen.freeze(system, terms, start.x);
    frozen.decay_symmetric(system, terms, h, v);
    double error = 0.0;
    for (std::size_t i = 0; i < v.size(); ++i)
      error += (std::sqrt(start.mass[i]) * v[i] - exact.segment<3>(3 * static_cast<Eigen::Index>(i))).squaredNorm();
    errors.push_back(std::sqrt(error));
  }
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 3.0, 0.1);
  // and the product used in the series is M^-1 C
  FrozenDamping frozen;
  std::vector<Vector3d> product(start.v.size());
  frozen.freeze(system, terms, start.x);
  frozen.apply(system, terms, start.v, product);
  const Eigen::VectorXd expected = damping(start) * scaled;
  for (std::size_t i = 0; i < product.size(); ++i)
    EXPECT_LT((std::sqrt(start.mass[i]) * product[i] - expected.segment<3>(3 * static_cast<Eigen::Index>(i))).norm(),
              1e-12 * expected.norm());
}

// At rest damping is proportional, and everything is known of it; deformed, every motion of the body lies between the
// bounds: w'Cw for all eigenvectors w of K.
TEST(DampedElements, HaveTheirRateBracketed) {
  for (const Model model : element_models)
    for (const bool deformed : {false, true}) {
      ElementBody body(kuhn_box(3, 1, 2, 0.1, 0.15, 5), model, young, 0.3, density, strong);
      if (deformed) body.shake(0.01, 4);
      const Eigen::MatrixXd c = damping(body);
      const double rate =
          Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(c, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
      StableStepEstimate estimate;
      const StableStep limits = estimate.refresh(body.system(), body.x);
      EXPECT_GE(limits.damping_rate.upper, rate * (1.0 - 1e-9)) << name(model);
      EXPECT_LE(limits.damping_rate.upper, rate * 1.1) << name(model);
      EXPECT_LE(limits.damping_rate.lower, rate * (1.0 + 1e-9)) << name(model);
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(stiffness(body));
      for (Eigen::Index k = 0; k < modes.eigenvalues().size(); ++k) {
        const double omega = std::sqrt(std::max(0.0, modes.eigenvalues()[k]));
        const double d = modes.eigenvectors().col(k).dot(c * modes.eigenvectors().col(k));
        const Bounds bounds = limits.damping_rates(omega);
        EXPECT_GE(d, bounds.lower - 1e-9 * rate) << name(model) << deformed << omega;
        EXPECT_LE(d, bounds.upper + 1e-9 * rate) << name(model) << deformed << omega;
        // near rest the bounds coincide
        if (deformed) continue;
        EXPECT_NEAR(bounds.upper, strong * omega * omega, 1e-6 * rate) << name(model);
        EXPECT_NEAR(bounds.lower, strong * omega * omega, 1e-6 * rate) << name(model);
      }
    }
}

// Terms that are not damped come before and after: their places in the matrix are skipped.
TEST(DampedElements, HaveTheirPlacesBesideOtherTerms) {
  const ElementBody alone = bar(Model::stvk, strong, true), other = bar(Model::corotational, 0.0, true);
  std::ranges::reverse(other.nodes);  // not the same places in the same order
  const auto matrices = [&](std::vector<const ForceTerm*> terms) {
    SpringSystem system = alone.system();
    system.terms = terms;
    BlockMatrix c, d;
    c.pattern = d.pattern = node_pattern_of(system);
    damping_of_terms(system, {{alone.x}, TermTangents::Kind::exact}, c);
    stiffness_of_stress(system, {{alone.x}, TermTangents::Kind::exact}, d);
    return std::pair(over_masses(alone, c), over_masses(alone, d));
  };
  const auto [c, d] = matrices({alone.terms});
  const auto [c_beside, d_beside] = matrices({other.terms, alone.terms, other.terms});
  EXPECT_GT(c.norm(), 0.0);
  EXPECT_GT(d.norm(), 0.0);
  EXPECT_EQ(c, c_beside);
  EXPECT_EQ(d, d_beside);
}

// Effect of damping on the limit of methods that do not sweep: the limit is found, and not far below the true one.
TEST(DampedElements, AreStableBelowTheirLimitAndFoundOutAbove) {
  for (const char* integrator : {"rk4", "blanes-moan-4", "explicit-euler", "verlet"})
    for (const double damping_time : {2e-4, strong}) {
      // growth above the limit is too slow to be found if damping is weak
      if (std::string(integrator) == "explicit-euler" && damping_time != strong) continue;
      ElementBody body(kuhn_box(3, 1, 2, 0.1, 0.15, 5), Model::neo_hookean, young, 0.3, density, damping_time);
      for (Vector3d& v : body.v) v = Vector3d(1e-6, 0, 0);
      body.shake(1e-7, 2);
      const std::vector<Vector3d> x = body.x, v = body.v;
      const Scheme& scheme = scheme_of(integrator);
      const StepLimit limit = StableStepEstimate().refresh(body.system(), body.rest).limit(scheme, horizon_of(1.0));
      ASSERT_GT(limit.stable, 0.0);
      EXPECT_LT(limit.unstable, 1.15 * limit.stable) << integrator << ", " << damping_time;
      for (const double h : {0.98 * limit.stable, 1.02 * limit.unstable}) {
        body.x = x;
        body.v = v;
        const auto method = make_integrator(integrator);
        DivergenceDetector detector;
        ASSERT_TRUE(detector.start(body.system(), body.motion(), h).ok());
        StepResult result;
        for (int k = 0; k < 6000 && result.ok(); ++k) {
          result = method->step(body.system(), body.motion(), h);
          if (result.ok()) result = detector.after_step(body.system(), body.motion());
        }
        EXPECT_EQ(result.ok(), h < limit.stable) << integrator << ", " << damping_time << ": " << to_string(result);
      }
    }
}

// A sweep in one direction is no symmetric matrix; its limit was found on springs, and holds for elements.
TEST(DampedElements, AreStableBelowTheLimitOfASweepInOneDirection) {
  for (const double damping_time : {1e-3, 4e-3, strong, 0.1}) {
    ElementBody body(kuhn_box(3, 1, 2, 0.1, 0.15, 5), Model::neo_hookean, young, 0.3, density, damping_time);
    for (Vector3d& v : body.v) v = Vector3d(1e-6, 0, 0);
    body.shake(1e-7, 2);
    const auto method = make_integrator("symplectic-euler");
    const double h =
        0.98 * StableStepEstimate().refresh(body.system(), body.x).limit(method->scheme(), horizon_of(1.0)).stable;
    ASSERT_GT(h, 0.0);
    DivergenceDetector detector;
    ASSERT_TRUE(detector.start(body.system(), body.motion(), h).ok());
    for (int k = 0; k < 3000; ++k) {
      ASSERT_TRUE(method->step(body.system(), body.motion(), h).ok()) << damping_time;
      ASSERT_TRUE(detector.after_step(body.system(), body.motion()).ok()) << damping_time << ", step " << k;
    }
  }
}

// A dashpot between a driven end and a spring: all energy of the spring has come through the damping of the first
// cells. A detector that sums elastic forces alone calls the run unstable.
TEST(DampedElements, PassOnTheWorkOfDrivenVertices) {
  ElementBody body(kuhn_box(4, 1, 1, 0.1), Model::neo_hookean, young, 0.0);
  const std::vector<Material> several{body.material,
                                      {.density = density,
                                       .stiffness = 0.0,
                                       .damping = 0.0,
                                       .young = 1.0,
                                       .poisson = 0.0,
                                       .model = Model::neo_hookean,
                                       .damping_time = 2e5}};
  std::vector<MaterialNumber> of_cell(body.nodes.size(), 0);
  for (std::size_t c = 0; c < body.nodes.size(); ++c)
    for (const std::uint32_t i : body.nodes[c])
      if (body.rest[i][0] > 0.4 - 1e-9) of_cell[c] = 1;
  body.term = make_tetrahedra(CellMaterials(several[0], several, of_cell), {body.nodes, body.shape, body.cell_mass});
  body.terms = body.term.get();
  const double speed = 0.05;
  double mass = 0.0;
  for (std::size_t i = 0; i < body.x.size(); ++i) {
    body.fixed[i] = body.rest[i][0] < 1e-9 || body.rest[i][0] > 0.4 - 1e-9;
    if (body.rest[i][0] > 0.4 - 1e-9) body.v[i] = Vector3d(speed, 0, 0);
    mass += body.mass[i];
  }
  const auto verlet = make_integrator("verlet");
  DivergenceDetector detector;
  const double h = 5e-4;
  ASSERT_TRUE(detector.start(body.system(), body.motion(), h).ok());
  for (int k = 0; k < 6000; ++k) {
    ASSERT_TRUE(verlet->step(body.system(), body.motion(), h).ok());
    ASSERT_TRUE(detector.after_step(body.system(), body.motion()).ok()) << k;
  }
  EXPECT_GT(elastic_energy(body.system(), body.x), 2.0 * DivergenceDetector::gain * 2.0 * mass * speed * speed);
}

}  // namespace
}  // namespace dartboard::damped_elements_test
