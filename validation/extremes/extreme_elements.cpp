// Axis of elastic solids: laws, Poisson's ratios, stiffness within a body, and shapes at the limits of laws.

#include <fmt/format.h>

#include <cmath>

#include "core/plain/random.h"
#include "validation/extremes/extreme_matrix.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

/// An elastic body with the damping ratio `zeta` at its highest frequency.
SpringColumns damped_body(std::string_view scene, Model model, double zeta) {
  Material material = elastic_material(model);
  material.damping_time = 2 * zeta / highest_frequency(elastic_body(scene, material));
  return elastic_body(scene, material);
}

}  // namespace

void add_elements(ExtremeMatrix& matrix) {
  for (const Model model : {Model::neo_hookean, Model::corotational, Model::stvk}) {
    const auto add = [&matrix, model](const std::string& what, auto make) {
      matrix.add(fmt::format("{}, {}", name(model), what), elastic_bodies, make);
    };
    for (const double theta : {0.1, 1.5, 2.5, 30.0, 1e4})
      add(fmt::format("h omega {:g}", theta), [model, theta](std::string_view scene) {
        return with_theta(in_motion(elastic_body(scene, elastic_material(model)), 0.01), theta);
      });
    for (const double poisson : {0.0, 0.45, 0.49, 0.499, 0.4999})
      for (const double theta : {0.3, 30.0})
        add(fmt::format("Poisson's ratio {:g}, h omega {:g}", poisson, theta),
            [model, poisson, theta](std::string_view scene) {
              return with_theta(in_motion(elastic_body(scene, elastic_material(model, poisson)), 1e-3), theta);
            });
    for (const double spread : {1e5, 1e10})
      for (const double theta : {0.3, 30.0})
        add(fmt::format("a stiffness {:g} times another, h omega {:g}", spread, theta),
            [model, spread, theta](std::string_view scene) {
              const Material soft = elastic_material(model), stiff = elastic_material(model, 0.3, 100.0 * spread);
              return with_theta(in_motion(elastic_body(scene, soft, stiff), 1e-3), theta);
            });
    for (const double zeta : {0.05, 0.7, 50.0})
      for (const double theta : {0.1, 1.0, 30.0})
        add(fmt::format("damping ratio {:g}, h omega {:g}", zeta, theta), [model, zeta, theta](std::string_view scene) {
          return with_theta(in_motion(damped_body(scene, model, zeta), 0.01), theta);
        });
    const auto shape = [&add, model](const char* value, std::function<void(SpringColumns&)> deform) {
      for (const double theta : {0.2, 20.0})
        add(fmt::format("{}, h omega {:g}", value, theta), [model, theta, deform](std::string_view scene) {
          SpringColumns body = in_motion(elastic_body(scene, elastic_material(model)), 1e-3);
          const double omega = highest_frequency(body);
          deform(body);
          return ExtremeSetup{.body = std::move(body), .h = theta / omega, .compare = false};
        });
    };
    const auto squash = [](double fx, double fy, double fz) {
      return [fx, fy, fz](SpringColumns& b) {
        for (Vector3d& p : b.x) p = {fx * p[0], fy * p[1], fz * p[2]};
      };
    };
    shape("flattened", squash(1, 1, 0));
    shape("a sliver of 1e-12", squash(1, 1, 1e-12));
    shape("collapsed to a line", squash(1, 0, 0));
    shape("collapsed to a point", squash(0, 0, 0));
    shape("mirrored", squash(-1, 1, 1));
    shape("inflated tenfold", squash(10, 10, 10));
    shape("one vertex pushed through", [](SpringColumns& b) { b.x[0] = 2 * b.x[b.x.size() / 2] - b.x[0]; });
    shape("tangled", [](SpringColumns& b) {
      SplitMix64 random(3);
      for (Vector3d& p : b.x)
        for (double& c : p) c = 2 * random.next_signed();
    });
    for (const double speed : {1.0, 1e3, 1e6})
      add(fmt::format("{:g} edges per second", speed), [model, speed](std::string_view scene) {
        SpringColumns body = elastic_body(scene, elastic_material(model));
        const double omega = highest_frequency(body);
        set_moving(body, speed / omega, omega);
        return ExtremeSetup{.body = std::move(body), .h = 0.1 / omega, .compare = false};
      });
    for (const double offset : {1e3, 1e6})
      add(fmt::format("{:g} edges from the origin", offset), [model, offset](std::string_view scene) {
        SpringColumns body = in_motion(elastic_body(scene, elastic_material(model)), 0.01);
        const double omega = highest_frequency(body);
        ExtremeSetup setup{.body = std::move(body), .h = 0.3 / omega, .offset = offset};
        setup.at_origin = setup.body.x;
        for (Vector3d& p : setup.body.x) p[0] += offset;
        return setup;
      });
  }
}

}  // namespace dartboard
