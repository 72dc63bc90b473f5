#include "core/time/system/energy.h"

#include <Eigen/Geometry>

#include "core/forces/compensated_sum.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

struct CompensatedVector {
  CompensatedSum x, y, z;

  void add(const Vector3d& term) {
    x.add(term[0]);
    y.add(term[1]);
    z.add(term[2]);
  }
  Vector3d value() const { return {x.value(), y.value(), z.value()}; }
};

}  // namespace

double sum_of_squares(std::span<const Vector3d> v) {
  using Eight = Eigen::Array<double, 8, 1>;
  const double* data = v.empty() ? nullptr : v.data()->data();
  const std::size_t size = 3 * v.size();
  Eight squares = Eight::Zero();
  std::size_t i = 0;
  for (; i + 8 <= size; i += 8) squares += Eigen::Map<const Eight>(data + i).square();
  double sum = squares.sum();
  for (; i < size; ++i) sum += data[i] * data[i];
  return sum;
}

double kinetic_energy(const SpringSystem& system, std::span<const Vector3d> v) {
  CompensatedSum twice;
  for (std::size_t i = 0; i < v.size(); ++i) twice.add(system.mass[i] * v[i].squaredNorm());
  return twice.value() / 2;
}

double elastic_energy(const SpringSystem& system, std::span<const Vector3d> x) {
  CompensatedSum twice;
  for (std::size_t s = 0; s < system.springs.size(); ++s) {
    const auto [i, j] = system.ends[s];
    const double stretch = (x[j] - x[i]).norm() - system.springs[s].rest_length;
    twice.add(system.springs[s].stiffness * stretch * stretch);
  }
  double sum = twice.value() / 2;
  for (const ForceTerm* term : system.terms) sum += term->energy(x);
  return sum;
}

double gravity_energy(const SpringSystem& system, std::span<const Vector3d> x) {
  CompensatedSum sum;
  for (std::size_t i = 0; i < x.size(); ++i) sum.add(-system.mass[i] * system.gravity.dot(x[i]));
  return sum.value();
}

double pull_energy(const SpringSystem& system, std::span<const Vector3d> x) {
  CompensatedSum sum;
  for (std::size_t i = 0; i < system.pull.size(); ++i) sum.add(-system.mass[i] * system.pull[i].dot(x[i]));
  return sum.value();
}

double total_energy(const SpringSystem& system, std::span<const Vector3d> x, std::span<const Vector3d> v) {
  return kinetic_energy(system, v) + elastic_energy(system, x) + gravity_energy(system, x) + pull_energy(system, x);
}

Vector3d linear_momentum(const SpringSystem& system, std::span<const Vector3d> v) {
  CompensatedVector sum;
  for (std::size_t i = 0; i < v.size(); ++i) sum.add(system.mass[i] * v[i]);
  return sum.value();
}

Vector3d angular_momentum(const SpringSystem& system, std::span<const Vector3d> x, std::span<const Vector3d> v,
                          const Vector3d& centre) {
  CompensatedVector sum;
  for (std::size_t i = 0; i < v.size(); ++i) sum.add(system.mass[i] * (x[i] - centre).cross(v[i]));
  return sum.value();
}

}  // namespace dartboard
