// The oracle is the same formula in long double (64 bits of mantissa, 2000 times finer), written cell by cell from the
// soup: no edge list, no springs in common with any implementation. Each of two double implementations must be within
// half of the bound of it.

#include "reference/summation_bound.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/plain/error.h"
#include "reference/adjacency_graph.h"
#include "tests/support/meshes_for_tests.h"

namespace dartboard::reference::summation_bound_test {
namespace {

using Long = long double;
using LongVector = Eigen::Matrix<Long, 3, 1>;
using LongVectors = std::vector<LongVector>;

// Forces without gravity; every cell pulls along each of its six edges on its own.
LongVectors soup_forces(const Problem& p, const LongVectors& x, const LongVectors& v, const std::vector<Long>& mass) {
  LongVectors f(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) f[i] = -Long(p.material.viscosity) * mass[i] * v[i];
  for (std::size_t c = 0; c < p.mesh.cell_count(); ++c) {
    const auto cell = p.mesh.cell(c);
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t other = 0; other < 4; ++other) {
        if (other == k) continue;
        const std::uint32_t i = cell[k], j = cell[other];
        const LongVector d = x[j] - x[i];
        const Long L = (p.mesh.points[j].cast<Long>() - p.mesh.points[i].cast<Long>()).norm(), l = d.norm();
        f[i] += (Long(p.material.stiffness) * (l - L) + Long(p.material.damping) * (v[j] - v[i]).dot(d) / l) / l * d;
      }
  }
  return f;
}

std::vector<Long> soup_masses(const Problem& p) {
  std::vector<Long> mass(p.mesh.points.size(), 0);
  for (std::size_t c = 0; c < p.mesh.cell_count(); ++c)
    for (std::uint32_t i : p.mesh.cell(c)) mass[i] += Long(p.material.density) * Long(signed_measure(p.mesh, c)) / 4;
  return mass;
}

// Classical Runge-Kutta, plainly.
void soup_run(const Problem& p, LongVectors& x, LongVectors& v, int steps) {
  const auto mass = soup_masses(p);
  const std::size_t n = x.size();
  const Long h = p.h;
  for (int step = 0; step < steps; ++step) {
    LongVectors kx[4], kv[4];
    for (std::size_t s = 0; s < 4; ++s) {
      const Long reach = s == 0 ? 0 : s == 3 ? h : h / 2;
      LongVectors xs = x, vs = v;
      if (s > 0)
        for (std::size_t i = 0; i < n; ++i) {
          xs[i] += reach * kx[s - 1][i];
          vs[i] += reach * kv[s - 1][i];
        }
      kx[s] = vs;
      kv[s] = soup_forces(p, xs, vs, mass);
      for (std::size_t i = 0; i < n; ++i) kv[s][i] = kv[s][i] / mass[i] + p.surroundings.gravity.cast<Long>();
      for (std::uint32_t i : p.fixed) kx[s][i] = kv[s][i] = LongVector::Zero();
    }
    for (std::size_t i = 0; i < n; ++i) {
      x[i] += h / 6 * (kx[0][i] + 2 * kx[1][i] + 2 * kx[2][i] + kx[3][i]);
      v[i] += h / 6 * (kv[0][i] + 2 * kv[1][i] + 2 * kv[2][i] + kv[3][i]);
    }
  }
}

LongVectors widen(const std::vector<Eigen::Vector3d>& a) {
  LongVectors out;
  for (const auto& p : a) out.push_back(p.cast<Long>());
  return out;
}

double largest(const LongVectors& a, const LongVectors& b) {
  Long most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, (a[i] - b[i]).lpNorm<Eigen::Infinity>());
  return static_cast<double>(most);
}

// A grid with edges of about 0.1 m, a few points held, in a strongly deformed and moving state.
struct Case {
  Problem problem;
  PointState state;

