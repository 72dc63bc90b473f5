// A user's own force, written in the obvious way: implicit steps converge although the change of its energy is a
// difference of two energies, which is all rounding close to a solution.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/mechanics/mass_spring_body.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/time/integrators.h"
#include "core/views/views.h"

namespace dartboard::own_force_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Pushes vertices below z = 0 upwards, in proportion to their depth.
class Floor final : public ForceTerm {
 public:
  Floor(std::size_t vertices, double stiffness) : stiffness_(stiffness) {
    for (std::uint32_t i = 0; i < vertices; ++i) vertices_.push_back(i);
  }
  std::string_view pieces_name() const override { return "feet"; }
  std::size_t size() const override { return vertices_.size(); }
  Nodes nodes(std::size_t piece) const override { return {&vertices_[piece], 1}; }

  void add_forces(const StagePlaces& at, std::span<Vector3d> force) const override {
    for (const std::uint32_t i : vertices_) force[i].z() -= stiffness_ * std::min(0.0, height(at, i));
  }
  void add_discrete_forces(const StagePlaces& at, std::span<Vector3d> force) const override { add_forces(at, force); }
  void add_force_sizes(const StagePlaces& at, std::span<double> size) const override {
    for (const std::uint32_t i : vertices_) size[i] += stiffness_ * std::abs(height(at, i));
  }
  double energy(std::span<const Vector3d> x, std::size_t first, std::size_t stride) const override {
    double sum = 0.0;
    for (std::size_t i = first; i < size(); i += stride) sum += energy_at(x[i].z());
    return sum;
  }
  EnergyChange energy_change(const StagePlaces& at, std::span<const Vector3d> step, double scale) const override {
    EnergyChange change;
    for (const std::uint32_t i : vertices_)
      change.value += energy_at(height(at, i) + scale * step[i].z()) - energy_at(height(at, i));
    return change;
  }
  double power(std::span<const std::uint32_t> pieces, std::span<const Vector3d> x,
               std::span<const Vector3d> w) const override {
    double sum = 0.0;
    for (const std::uint32_t i : pieces) sum -= stiffness_ * std::min(0.0, x[i].z()) * w[i].z();
    return sum;
  }
  void for_each_tangent(const StagePlaces& at, Compression, const VisitTangent& visit) const override {
    for (const std::uint32_t i : vertices_) {
      Matrix3d block = Matrix3d::Zero();
      if (height(at, i) < 0.0) block(2, 2) = stiffness_;
      visit(nodes(i), {&block, 1});
    }
  }
  void for_each_constant_tangent(const VisitTangent& visit) const override {
    const Matrix3d block = stiffness_ * Matrix3d::Identity();
    for (const std::uint32_t i : vertices_) visit(nodes(i), {&block, 1});
  }
  Virial virial(std::span<const Vector3d>, std::size_t) const override { return {}; }

 private:
  static double height(const StagePlaces& at, std::uint32_t i) {
    return at.x[i].z() + (at.w.empty() ? 0.0 : at.t * at.w[i].z());
  }
  double energy_at(double z) const { return z < 0.0 ? 0.5 * stiffness_ * z * z : 0.0; }

  std::vector<std::uint32_t> vertices_;
  double stiffness_;
};

TEST(OwnForce, IsSteppedByImplicitMethodsUntilTheBodyHasLanded) {
  for (const char* integrator : {"local-global", "backward-euler", "implicit-midpoint", "bdf2", "sdirk2"})
    for (const double stiffness : {1e2, 1e4})
      for (const double h : {0.0005, 0.002}) {
        Problem problem;
        problem.mesh = kuhn_box(3, 3, 3, 0.05);
        for (Vector3d& x : problem.mesh.points) x.z() += 0.02;
        problem.material = {.density = 1000, .stiffness = 200, .damping = 0.5, .viscosity = 1};
        auto body = build_body<TetMap, Held::by_every_dart>(problem);
        Views views;
        views.rebuild(body);
        VertexColumns& v = body.vertices;
        const Floor floor(v.size(), stiffness);
        const ForceTerm* terms[] = {&floor};
        SpringSystem system{};
        system.ends = views.ends.ends;
        system.springs = body.springs;
        system.mass = v.mass;
        system.inverse_mass = v.inverse_mass;
        system.viscosity = v.viscosity;
        system.fixed = v.fixed;
        system.gravity = {0, 0, -9.81};
        system.terms = terms;
        const auto method = make_integrator(integrator);
        StepResult result;
        for (double t = 0.0; t < 0.2 && result.ok(); t += h) result = method->step(system, {v.position, v.velocity}, h);
        EXPECT_TRUE(result.ok()) << integrator << " " << stiffness << " " << h << ": " << to_string(result);
      }
}

}  // namespace
}  // namespace dartboard::own_force_test
