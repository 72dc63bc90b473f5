#include "validation/extremes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>

#include "core/mechanics/adapt.h"
#include "core/meshes/mesh_generators.h"
#include "core/operations/dissociate_all.h"
#include "core/operations/dissociate_face.h"
#include "core/operations/remove_volume.h"
#include "core/plain/error.h"
#include "core/plain/random.h"
#include "core/time/divergence.h"
#include "core/time/energy.h"
#include "core/time/integrators.h"
#include "core/time/preflight.h"
#include "core/time/stable_step.h"
#include "core/time/trial_state.h"
#include "core/views/spring_ends.h"
#include "validation/extreme_bodies.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

using TetBody = MassSpringBody<TetMap, Held::by_every_dart>;

SpringSystem system_of(const TetBody& body, const SpringEndsView& ends) {
  const VertexColumns& v = body.vertices;
  return {ends.ends, body.springs, v.mass, v.inverse_mass, v.viscosity, v.fixed, body.surroundings.gravity};
}

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr std::chrono::milliseconds budget{400};  // of a run; a step is not interrupted

constexpr std::array axes{
    ExtremeAxis{"step", "step times highest frequency"},
    ExtremeAxis{"stiffness", "spread of stiffness within a body"},
    ExtremeAxis{"mass", "spread of mass within a body"},
    ExtremeAxis{"damping", "damping ratio at the highest frequency"},
    ExtremeAxis{"offset", "distance from the origin, in edges"},
    ExtremeAxis{"shape", "flattened, collapsed, inverted and tangled bodies, springs without length or stiffness"},
    ExtremeAxis{"velocity", "edge lengths per second"},
    ExtremeAxis{"absolute", "step in seconds"},
    ExtremeAxis{"denormal", "numbers below the smallest normal one"},
    ExtremeAxis{"vertices", "massless, held and missing vertices"},
    ExtremeAxis{"input", "NaN and infinity in the input"},
    ExtremeAxis{"injected", "NaN and infinity that turn up in mid-run"},
    ExtremeAxis{"events", "dissociations and removals in every step"},
    ExtremeAxis{"long", "many steps"},
};

/// A run on columns, and what is done to it.
struct Setup {
  SpringColumns body;
  double h = 0.0;
  std::uint64_t steps = 100;
  std::function<void(SpringColumns&)> halfway{};  // in mid-run
  bool announced = false;                         // as a change of the system, which only the state need not be
  bool compare = true;                            // with a finer run
};

// What the outcome rests on is computed here, in extended precision and without the detector.
long double energy(const SpringColumns& body) {
  long double sum = 0;
  for (std::size_t i = 0; i < body.x.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const long double v = body.v[i][c];
      sum += 0.5L * static_cast<long double>(body.mass[i]) * v * v;
      sum -= static_cast<long double>(body.mass[i]) * body.gravity[c] * body.x[i][c];
    }
  }
  for (std::size_t s = 0; s < body.springs.size(); ++s) {
    long double square = 0;
    for (int c = 0; c < 3; ++c) {
      const long double d = static_cast<long double>(body.x[body.ends[s][1]][c]) - body.x[body.ends[s][0]][c];
      square += d * d;
    }
    const long double stretch = std::sqrt(square) - body.springs[s].rest_length;
    sum += 0.5L * static_cast<long double>(body.springs[s].stiffness) * stretch * stretch;
  }
  return sum;
}

double largest_coordinate(const std::vector<Vector3d>& x) {
  double largest = 0.0;
  for (const Vector3d& p : x) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  return largest;
}

bool finite(const SpringColumns& body) {
  for (std::size_t i = 0; i < body.x.size(); ++i)
    for (int c = 0; c < 3; ++c)
      if (!std::isfinite(body.x[i][c]) || !std::isfinite(body.v[i][c])) return false;
  return true;
}