  explicit Case(unsigned seed, double size = 0.2) {
    problem.mesh = kuhn_grid(3, 2, 2, 0.1, 0.1, seed);
    problem.material.damping = 0.05;
    problem.fixed = {0, 4, 8};
    state.x = kuhn_grid(3, 2, 2, 0.1, size, seed + 1000).points;
    state.v = kuhn_grid(3, 2, 2, 0.1, 1.0, seed + 2000).points;
    for (std::uint32_t i : problem.fixed) {
      state.x[i] = problem.mesh.points[i];
      state.v[i].setZero();
    }

    // h omega = 0.16 with the Gershgorin omega, sqrt(2 sum k / m) of the worst point, which is some 1.6 times too high
    std::vector<double> sum(problem.mesh.points.size());
    const AdjacencyGraph body(problem);
    for (const Spring& s : body.spring_list()) {
      sum[s.a] += s.stiffness;
      sum[s.b] += s.stiffness;
    }
    double omega2 = 0.0;
    for (std::size_t i = 0; i < sum.size(); ++i) omega2 = std::max(omega2, 2.0 * sum[i] / body.masses()[i]);
    problem.h = 0.16 / std::sqrt(omega2);
  }
};

// The same problem with its points and cells numbered backwards: all sums in other orders, with other signs.
Case backwards(const Case& c) {
  Case out = c;
  const Mesh& mesh = c.problem.mesh;
  const auto last = static_cast<std::uint32_t>(mesh.points.size() - 1);
  Mesh turned;
  turned.points.assign(mesh.points.rbegin(), mesh.points.rend());
  for (std::size_t k = mesh.cell_count(); k-- > 0;) {
    std::vector<std::uint32_t> nodes(mesh.cell(k).begin(), mesh.cell(k).end());
    for (auto& node : nodes) node = last - node;
    std::rotate(nodes.begin(), nodes.begin() + 1, nodes.begin() + 3);  // an even permutation of a tetrahedron
    turned.add_cell(mesh.kinds[k], nodes);
  }
  out.problem.mesh = turned;
  for (auto& i : out.problem.fixed) i = last - i;
  std::reverse(out.problem.fixed.begin(), out.problem.fixed.end());
  std::reverse(out.state.x.begin(), out.state.x.end());
  std::reverse(out.state.v.begin(), out.state.v.end());
  return out;
}

TEST(ForceBound, HoldsHalfForOneImplementationAgainstTheExactForces) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Case c(seed, seed % 2 ? 0.2 : 1e-6);  // with and without much cancellation of l - L
    AdjacencyGraph body(c.problem);
    body.set_state(c.state);
    const auto computed = body.spring_and_drag_forces();
    const auto exact = soup_forces(c.problem, widen(c.state.x), widen(c.state.v), soup_masses(c.problem));
    const auto bound = force_bound(c.problem, c.state);
    for (std::size_t i = 0; i < bound.size(); ++i)
      EXPECT_LE(static_cast<double>((computed[i].cast<Long>() - exact[i]).norm()), bound[i] / 2) << seed << ", " << i;
  }
}

TEST(ForceBound, IsSmallAgainstTheForces) {
  // some 100 roundings of terms that are at most k (l + L), about 20 times the forces here
  const Case c(3);
  AdjacencyGraph body(c.problem);
  body.set_state(c.state);
  const auto forces = body.spring_and_drag_forces();
  const auto bound = force_bound(c.problem, c.state);
  double force = 0.0;
  for (const auto& f : forces) force = std::max(force, f.norm());
  EXPECT_LT(*std::max_element(bound.begin(), bound.end()), 1e-12 * force);
}

TEST(ForceBound, DoesNotLetPassAStiffnessThatIsWrongInTheEleventhDigit) {
  const Case c(4);
  Problem wrong = c.problem;
  wrong.material.stiffness *= 1.0 + 1e-11;
  AdjacencyGraph right_body(c.problem), wrong_body(wrong);
  right_body.set_state(c.state);
  wrong_body.set_state(c.state);
  const auto a = right_body.spring_and_drag_forces(), b = wrong_body.spring_and_drag_forces();
  const auto bound = force_bound(c.problem, c.state);
  bool caught = false;
  for (std::size_t i = 0; i < a.size(); ++i) caught = caught || (a[i] - b[i]).norm() > bound[i];
  EXPECT_TRUE(caught);
}

