#include "core/elements/attachments.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/bodies/term_checks_for_tests.h"

namespace dartboard::attachments_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Vertices 0 to 2 at points of a tetrahedron, of another beyond its side, and of a triangle, whose corners are shared.
const std::vector<AttachedVertex> to_cells{
    {.count = 5, .nodes = {0, 3, 4, 5, 6}, .weight = {0.125, 0.25, 0.5, 0.125}, .per_mass = 30},
    {.count = 5, .nodes = {1, 4, 5, 6, 7}, .weight = {-0.5, 0.75, 0.5, 0.25}, .per_mass = 20},
    {.count = 4, .nodes = {2, 3, 5, 7}, .weight = {0.3, 0.3, 0.4}, .per_mass = 50},
    {.count = 4, .nodes = {2, 4, 6, 7}, .weight = {1.5, -0.25, -0.25}, .per_mass = 10}};
const std::vector<AttachedVertex> to_places{{.nodes = {1}, .place = {0.5, -0.25, 2}, .per_mass = 30},
                                            {.nodes = {6}, .place = {-1, 0.5, 0.25}, .per_mass = 7}};
const std::vector<double> mass{2, 0.5, 0.25, 1, 1, 1, 3, 1};

std::vector<Vector3d> places() {
  SplitMix64 random(3);
  std::vector<Vector3d> x(mass.size());
  for (Vector3d& p : x)
    for (double& c : p) c = 0.5 * random.next_signed();
  return x;
}

/// By vertex, the slope of the stretch of a spring.
std::vector<double> slopes(const AttachedVertex& row) {
  std::vector<double> slope(mass.size(), 0.0);
  slope[row.nodes[0]] = 1.0;
  for (std::size_t a = 1; a < row.count; ++a) slope[row.nodes[a]] -= row.weight[a - 1];
  return slope;
}

TEST(Attachments, PullAlongTheSlopeOfTheirEnergyAndStiffenAsThatDoes) {
  expect_consistent(*make_attachments(to_cells, mass), places(), 0.1);
}

// The energy is that of |S x - p|^2 k / 2 with a row of S for each spring: everything else follows from it.
TEST(Attachments, AreTheSquaresOfTheirStretches) {
  std::vector<AttachedVertex> rows = to_cells;
  rows.insert(rows.end(), to_places.begin(), to_places.end());
  const auto term = make_attachments(rows, mass);
  const std::vector<Vector3d> x = places(), w = moved(places(), places(), -3.0);
  double energy = 0.0, size = 0.0, power = 0.0;
  std::vector<Vector3d> force(x.size(), Vector3d(0, 0, 0)), product = force;
  for (const AttachedVertex& row : rows) {
    const std::vector<double> slope = slopes(row);
    Vector3d stretch = -row.place, rate(0, 0, 0);
    for (std::size_t i = 0; i < x.size(); ++i) {
      stretch += slope[i] * x[i];
      rate += slope[i] * w[i];
    }
    EXPECT_LT((x[row.nodes[0]] - place_of(row, x) - stretch).norm(), 1e-14);
    const double k = row.per_mass * mass[row.nodes[0]];
    energy += 0.5 * k * stretch.squaredNorm();
    power -= k * stretch.dot(rate);
    size += k * (1.0 + stretch.norm()) * (1.0 + rate.norm());
    for (std::size_t i = 0; i < x.size(); ++i) {
      force[i] -= slope[i] * k * stretch;
      product[i] += slope[i] * k * rate;
    }
  }
  const auto found = forces_of(*term, x);
  EXPECT_NEAR(term->energy(x), energy, 1e-14 * size);
  EXPECT_NEAR(term->power(std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5}, x, w), power, 1e-14 * size);
  for (const auto compression : {Compression::exact, Compression::projected}) {
    const auto stiff = product_of(*term, x, w, compression);
    for (std::size_t i = 0; i < x.size(); ++i) {
      EXPECT_LE((found[i] - force[i]).norm(), 1e-14 * size);
      EXPECT_LE((stiff[i] - product[i]).norm(), 1e-14 * size);
    }
  }
  std::vector<double> sizes(x.size(), 0.0);
  term->add_force_sizes({x, w, 0.5}, sizes);
  std::vector<Vector3d> there(x.size(), Vector3d(0, 0, 0));
  term->add_forces({x, w, 0.5}, there);
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_GE(sizes[i] * (1 + 1e-14), there[i].norm());
  const EnergyChange change = term->energy_change({x, w, 0.25}, w, 0.5);
  EXPECT_NEAR(change.value, term->energy(moved(x, w, 0.75)) - term->energy(moved(x, w, 0.25)), 1e-13 * size);
  EXPECT_TRUE(term->virial(x, 0).tensor.isZero(0.0));
  EXPECT_FALSE(term->is_within_cells());
}

// A millionth of a millionth of the coordinates: a difference of energies would have no digit.
TEST(Attachments, KeepTheDigitsOfSmallMotions) {
  const auto term = make_attachments(to_cells, mass);
  std::vector<Vector3d> x = places();
  for (Vector3d& p : x) p += Vector3d(64, -32, 128);
  const std::vector<Vector3d> w = places();
  const double t = 0x1p-40, work = -t * dot(forces_of(*term, x), w);
  EXPECT_NEAR(term->energy_change({x}, w, t).value, work, 1e-11 * std::abs(work));
}

}  // namespace
}  // namespace dartboard::attachments_test