// The largest distance from a run of Dormand and Prince's method in eighths of the step; nothing where that fails.
std::optional<double> distance_from_finer(const Setup& setup, const SpringColumns& start, const SpringColumns& end) {
  SpringColumns fine = start;
  const auto integrator = make_integrator("dormand-prince-54");
  for (std::uint64_t k = 0; k < 8 * setup.steps; ++k)
    if (!integrator->step(fine.system(), fine.motion(), setup.h / 8).ok()) return {};
  double distance = 0.0;
  for (std::size_t i = 0; i < fine.x.size(); ++i) distance = std::max(distance, (fine.x[i] - end.x[i]).norm());
  return distance;
}

/// The outcome of a run that ended without a diagnosis.
void judge(ExtremeCell& cell, const Setup& setup, const SpringColumns& start, const SpringColumns& end,
           const Scheme& scheme, const StableStep& limits) {
  cell.outcome = cell.warnings.empty() ? ExtremeOutcome::ok : ExtremeOutcome::degraded;
  if (!finite(end)) {
    cell.outcome = ExtremeOutcome::silent;
    cell.note = "the state is not finite";
    return;
  }
  const long double before = energy(start), after = energy(end);
  double rounding = 0.0, size = largest_coordinate(start.x);
  for (const Spring& s : start.springs) rounding += s.stiffness * std::pow(64 * epsilon * (size + s.rest_length), 2);
  // between two checks an unstable step that was warned of may grow past the detector's bound
  const bool warned = std::ranges::find(cell.warnings, to_string(StepCode::unstable_step)) != cell.warnings.end();
  if (!(after <= (warned ? 1e6 : 200.0) * (before + rounding))) {
    cell.note =
        fmt::format("energy has grown from {:.3g} to {:.3g}", static_cast<double>(before), static_cast<double>(after));
    cell.outcome = ExtremeOutcome::silent;
    return;
  }
  const double theta = setup.h * limits.upper, zeta = limits.damping_ratio().upper;
  if (!setup.compare || theta * (1 + 2 * zeta) > 0.5 || !cell.warnings.empty()) return;
  const auto distance = distance_from_finer(setup, start, end);
  if (!distance) return;
  const auto steps = static_cast<double>(setup.steps);
  double amplitude = 0.0;
  for (std::size_t i = 0; i < start.x.size(); ++i)
    amplitude = std::max(amplitude, start.v[i].norm() / std::max(limits.lower, 1e-300));
  for (std::size_t s = 0; s < start.springs.size(); ++s)
    amplitude = std::max(amplitude, std::abs((start.x[start.ends[s][1]] - start.x[start.ends[s][0]]).norm() -
                                             start.springs[s].rest_length));
  // of order p: theta^p at once and theta^(p+1) per step, with constants below 8; explicit Euler also grows
  const double order = std::pow(theta * (1 + 2 * zeta), scheme.order);
  const double growth = scheme.name == "explicit-euler" ? std::exp(theta * theta * steps) : 1.0;
  const double bound = 8 * amplitude * order * (1 + steps * theta) * growth +
                       // rounding of positions, which forces turn into velocities
                       64 * epsilon * (size + amplitude * steps * theta) * (1 + steps * theta) +
                       1e-9 * amplitude * steps;  // what implicit methods leave of their equations
  if (*distance <= bound) return;
  cell.outcome = ExtremeOutcome::silent;
  cell.note = fmt::format("{:.3g} m from a finer run; the bound is {:.3g}", *distance, bound);
}

