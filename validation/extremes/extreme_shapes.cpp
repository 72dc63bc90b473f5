// Axes along faults of a body: its shape, its vertices, its numbers.

#include <fmt/format.h>

#include <limits>

#include "core/plain/random.h"
#include "validation/extremes/extreme_matrix.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

void add_shapes(ExtremeMatrix& matrix) {
  const auto shape = [&matrix](const char* value, std::function<void(SpringColumns&)> deform) {
    for (const double theta : {0.2, 20.0})
      matrix.add(fmt::format("{}, h omega {:g}", value, theta), extreme_solids,
                 [deform, theta](std::string_view scene) {
                   SpringColumns body = moving_body(scene, 1e-3);
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
  shape("collapsed to a line", squash(1, 0, 0));
  shape("collapsed to a point", squash(0, 0, 0));
  shape("a sliver of 1e-12", squash(1, 1, 1e-12));
  shape("mirrored", squash(-1, 1, 1));
  shape("inflated tenfold", squash(10, 10, 10));
  shape("one vertex pushed through", [](SpringColumns& b) { b.x[0] = 2 * b.x[b.x.size() / 2] - b.x[0]; });
  shape("tangled", [](SpringColumns& b) {
    SplitMix64 random(3);
    for (Vector3d& p : b.x)
      for (double& c : p) c = 2 * random.next_signed();
  });
  shape("two vertices in one place", [](SpringColumns& b) { b.x[b.ends[0][1]] = b.x[b.ends[0][0]]; });
  shape("a spring of rest length 0", [](SpringColumns& b) { b.springs[0].rest_length = 0.0; });
  shape("springs of stiffness 0", [](SpringColumns& b) {
    for (std::size_t s = 0; s < b.springs.size(); s += 2) b.springs[s].stiffness = 0.0;
  });
  shape("an edge of 1e-9", [](SpringColumns& b) { b.x[b.ends[0][1]] = b.x[b.ends[0][0]] + Vector3d(1e-9, 0, 0); });
}

void add_vertices(ExtremeMatrix& matrix) {
  const auto at = [&matrix](const char* value, std::function<void(SpringColumns&)> change) {
    matrix.add(value, extreme_solids, [change](std::string_view scene) {
      SpringColumns body = moving_body(scene);
      const double omega = highest_frequency(body);
      change(body);
      return ExtremeSetup{.body = std::move(body), .h = 0.2 / omega, .compare = false};
    });
  };
  at("all held", [](SpringColumns& b) {
    b.fixed.assign(b.fixed.size(), 1);
    b.v.assign(b.v.size(), Vector3d::Zero());
  });
  at("half held", [](SpringColumns& b) {
    for (std::size_t i = 0; i < b.fixed.size(); i += 2) {
      b.fixed[i] = 1;
      b.v[i].setZero();
    }
  });
  at("one massless", [](SpringColumns& b) { b.set_mass(1, 0.0); });
  at("one held without mass", [](SpringColumns& b) {
    b.set_mass(1, 0.0);
    b.fixed[1] = 1;
    b.v[1].setZero();
  });
  at("negative mass", [](SpringColumns& b) { b.set_mass(2, -1.0); });
  at("no springs", [](SpringColumns& b) {
    b.ends.clear();
    b.springs.clear();
  });
  at("one spring", [](SpringColumns& b) {
    b.ends.resize(1);
    b.springs.resize(1);
  });
  at("nothing", [](SpringColumns& b) { b = {}; });
  at("one driven", [](SpringColumns& b) {
    b.fixed[0] = 1;
    b.v[0] = {0.1, 0, 0};
  });
  at("gravity", [](SpringColumns& b) { b.gravity = {0, 0, -9.81}; });
}

void add_denormals(ExtremeMatrix& matrix) {
  const auto at = [&matrix](const char* value, std::function<void(SpringColumns&)> change) {
    matrix.add(value, extreme_bodies, [change](std::string_view scene) {
      SpringColumns body = moving_body(scene);
      const double omega = highest_frequency(body);
      change(body);
      return ExtremeSetup{.body = std::move(body), .h = 0.2 / omega, .compare = false};
    });
  };
  at("stiffness", [](SpringColumns& b) {
    for (Spring& s : b.springs) s.stiffness = 1e-310;
  });
  at("velocity", [](SpringColumns& b) {
    b = extreme_body(b.x.size() == 2 ? "oscillator" : "box");
    for (Vector3d& v : b.v) v = {1e-310, 0, 0};
  });
  at("mass", [](SpringColumns& b) { b.set_mass(1, 1e-310); });
  at("one spring", [](SpringColumns& b) { b.springs[0].stiffness = 5e-324; });
}

void add_bad_numbers(ExtremeMatrix& matrix, bool injected) {
  struct Place {
    const char* name;
    void (*put)(SpringColumns&, double);
    bool of_system = true;
  };
  static constexpr Place places[]{
      {"position", [](SpringColumns& b, double bad) { b.x[3][1] = bad; }, false},
      {"velocity", [](SpringColumns& b, double bad) { b.v[3][1] = bad; }, false},
      {"stiffness", [](SpringColumns& b, double bad) { b.springs[4].stiffness = bad; }},
      {"rest length", [](SpringColumns& b, double bad) { b.springs[4].rest_length = bad; }},
      {"mass",
       [](SpringColumns& b, double bad) {
         b.mass[3] = bad;
         b.inverse_mass[3] = 1.0 / bad;
       }},
      {"gravity", [](SpringColumns& b, double bad) { b.gravity[2] = bad; }},
      {"damping", [](SpringColumns& b, double bad) { b.springs[4].damping = bad; }},
      {"viscosity", [](SpringColumns& b, double bad) { b.viscosity[3] = bad; }},
  };
  for (const Place& place : places)
    for (const double bad : {nan, infinity, -infinity})
      matrix.add(fmt::format("{} in {}", bad, place.name), extreme_solids,
                 [place, bad, injected](std::string_view scene) {
                   ExtremeSetup setup = with_theta(moving_body(scene), 0.2);
                   setup.compare = false;
                   setup.announced = place.of_system;
                   if (injected)
                     setup.halfway = [place, bad](SpringColumns& body) { place.put(body, bad); };
                   else
                     place.put(setup.body, bad);
                   return setup;
                 });
}

}  // namespace dartboard
