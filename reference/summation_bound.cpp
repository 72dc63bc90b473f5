// Rounding, in the usual way: every operation is exact times (1 + delta), |delta| <= u = 2^-53, and n such factors
// (in numerator or denominator) are within gamma_n = n u / (1 - n u) of 1. Write "n" for "relative error gamma_n".
//
// Data. The measure of a cell is off by `measure_rounding` at most: d, relative to the mass of a point when its shares
// of that are summed. A point with n cells: each share of mass takes 2 roundings, their sum n - 1: mass n + 1, and d.
// An edge with m cells: stiffness and damping are a product or a sum of m equal terms: m. Both have positive terms, so
// nothing cancels.
//
// One spring. d = xb - xa is 1 per coordinate, its square 3, the sum of three 5, the root 2.5 + 1: length l is 4, and
// so is the rest length L. The elongation l - L cancels, so its error is absolute: gamma_4 (l + L) from the operands
// and 1 rounding of the result, gamma_5 (l + L) in all. Variants that write k l - k L, or k (1 - L / l) d, have up to
// 5 roundings more on l and on L: gamma_12 (l + L) covers them, and products with other gammas of its order.
// The direction d / l is 6 per coordinate, 7 through a reciprocal. dv . u: 1 for dv, 7 for u, 1 for the product, 2 for
// the sum: 11 times sum |dv_k u_k| <= |dv|, and 12 for other orders. So the tension k (l - L) + c dv . u has the error
//
//     gamma_12 k (l + L)  +  gamma_{m+3} k |l - L|  +  gamma_{m+14} c |dv|
//
// (m for k and c, a product, the final sum), and multiplying it by the direction adds 8 to each relative part:
//
//     E = gamma_13 k (l + L)  +  gamma_{m+12} k |l - L|  +  gamma_{m+23} c |dv|          with direction |u| = 1.
//
// The sum of a point with p springs, one drag term and in some codes the weight takes at most p + 2 additions in any
// order: gamma_{p+2} times the sum of the absolute values. Vectors: |e_k| <= g |f_k| in every coordinate gives
// |e| <= g |f|, so Euclidean lengths suffice. The drag viscosity m v has n + 1 from the mass, 2 products. Left out are
// products of two gammas and the rounding of this computation itself, both below 1e-10 of the
// bound; `slack` covers them.

#include "reference/summation_bound.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/plain/error.h"
#include "core/plain/nan_maximum.h"
#include "reference/exact_measure.h"
#include "reference/rebuild.h"

namespace dartboard::reference {
namespace {

using Vectors = std::vector<Eigen::Vector3d>;

constexpr double slack = 1.001;
constexpr double infinity = std::numeric_limits<double>::infinity();

double gamma(std::size_t n) {
  constexpr double u = 0x1p-53;
  return static_cast<double>(n) * u / (1.0 - static_cast<double>(n) * u);
}

struct Body {
  const Problem& problem;
  Rebuilt rebuilt;
  std::vector<std::size_t> cells, springs;  // around each point
  std::vector<char> fixed;
  std::vector<double> mass_rounding;  // d of each point, from the measures of its cells

  explicit Body(const Problem& p)
      : problem(p),
        rebuilt(rebuild(p.mesh, p.material)),
        cells(p.mesh.points.size()),
        springs(p.mesh.points.size()),
        fixed(p.mesh.points.size()),
        mass_rounding(p.mesh.points.size()) {
    // such springs are products and sums of other numbers, whose rounding is not in the bound
    if (p.material.young > 0.0) throw InputError("a bound for a material with a Young's modulus; expected a stiffness");
    for (std::size_t c = 0; c < p.mesh.cell_count(); ++c)
      for (const std::uint32_t node : p.mesh.cell(c)) {
        ++cells[node];
        mass_rounding[node] += p.material.density * measure_rounding(p.mesh, c) /
                               static_cast<double>(p.mesh.cell(c).size()) / rebuilt.mass[node];
      }
    for (const Spring& s : rebuilt.springs) {
      ++springs[s.a];
      ++springs[s.b];
    }
    for (std::uint32_t i : p.fixed) {
      if (i >= fixed.size()) throw InputError(fmt::format("fixed point {} does not exist", i));
      fixed[i] = 1;
    }
  }