ExtremeCell run(const ExtremeCase& which, Setup setup) {
  ExtremeCell cell{which.axis, which.scene, which.integrator, which.value, ExtremeOutcome::ok, {}, 0, {}, ""};
  SpringColumns body = setup.body;
  const auto integrator = make_integrator(which.integrator);
  const Scheme& scheme = integrator->scheme();
  StableStepEstimate estimate;
  const Horizon horizon{.steps = static_cast<double>(setup.steps), .gain = 2.0};
  const StableStep limits = estimate.refresh(body.system(), body.x);
  const Preflight preflight = check_before_run(body.system(), body.motion(), scheme, setup.h, limits, horizon);
  for (const StepResult& warning : preflight.warnings) cell.warnings.emplace_back(to_string(warning.code));
  const auto diagnosed = [&cell](const StepResult& result) {
    cell.outcome = ExtremeOutcome::diagnosed;
    cell.diagnosis = result;
  };
  if (!preflight.refused.ok()) {
    diagnosed(preflight.refused);
    return cell;
  }
  if (!preflight.warnings.empty()) cell.diagnosis = preflight.warnings.front();
  DivergenceDetector detector;
  StepResult result = detector.start(body.system(), body.motion(), setup.h);
  const auto deadline = std::chrono::steady_clock::now() + budget;
  for (; cell.step < setup.steps && result.ok(); ++cell.step) {
    if (setup.halfway && cell.step == setup.steps / 2) {
      setup.halfway(body);
      integrator->restart();
      if (setup.announced) result = detector.system_changed(body.system(), body.motion());
      if (!result.ok()) break;
    }
    result = integrator->step(body.system(), body.motion(), setup.h);
    result = result.ok() ? detector.after_step(body.system(), body.motion())
                         : detector.with_witness(result, body.system(), body.motion());
    if (result.ok() && cell.step % 16 == 15 && std::chrono::steady_clock::now() > deadline)
      result = {StepCode::budget, Witness::none, 0, "steps", static_cast<double>(cell.step)};
  }
  if (result.ok()) result = detector.check_all(body.system(), body.motion());
  if (!result.ok()) {
    diagnosed(result);
    detector.restore(body.motion());
    if (!finite(body)) {
      cell.outcome = ExtremeOutcome::silent;
      cell.note = "the state to go back to is not finite";
    }
    return cell;
  }
  if (setup.halfway && setup.steps - setup.steps / 2 >= 32) {
    cell.outcome = ExtremeOutcome::silent;
    cell.note = "what was injected was not found";
    return cell;
  }
  judge(cell, setup, setup.body, body, scheme, limits);
  // a step that theory calls unstable must have been predicted
  if (cell.outcome != ExtremeOutcome::ok || scheme.implicit || limits.lower == 0.0) return cell;
  if (limits.damping_time.upper == 0.0 && limits.viscous_rate.upper == 0.0 &&
      setup.h * limits.lower > 1.01 * stable_limit(scheme, 0.0, horizon.steps, horizon.gain)) {
    cell.outcome = ExtremeOutcome::silent;
    cell.note = "an unstable step was not predicted";
  }
  return cell;
}

double omega_max(const SpringColumns& body) {
  StableStepEstimate estimate;
  return estimate.refresh(body.system(), body.x).lower;
}

SpringColumns moving(std::string_view scene, double size = 0.01) {
  SpringColumns body = extreme_body(scene);
  set_moving(body, size, omega_max(body) / 4);
  return body;
}

using SetupMaker = std::function<Setup(std::string_view scene)>;

class Matrix {
 public:
  Matrix(std::string_view axis, bool quick) : axis_(axis), quick_(quick) {}

  void add(const std::string& value, std::span<const std::string_view> scenes, const SetupMaker& make) {
    if (quick_ && count_++ % 3 != 0) return;
    for (const std::string_view scene : scenes)
      for (const IntegratorEntry& entry : integrators()) {
        ExtremeCase which{axis_, std::string(scene), std::string(entry.name), value, {}};
        which.run = [which, make] { return run(which, make(which.scene)); };
        cases_.push_back(std::move(which));
      }
  }
  void add_run(const std::string& value, std::string_view scene,
               const std::function<ExtremeCell(const ExtremeCase&)>& run_it) {
    if (quick_ && count_++ % 3 != 0) return;
    for (const IntegratorEntry& entry : integrators()) {
      ExtremeCase which{axis_, std::string(scene), std::string(entry.name), value, {}};
      which.run = [which, run_it] { return run_it(which); };
      cases_.push_back(std::move(which));
    }
  }
  std::vector<ExtremeCase> take() { return std::move(cases_); }

