// Axes along numbers: steps, spreads, damping, offsets, velocities, lengths of runs.

#include <fmt/format.h>

#include <cmath>
#include <initializer_list>

#include "validation/extremes/extreme_matrix.h"

namespace dartboard {

using Eigen::Vector3d;

void add_numbers(ExtremeMatrix& matrix, std::string_view axis) {
  const auto each = [&matrix](std::initializer_list<double> values, auto make) {
    for (const double value : values)
      matrix.add(fmt::format("{:g}", value), extreme_bodies,
                 [value, make](std::string_view scene) { return make(scene, value); });
  };
  if (axis == "step")
    each({1e-6, 1e-4, 1e-2, 0.1, 0.5, 0.9, 1.5, 1.9, 2.1, 2.5, 3, 4, 6, 10, 30, 1e2, 1e3, 1e4, 1e6, 1e8},
         [](std::string_view scene, double theta) { return with_theta(moving_body(scene), theta); });
  if (axis == "stiffness")
    for (const double theta : {0.4, 40.0})
      for (const double spread : {1.0, 1e4, 1e8, 1e12, 1e14})
        matrix.add(fmt::format("{:g}, h omega {:g}", spread, theta), extreme_bodies,
                   [spread, theta](std::string_view scene) {
                     SpringColumns body = extreme_body(scene);
                     const auto count = static_cast<double>(body.springs.size());
                     for (std::size_t s = 0; s < body.springs.size(); ++s)
                       body.springs[s].stiffness *= std::pow(spread, static_cast<double>(s) / count);
                     set_moving(body, 1e-3, highest_frequency(body) / 4);
                     return with_theta(std::move(body), theta);
                   });
  if (axis == "mass")
    for (const double theta : {0.4, 40.0})
      for (const double spread : {1.0, 1e3, 1e6, 1e9, 1e12})
        matrix.add(
            fmt::format("{:g}, h omega {:g}", spread, theta), extreme_bodies, [spread, theta](std::string_view scene) {
              SpringColumns body = extreme_body(scene);
              for (std::size_t i = 0; i < body.mass.size(); ++i)
                body.set_mass(i, std::pow(spread, static_cast<double>(i) / static_cast<double>(body.mass.size())));
              // each vertex no faster than its own frequency allows
              set_moving(body, 1e-3, 0.0);
              return with_theta(std::move(body), theta);
            });
  // all masses and springs times one number: the same motion, though squares of forces under- or overflow
  if (axis == "mass")
    for (const int exponent : {-600, 600})
      for (const double theta : {0.4, 40.0})
        matrix.add(fmt::format("all times 2^{}, h omega {:g}", exponent, theta), extreme_bodies,
                   [exponent, theta](std::string_view scene) {
                     SpringColumns body = moving_body(scene);
                     for (std::size_t i = 0; i < body.mass.size(); ++i)
                       body.set_mass(i, std::ldexp(body.mass[i], exponent));
                     for (Spring& s : body.springs) s.stiffness = std::ldexp(s.stiffness, exponent);
                     return with_theta(std::move(body), theta);
                   });
  if (axis == "damping")
    for (const double theta : {0.1, 5.0})
      for (const double zeta : {0.0, 0.05, 0.5, 1.0, 10.0, 1e3})
        matrix.add(fmt::format("{:g}, h omega {:g}", zeta, theta), extreme_bodies,
                   [zeta, theta](std::string_view scene) {
                     SpringColumns body = moving_body(scene);
                     const double omega = highest_frequency(body);
                     for (Spring& s : body.springs) s.damping = 2 * zeta / omega * s.stiffness;
                     return with_theta(std::move(body), theta);
                   });
  if (axis == "offset")
    each({1e1, 1e3, 1e6, 1e9, 1e12}, [](std::string_view scene, double offset) {
      SpringColumns body = moving_body(scene);
      const double omega = highest_frequency(body);
      ExtremeSetup setup{.body = std::move(body), .h = 0.3 / omega, .offset = offset};
      setup.at_origin = setup.body.x;
      for (Vector3d& p : setup.body.x) p[0] += offset;
      return setup;
    });
  if (axis == "velocity")
    each({1e0, 1e2, 1e4, 1e6, 1e8}, [](std::string_view scene, double speed) {
      SpringColumns body = moving_body(scene);
      const double omega = highest_frequency(body);
      set_moving(body, speed / omega, omega);
      // a body torn that far apart bends more than the bound of an order allows for
      return ExtremeSetup{.body = std::move(body), .h = 0.1 / omega, .compare = false};
    });
  if (axis == "absolute")
    each({1e-18, 1e-15, 1e-12, 1e-6, 1.0, 1e3, 1e6},
         [](std::string_view scene, double h) { return ExtremeSetup{.body = moving_body(scene), .h = h}; });
  if (axis == "long")
    each({1e3, 1e4, 1e5}, [](std::string_view scene, double steps) {
      ExtremeSetup setup = with_theta(moving_body(scene), 0.2, static_cast<std::uint64_t>(steps));
      setup.compare = false;
      return setup;
    });
}

}  // namespace dartboard