  // The state that an implementation starts from: in it fixed points do not move.
  PointState held(PointState state) const {
    if (state.x.size() != fixed.size() || state.v.size() != fixed.size())
      throw InputError(fmt::format("a state of {} positions and {} velocities for {} points", state.x.size(),
                                   state.v.size(), fixed.size()));
    for (std::size_t i = 0; i < fixed.size(); ++i)
      if (fixed[i]) state.v[i].setZero();
    return state;
  }
};

// The forces of the springs on a point.
struct Pull {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  double magnitude = 0.0;                       // sum of |f_ij|
  double error = 0.0;                           // sum of E_ij
  double by_position = 0.0, by_velocity = 0.0;  // the largest change of `force` per change of all x, of all v
};

// All pulls in a state of which x is known up to ex and v up to ev; false when that does not bound how they depend on
// the state. The derivative of a spring's force by d is k (u u' + (1 - L / l) (1 - u u')) plus that of the damping:
// the norm of the first is k max(1, |1 - L / l|), the norm of the second c |dv| / l. By dv it is c u u'.
bool pull_points(const Body& body, const Vectors& x, const Vectors& v, double ex, double ev, std::vector<Pull>& pulls) {
  pulls.assign(x.size(), {});
  for (std::size_t e = 0; e < body.rebuilt.springs.size(); ++e) {
    const Spring& s = body.rebuilt.springs[e];
    const std::size_t m = body.rebuilt.cells[e];
    const Eigen::Vector3d d = x[s.b] - x[s.a], dv = v[s.b] - v[s.a];
    const double l = d.norm(), L = s.rest_length, speed = dv.norm();

    // both ends of two runs that are each within ex of the exact one: 2 x 2 ex
    const double shortest = l - 4.0 * ex;
    const bool known = 4.0 * ex <= 1e-4 * l && l > 0.0;  // also false for NaN
    if (!known && ex > 0.0) return false;
    if (l == 0.0) continue;  // exactly zero in every implementation

    const Eigen::Vector3d u = d / l;
    const Eigen::Vector3d f = (s.stiffness * (l - L) + s.damping * dv.dot(u)) * u;
    const double error = gamma(13) * s.stiffness * (l + L) + gamma(m + 12) * s.stiffness * std::abs(l - L) +
                         gamma(m + 23) * s.damping * speed;
    const double by_position =
        s.stiffness * std::max(1.0, std::abs(1.0 - L / shortest)) + s.damping * (speed + 4.0 * ev) / shortest;

    // a fixed end does not differ between runs; two free ends may move apart
    const double ends = body.fixed[s.a] || body.fixed[s.b] ? 1.0 : 2.0;
    for (std::uint32_t end : {s.a, s.b}) {
      Pull& p = pulls[end];
      p.force += end == s.a ? f : Eigen::Vector3d(-f);
      p.magnitude += f.norm();
      p.error += error;
      p.by_position += ends * by_position;
      p.by_velocity += ends * s.damping;
    }
  }
  return true;
}

}  // namespace

std::vector<double> force_bound(const Problem& problem, const PointState& state) {
  const Body body(problem);
  const auto [x, v] = body.held(state);
  std::vector<Pull> pulls;
  pull_points(body, x, v, 0.0, 0.0, pulls);

  std::vector<double> bound;
  for (std::size_t i = 0; i < pulls.size(); ++i) {
    const double drag = problem.material.viscosity * body.rebuilt.mass[i] * v[i].norm();
    const double one = pulls[i].error + gamma(body.springs[i] + 2) * pulls[i].magnitude +
                       (gamma(body.cells[i] + body.springs[i] + 5) + body.mass_rounding[i]) * drag;
    bound.push_back(2.0 * slack * one);
  }
  return bound;
}

// States. Let X, V bound the distance of a computed run from the run in exact arithmetic, over all points, and let the
// accelerations have the Lipschitz constants P by positions and Q by velocities. Stage s is computed from stage s - 1
// as x + c h v_s-1, v + c h a_s-1, so its distance is at most
//
//     X_s = X + c h V_s-1 + (rounding of the stage),   V_s = V + c h A_s-1 + (rounding),   A_s = P X_s + Q V_s + eps_s
//
// and the step adds h/6 (1 2 2 1) of the V_s and A_s. It is Groenwall's inequality with the matrix (0 1; P Q) in place
// of one constant, which keeps metres and metres per second apart; its spectral radius without damping is sqrt(P), the
// frequency that Gershgorin's discs give. P and Q are taken at each stage from the run computed here, for all states
// within the tube of 2 X_s (X_s for this run, X_s for another), hence the 4 X_s per spring in pull_points.
//
// eps is the error of the acceleration: that of the force and mass, d and n + 1 more for the mass and 2 for the
// division or reciprocal, and 2 for the sums with drag and gravity. Drag divided by mass has the most roundings: n + 3
// + (p + 2) + n + 3 + 2 = 2 n + p + 10, taken for all terms but E.
//
// A stage rounds twice per coordinate on the product and once on the sum: u |x_s| + gamma_2 c h |v|. The last sum takes
// gamma_8 of its terms, and one rounding of x when the terms are summed first, four when added to x one by one.
StateBound state_bound(const Problem& problem, const PointState& start, int steps) {
  const Body body(problem);
  auto [x, v] = body.held(start);
  const std::size_t n = start.x.size();
  const double h = problem.h, viscosity = problem.material.viscosity;
  const Eigen::Vector3d gravity = problem.surroundings.gravity;

  const auto largest = [&body, n](const Vectors& w) {
    double most = 0.0;
    for (std::size_t i = 0; i < n; ++i)
      if (!body.fixed[i]) most = max_or_nan(most, w[i].norm());
    return most;
  };

  constexpr double reach[4] = {0.5, 0.5, 1.0, 0.0}, weight[4] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
  double X = 0.0, V = 0.0;
  std::vector<Pull> pulls;
  Vectors xs, vs, a(n), dx(n), dv(n);
  for (int step = 0; step < steps; ++step) {
    xs = x;
    vs = v;
    std::fill(dx.begin(), dx.end(), Eigen::Vector3d::Zero());
    dv = dx;
    double Xs = X, Vs = V;                  // of the stage
    double growth_x = 0.0, growth_v = 0.0;  // of the step
    double travel_x = 0.0, travel_v = 0.0;  // sizes of its terms
    for (int s = 0; s < 4; ++s) {
      if (!pull_points(body, xs, vs, Xs, Vs, pulls)) return {infinity, infinity};
      double A = 0.0;
      for (std::size_t i = 0; i < n; ++i) {
        a[i].setZero();
        if (body.fixed[i]) continue;
        const Pull& p = pulls[i];
        const double mass = body.rebuilt.mass[i];
        a[i] = p.force / mass - viscosity * vs[i] + gravity;
        const double eps = p.error / mass +
                           2.0 * body.mass_rounding[i] * (p.force.norm() / mass + viscosity * vs[i].norm()) +
                           gamma(2 * body.cells[i] + body.springs[i] + 10) *
                               (p.magnitude / mass + viscosity * vs[i].norm() + gravity.norm());
        A = max_or_nan(A, slack * (p.by_position / mass * Xs + (p.by_velocity / mass + viscosity) * Vs + eps));
      }
      if (!std::isfinite(A)) return {infinity, infinity};

      const double speed = largest(vs), pace = largest(a), w = h * weight[s], to = h * reach[s];
      growth_x += w * Vs;
      growth_v += w * A;
      travel_x += w * speed;
      travel_v += w * pace;
      for (std::size_t i = 0; i < n; ++i) {
        dx[i] += w * vs[i];
        dv[i] += w * a[i];
      }
      if (s == 3) break;
      for (std::size_t i = 0; i < n; ++i) {
        if (body.fixed[i]) continue;
        xs[i] = x[i] + to * vs[i];
        vs[i] = v[i] + to * a[i];
      }
      Xs = X + to * Vs + slack * (gamma(1) * largest(xs) + gamma(2) * to * speed);
      Vs = V + to * A + slack * (gamma(1) * largest(vs) + gamma(2) * to * pace);
    }
    X += growth_x + slack * (gamma(8) * travel_x + gamma(4) * (largest(x) + travel_x));
    V += growth_v + slack * (gamma(8) * travel_v + gamma(4) * (largest(v) + travel_v));
    for (std::size_t i = 0; i < n; ++i) {
      if (body.fixed[i]) continue;
      x[i] += dx[i];
      v[i] += dv[i];
    }
  }
  if (!std::isfinite(X) || !std::isfinite(V)) return {infinity, infinity};
  return {2.0 * slack * X, 2.0 * slack * V};
}

}  // namespace dartboard::reference