 private:
  std::string axis_;
  bool quick_;
  std::size_t count_ = 0;
  std::vector<ExtremeCase> cases_;
};

constexpr std::span<const std::string_view> all = extreme_bodies;
constexpr std::string_view solids[]{"box", "sheet"};

Setup with_theta(SpringColumns body, double theta, std::uint64_t steps = 100) {
  const double omega = omega_max(body);
  return {.body = std::move(body), .h = omega > 0.0 ? theta / omega : 1e-3, .steps = steps};
}

void add_numbers(Matrix& matrix, std::string_view axis) {
  const auto each = [&matrix](std::initializer_list<double> values, auto make) {
    for (const double value : values)
      matrix.add(fmt::format("{:g}", value), all, [value, make](std::string_view scene) { return make(scene, value); });
  };
  if (axis == "step")
    each({1e-6, 1e-4, 1e-2, 0.1, 0.5, 0.9, 1.5, 1.9, 2.1, 2.5, 3, 4, 6, 10, 30, 1e2, 1e3, 1e4, 1e6, 1e8},
         [](std::string_view scene, double theta) { return with_theta(moving(scene), theta); });
  if (axis == "stiffness")
    for (const double theta : {0.4, 40.0})
      for (const double spread : {1.0, 1e4, 1e8, 1e12, 1e14})
        matrix.add(fmt::format("{:g}, h omega {:g}", spread, theta), all, [spread, theta](std::string_view scene) {
          SpringColumns body = extreme_body(scene);
          const auto count = static_cast<double>(body.springs.size());
          for (std::size_t s = 0; s < body.springs.size(); ++s)
            body.springs[s].stiffness *= std::pow(spread, static_cast<double>(s) / count);
          set_moving(body, 1e-3, omega_max(body) / 4);
          return with_theta(std::move(body), theta);
        });
  if (axis == "mass")
    for (const double theta : {0.4, 40.0})
      for (const double spread : {1.0, 1e3, 1e6, 1e9, 1e12})
        matrix.add(fmt::format("{:g}, h omega {:g}", spread, theta), all, [spread, theta](std::string_view scene) {
          SpringColumns body = extreme_body(scene);
          for (std::size_t i = 0; i < body.mass.size(); ++i)
            body.set_mass(i, std::pow(spread, static_cast<double>(i) / static_cast<double>(body.mass.size())));
          // each vertex no faster than its own frequency allows
          set_moving(body, 1e-3, 0.0);
          return with_theta(std::move(body), theta);
        });
  if (axis == "damping")
    for (const double theta : {0.1, 5.0})
      for (const double zeta : {0.0, 0.05, 0.5, 1.0, 10.0, 1e3})
        matrix.add(fmt::format("{:g}, h omega {:g}", zeta, theta), all, [zeta, theta](std::string_view scene) {
          SpringColumns body = moving(scene);
          const double omega = omega_max(body);
          for (Spring& s : body.springs) s.damping = 2 * zeta / omega * s.stiffness;
          return with_theta(std::move(body), theta);
        });
  if (axis == "offset")
    each({1e1, 1e3, 1e6, 1e9, 1e12}, [](std::string_view scene, double offset) {
      SpringColumns body = moving(scene);
      const double omega = omega_max(body);
      for (Vector3d& p : body.x) p[0] += offset;
      return Setup{.body = std::move(body), .h = 0.3 / omega};
    });
  if (axis == "velocity")
    each({1e0, 1e2, 1e4, 1e6, 1e8}, [](std::string_view scene, double speed) {
      SpringColumns body = moving(scene);
      const double omega = omega_max(body);
      set_moving(body, speed / omega, omega);
      // the finer run bends as much: only growth is judged
      return Setup{.body = std::move(body), .h = 0.1 / omega, .compare = false};
    });
  if (axis == "absolute")
    each({1e-18, 1e-15, 1e-12, 1e-6, 1.0, 1e3, 1e6},
         [](std::string_view scene, double h) { return Setup{.body = moving(scene), .h = h}; });
  if (axis == "long")
    each({1e3, 1e4, 1e5}, [](std::string_view scene, double steps) {
      Setup setup = with_theta(moving(scene), 0.2, static_cast<std::uint64_t>(steps));
      setup.compare = false;
      return setup;
    });
}