TEST(StateBound, HoldsHalfForOneImplementationAgainstTheExactRun) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const Case c(seed);
    AdjacencyGraph body(c.problem);
    body.set_state(c.state);
    LongVectors x = widen(c.state.x), v = widen(c.state.v);
    for (int steps : {1, 9}) {  // 1 and 10 steps from the start
      body.step(steps);
      soup_run(c.problem, x, v, steps);
      const StateBound bound = state_bound(c.problem, c.state, steps == 1 ? 1 : 10);
      EXPECT_LE(largest(widen(body.state().x), x), bound.position / 2) << seed;
      EXPECT_LE(largest(widen(body.state().v), v), bound.velocity / 2) << seed;
    }
  }
}

// At rest only gravity acts, so that all other quantities stay finite.
TEST(StateBound, IsInfiniteWhereARunHasNoNumbers) {
  Case c(0, 0.0);
  c.state.x = c.problem.mesh.points;
  for (auto& v : c.state.v) v.setZero();
  c.problem.surroundings.gravity = {0, 0, std::numeric_limits<double>::quiet_NaN()};
  const StateBound bound = state_bound(c.problem, c.state, 1);
  EXPECT_TRUE(std::isinf(bound.position));
  EXPECT_TRUE(std::isinf(bound.velocity));
}

TEST(StateBound, HoldsForTheSameBodyNumberedBackwards) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Case c(seed), d = backwards(c);
    AdjacencyGraph forward(c.problem), backward(d.problem);
    forward.set_state(c.state);
    backward.set_state(d.state);
    forward.step(10);
    backward.step(10);
    PointState other = backward.state();
    std::reverse(other.x.begin(), other.x.end());
    std::reverse(other.v.begin(), other.v.end());
    const StateBound bound = state_bound(c.problem, c.state, 10);
    const double apart = largest(widen(forward.state().x), widen(other.x));
    EXPECT_GT(apart, 0.0);  // the orders do differ
    EXPECT_LE(apart, bound.position) << seed;
    EXPECT_LE(largest(widen(forward.state().v), widen(other.v)), bound.velocity) << seed;
  }
}

TEST(StateBound, IsABillionthOfAnEdgeAfterTenSteps) {
  const StateBound bound = state_bound(Case(5).problem, Case(5).state, 10);
  EXPECT_LT(bound.position, 1e-9 * 0.1);
  EXPECT_GT(bound.position, 0.0);
}

TEST(StateBound, IsZeroForNoStepAndGrowsWithEveryStep) {
  const Case c(6);
  EXPECT_EQ(state_bound(c.problem, c.state, 0).position, 0.0);
  EXPECT_LT(state_bound(c.problem, c.state, 5).position, state_bound(c.problem, c.state, 6).position);
}

TEST(StateBound, IsInfiniteWhereASpringCollapsesOrTheRunDiverges) {
  Case collapsed(7);  // at the second stage the spring 0 1 is still that short, and positions are known to 1e-17
  collapsed.state.x[1] = collapsed.state.x[0] + Eigen::Vector3d(1e-14, 0, 0);
  collapsed.state.v[1].setZero();
  EXPECT_TRUE(std::isinf(state_bound(collapsed.problem, collapsed.state, 2).position));

  Case wild(8);
  wild.problem.h *= 100.0;
  EXPECT_TRUE(std::isinf(state_bound(wild.problem, wild.state, 200).position));
}

TEST(SummationBound, RefusesAStateOfAnotherBody) {
  const Case c(9);
  EXPECT_THROW(force_bound(c.problem, {}), InputError);
  EXPECT_THROW(state_bound(c.problem, {}, 1), InputError);
}

}  // namespace
}  // namespace dartboard::reference::summation_bound_test