void add_shapes(Matrix& matrix) {
  const auto shape = [&matrix](const char* value, std::function<void(SpringColumns&)> deform) {
    for (const double theta : {0.2, 20.0})
      matrix.add(fmt::format("{}, h omega {:g}", value, theta), solids, [deform, theta](std::string_view scene) {
        SpringColumns body = moving(scene, 1e-3);
        const double omega = omega_max(body);
        deform(body);
        return Setup{.body = std::move(body), .h = theta / omega, .compare = false};
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

void add_vertices(Matrix& matrix) {
  const auto at = [&matrix](const char* value, std::function<void(SpringColumns&)> change) {
    matrix.add(value, solids, [change](std::string_view scene) {
      SpringColumns body = moving(scene);
      const double omega = omega_max(body);
      change(body);
      return Setup{.body = std::move(body), .h = 0.2 / omega, .compare = false};
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

void add_denormals(Matrix& matrix) {
  const auto at = [&matrix](const char* value, std::function<void(SpringColumns&)> change) {
    matrix.add(value, all, [change](std::string_view scene) {
      SpringColumns body = moving(scene);
      const double omega = omega_max(body);
      change(body);
      return Setup{.body = std::move(body), .h = 0.2 / omega, .compare = false};
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

void add_bad_numbers(Matrix& matrix, bool injected) {
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
      matrix.add(fmt::format("{} in {}", bad, place.name), solids, [place, bad, injected](std::string_view scene) {
        Setup setup = with_theta(moving(scene), 0.2);
        setup.compare = false;
        setup.announced = place.of_system;
        if (injected)
          setup.halfway = [place, bad](SpringColumns& body) { place.put(body, bad); };
        else
          place.put(setup.body, bad);
        return setup;
      });
}

/// A run of a body on a map, with changes after every step.
ExtremeCell run_events(const ExtremeCase& which, int per_step, bool removals, bool all_first) {
  ExtremeCell cell{which.axis, which.scene, which.integrator, which.value, ExtremeOutcome::ok, {}, 0, {}, ""};
  Problem problem;
  problem.mesh = kuhn_box(2, 2, 2, 0.1, 0.1, 5);
  problem.surroundings.gravity = {0, 0, 0};
  problem.material.damping = problem.material.viscosity = 0.0;
  for (const Vector3d& p : problem.mesh.points)
    problem.initial_velocity.push_back({0.1 * p[1], -0.1 * p[0], 0.05 * p[2]});
  TetBody body = build_body<TetMap, Held::by_every_dart>(problem);
  SpringEndsView ends;
  ends.rebuild(body);
  const auto integrator = make_integrator(which.integrator);
  SplitMix64 random(7);
  const auto motion = [&body] { return Motion{body.vertices.position, body.vertices.velocity}; };
  const auto change = [&] {
    for (int k = 0; k < per_step && body.map.dart_count() > 0; ++k) {
      Dart d{random.below(body.map.capacity())};
      while (!body.map.is_live(d)) d = Dart{random.below(body.map.capacity())};
      ends.apply(body, adapt(body, removals ? remove_volume(body.map, d) : dissociate_face(body.map, d)));
    }
  };
  if (all_first)
    for (std::uint32_t d = 0; d < body.map.capacity(); ++d)
      if (body.map.is_live(Dart{d})) ends.apply(body, adapt(body, dissociate_face(body.map, Dart{d})));
  StableStepEstimate estimate;
  const double h = 0.3 / estimate.refresh(system_of(body, ends), body.vertices.position).upper;
  DivergenceDetector detector;
  StepResult result = detector.start(system_of(body, ends), motion(), h);
  const double before = total_energy(system_of(body, ends), body.vertices.position, body.vertices.velocity);
  const auto deadline = std::chrono::steady_clock::now() + 4 * budget;
  for (; cell.step < 60 && result.ok(); ++cell.step) {
    result = integrator->step(system_of(body, ends), motion(), h);
    result = result.ok() ? detector.after_step(system_of(body, ends), motion())
                         : detector.with_witness(result, system_of(body, ends), motion());
    if (!result.ok()) break;
    change();
    if (per_step > 0) {
      integrator->restart();
      result = detector.system_changed(system_of(body, ends), motion());
      if (estimate.refresh(system_of(body, ends), body.vertices.position).upper * h > 0.9 && cell.warnings.empty())
        cell.warnings.emplace_back("UNSTABLE_DT");
    }
    if (std::chrono::steady_clock::now() > deadline)
      result = {StepCode::budget, Witness::none, 0, "steps", static_cast<double>(cell.step)};
  }
  if (result.ok()) result = detector.check_all(system_of(body, ends), motion());
  cell.diagnosis = result;
  if (!result.ok()) {
    cell.outcome = ExtremeOutcome::diagnosed;
    return cell;
  }
  cell.outcome = cell.warnings.empty() ? ExtremeOutcome::ok : ExtremeOutcome::degraded;
  const double after = total_energy(system_of(body, ends), body.vertices.position, body.vertices.velocity);
  // explicit Euler gains theta^2 per step; the other methods, at theta = 0.3, keep the energy to some percent
  if (!check_finite(body.vertices.position, body.vertices.velocity).ok() ||
      !(after <= before * (which.integrator == "explicit-euler" ? std::exp(0.09 * 60) : 1.2) + 1e-20)) {
    cell.outcome = ExtremeOutcome::silent;
    cell.note = fmt::format("energy went from {:.3g} to {:.3g}", before, after);
  }
  return cell;
}

void add_events(Matrix& matrix) {
  const auto at = [&matrix](const char* value, int per_step, bool removals, bool all_first) {
    matrix.add_run(value, "box on a map", [per_step, removals, all_first](const ExtremeCase& which) {
      return run_events(which, per_step, removals, all_first);
    });
  };
  at("a dissociation per step", 1, false, false);
  at("two dissociations per step", 2, false, false);
  at("eight dissociations per step", 8, false, false);
  at("all dissociated", 0, false, true);
  at("a removal per step", 1, true, false);
  at("two removals per step, until nothing is left", 2, true, false);
  at("all dissociated, then removed", 1, true, true);
}

}  // namespace

std::string_view to_string(ExtremeOutcome outcome) {
  switch (outcome) {
    case ExtremeOutcome::ok: return "OK";
    case ExtremeOutcome::degraded: return "DEGRADED";
    case ExtremeOutcome::diagnosed: return "DIAGNOSED";
    case ExtremeOutcome::silent: return "SILENT";
    case ExtremeOutcome::crash: return "CRASH";
  }
  return "?";
}

std::span<const ExtremeAxis> extreme_axes() { return axes; }

std::vector<ExtremeCase> extreme_cases(std::string_view axis, bool quick) {
  if (std::ranges::none_of(axes, [axis](const ExtremeAxis& a) { return a.name == axis; })) {
    std::string known;
    for (const ExtremeAxis& a : axes) known += fmt::format("{}{}", known.empty() ? "" : ", ", a.name);
    throw InputError(fmt::format("there is no axis '{}'; there are {}", axis, known));
  }
  Matrix matrix(axis, quick);
  add_numbers(matrix, axis);
  if (axis == "shape") add_shapes(matrix);
  if (axis == "vertices") add_vertices(matrix);
  if (axis == "denormal") add_denormals(matrix);
  if (axis == "input") add_bad_numbers(matrix, false);
  if (axis == "injected") add_bad_numbers(matrix, true);
  if (axis == "events") add_events(matrix);
  return matrix.take();
}

}  // namespace dartboard
