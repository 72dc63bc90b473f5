#include "validation/drawn/drawn_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <span>
#include <utility>

#include "core/base/archive.h"
#include "core/base/lanes.h"
#include "core/base/thread_team.h"
#include "core/scene/file/load_mesh.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Dimensions in_nothing{}, in_length{1, 0, 0}, in_speed{1, -1, 0}, in_mass{0, 0, 1}, in_force{1, -2, 1},
    in_energy{2, -2, 1};

/// Threads and lanes as asked for, until it goes out of scope.
class Setting {
 public:
  explicit Setting(const DrawnRunOptions& options)
      : threads_(use_threads(options.threads)), lanes_(use_lanes(options.lanes)) {}
  ~Setting() {
    use_threads(threads_);
    use_lanes(lanes_);
  }
  Setting(const Setting&) = delete;
  Setting& operator=(const Setting&) = delete;

 private:
  unsigned threads_;
  bool lanes_;
};

/// Collects the quantities of one time.
class Collector {
 public:
  /// `when` is a part of the names.
  Collector(std::vector<Quantity>& all, std::string when) : all_(all), when_(std::move(when)) {}

  template <class Values>
  void scalars(std::string_view name, const Dimensions& unit, const Values& values) {
    Quantity& q = add(name, unit, Quantity::Kind::scalars);
    for (const auto& value : values) q.values.push_back(static_cast<double>(value));
  }
  template <class Values>
  void numbers(std::string_view name, const Values& values) {
    scalars(name, in_nothing, values);
    all_.back().kind = Quantity::Kind::numbers;
  }
  template <class Values>
  void rows(std::string_view name, const Values& values) {
    Quantity& q = add(name, in_nothing, Quantity::Kind::numbers);
    for (const auto& row : values)
      for (const auto& value : row) q.values.push_back(static_cast<double>(value));
  }
  void vectors(std::string_view name, const Dimensions& unit, std::span<const Vector3d> values) {
    Quantity& q = add(name, unit, Quantity::Kind::vectors);
    for (const Vector3d& v : values) q.values.insert(q.values.end(), v.begin(), v.end());
  }
  void tensors(std::string_view name, const Dimensions& unit, std::span<const Eigen::Matrix3d> values) {
    Quantity& q = add(name, unit, Quantity::Kind::tensors);
    for (const Eigen::Matrix3d& m : values) q.values.insert(q.values.end(), m.data(), m.data() + 9);
  }

 private:
  Quantity& add(std::string_view name, const Dimensions& unit, Quantity::Kind kind) {
    return all_.emplace_back(Quantity{fmt::format("{} at {}", name, when_), unit, kind, {}});
  }

  std::vector<Quantity>& all_;
  std::string when_;
};

void collect(const Simulation& simulation, const FrameFields& fields, const DrawnRunOptions& options,
             std::vector<Quantity>& all) {
  Collector to(all, fmt::format("step {}", (simulation.steps_done() - options.late) / options.parts));
  const int d = simulation.dimension() == 0 ? 1 : simulation.dimension();
  const Dimensions stress{2 - d, -2, 1};
  const Frame frame = simulation.frame(fields);
  to.vectors("positions", in_length, frame.mesh.points);
  to.vectors("velocities", in_speed, frame.velocity);
  to.scalars("masses", in_mass, frame.mass);
  to.numbers("numbers of points", frame.mesh_point);
  to.rows("links", frame.links);
  to.numbers("corners", frame.mesh.nodes);
  to.numbers("numbers of cells", frame.mesh_cell);
  to.numbers("components", frame.component);
  to.numbers("holds", frame.held);
  to.tensors("stresses", stress, frame.stress);
  to.scalars("tensions", in_force, frame.tension);
  to.vectors("displacements", in_length, frame.displacement);
  to.vectors("contact forces", in_force, frame.contact_force);
  to.scalars("contact depths", in_length, frame.contact_depth);
  to.rows("springs", frame.springs);
  to.scalars("strains", in_nothing, frame.strain);

  const Diagnostics row = simulation.diagnostics();
  to.scalars("time", {0, 1, 0}, std::array{row.time});
  to.scalars("kinetic energy", in_energy, std::array{row.kinetic});
  to.scalars("elastic energy", in_energy, std::array{row.elastic});
  to.scalars("energy of gravity", in_energy, std::array{row.gravitational});
  to.scalars("energy of forces", in_energy, std::array{row.applied.value_or(0.0)});
  to.vectors("momentum", {1, -1, 1}, {&row.momentum, 1});
  to.vectors("angular momentum", {2, -1, 1}, {&row.angular_momentum, 1});
  to.scalars("mass", in_mass, std::array{row.mass});
  to.scalars("boundary", {d - 1, 0, 0}, std::array{row.boundary});
  to.scalars("largest stress", d == 1 ? in_force : stress, std::array{row.largest_stress});
  const CellCounts& n = row.counts;
  to.numbers("counts", std::array{n.vertices, n.edges, n.faces, n.cells, n.components, row.operations});
  if (row.contact) {
    to.scalars("energies of contact", in_energy,
               std::array{row.contact->energy, row.contact->damped, row.contact->rubbed, row.contact->supplied});
    to.numbers("number of contacts", std::array{row.contact->contacts});
    to.scalars("deepest contact", in_length, std::array{row.contact->deepest});
  }
  if (row.sleep) {
    to.numbers("components asleep", std::array{row.sleep->asleep, row.sleep->slept, row.sleep->woken});
    to.scalars("energy of sleepers", in_energy, std::array{row.sleep->removed});
  }
  if (const ProbeRow probes = simulation.probes(); !probes.probes.empty()) {
    std::vector<Vector3d> x, v;
    for (const auto& probe : probes.probes)
      if (probe) {
        x.push_back(probe->position);
        v.push_back(probe->velocity);
      }
    to.vectors("probes", in_length, x);
    to.vectors("velocities of probes", in_speed, v);
  }
}

std::string in_words(const EarlyEnd& end) {
  if (const auto* divergence = std::get_if<Divergence>(&end))
    return fmt::format("{} at step {}", divergence->quantity, divergence->step);
  return fmt::format("refused before step {}", std::get<StepRefusal>(end).step);
}

double magnitude(std::span<const double> values) {
  double largest = 0.0;
  for (const double x : values) largest = std::max(largest, std::abs(x));
  return largest;
}

bool same(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (std::isnan(a) && std::isnan(b));
}

/// The largest difference; infinite between lists of another length.
double different_values(const Quantity& a, const Quantity& b) {
  if (a.values.size() != b.values.size()) return infinity;
  double largest = 0.0;
  for (std::size_t i = 0; i < a.values.size(); ++i)
    if (!same(a.values[i], b.values[i])) {
      const double difference = std::abs(a.values[i] - b.values[i]);
      if (std::isnan(difference)) return infinity;
      largest = std::max(largest, difference);
    }
  return largest;
}

/// Is it listed by vertex, those of the first body first?
bool of_each_vertex(const Quantity& q) {
  return q.name.starts_with("positions") || q.name.starts_with("velocities at") || q.name.starts_with("masses") ||
         q.name.starts_with("stresses") || q.name.starts_with("displacements") || q.name.starts_with("holds") ||
         q.name.starts_with("contact forces") || q.name.starts_with("contact depths");
}

std::string other_end(const DrawnMotion& expected, const DrawnMotion& found) {
  const auto words = [](const std::string& end) { return end.empty() ? "comes to its end" : "ends by " + end; };
  return fmt::format("one run {}, the other {}", words(expected.end), words(found.end));
}

}  // namespace

DrawnMotion run_drawn(const nlohmann::ordered_json& scene, const std::filesystem::path& folder,
                      const DrawnRunOptions& options) {
  const Setting setting(options);
  SceneFile file = parse_scene(scene.dump(), "scene", folder);
  load_mesh(file);
  FrameFields fields = file.output.fields;
  fields.held = fields.stress = true;
  fields.contact = file.has_contact();
  fields.springs = file.has_springs();
  auto simulation = std::make_unique<Simulation>(file);
  DrawnMotion motion;
  const std::uint64_t steps = simulation->step_count(), parts = options.parts, late = options.late;
  const std::uint64_t third = parts * std::max<std::uint64_t>(1, (steps - late) / parts / 3);
  if (const auto failure = steps == 0 ? simulation->start_failure() : std::nullopt) motion.end = in_words(*failure);
  while (simulation->steps_done() < steps) {
    if (options.continued && simulation->steps_done() == steps / 2) {
      Archive written;
      simulation->save(written);
      auto next = std::make_unique<Simulation>(file);
      Archive read(written.written(), "state");
      next->load(read);
      read.require_end();
      simulation = std::move(next);
    }
    if (const auto early = simulation->advance()) {
      motion.end = in_words(*early);
      break;
    }
    const std::uint64_t n = simulation->steps_done();
    if (late > 0 && n == late && simulation->diagnostics().kinetic > 0.0) {
      motion.end = "a motion before its start";
      break;
    }
    if (n > late && (n - late) % third == 0 && n != steps) collect(*simulation, fields, options, motion.quantities);
  }
  if (simulation->steps_done() >= late) collect(*simulation, fields, options, motion.quantities);
  return motion;
}

const Quantity& first_named(const DrawnMotion& motion, std::string_view name) {
  return *std::ranges::find_if(motion.quantities, [name](const Quantity& q) { return q.name.starts_with(name); });
}
const Quantity& last_named(const DrawnMotion& motion, std::string_view name) {
  return *std::find_if(motion.quantities.rbegin(), motion.quantities.rend(),
                       [name](const Quantity& q) { return q.name.starts_with(name); });
}

DrawnMotion in_units(DrawnMotion motion, const Dimensions& powers) {
  for (Quantity& q : motion.quantities) {
    const int power = q.unit.length * powers.length + q.unit.time * powers.time + q.unit.mass * powers.mass;
    for (double& x : q.values) x = std::ldexp(x, power);
  }
  return motion;
}

DrawnMotion in_turned_axes(DrawnMotion motion) {
  for (Quantity& q : motion.quantities) {
    const std::vector<double> old = q.values;
    if (q.kind == Quantity::Kind::vectors)
      for (std::size_t k = 0; k < old.size(); ++k) q.values[k] = old[k - k % 3 + (k % 3 + 1) % 3];
    if (q.kind == Quantity::Kind::tensors)
      for (std::size_t k = 0; k < old.size(); ++k) {
        const std::size_t row = k % 3, column = k / 3 % 3;
        q.values[k] = old[k - k % 9 + 3 * ((column + 1) % 3) + (row + 1) % 3];
      }
  }
  return motion;
}

DrawnMotion in_mirror(DrawnMotion motion) {
  for (Quantity& q : motion.quantities) {
    const bool is_axis = q.name.starts_with("angular momentum");
    if (q.kind == Quantity::Kind::vectors)
      for (std::size_t k = 0; k < q.values.size(); ++k)
        if ((k % 3 == 0) != is_axis) q.values[k] = -q.values[k];
    if (q.kind == Quantity::Kind::tensors)
      for (std::size_t k = 0; k < q.values.size(); ++k)
        if ((k % 3 == 0) != (k / 3 % 3 == 0)) q.values[k] = -q.values[k];
  }
  return motion;
}

DrawnMotion out_of_moving_frame(DrawnMotion motion, const Vector3d& place, const Vector3d& velocity) {
  // each time has its quantity of time
  auto first = motion.quantities.begin();
  for (auto q = first; q != motion.quantities.end(); ++q) {
    if (!q->name.starts_with("time at")) continue;
    const double time = q->values[0];
    const auto subtract = [](Quantity& from, const Vector3d& what) {
      for (std::size_t k = 0; k < from.values.size(); ++k) from.values[k] -= what[static_cast<Eigen::Index>(k % 3)];
    };
    for (; first != q; ++first) {
      if (first->name.starts_with("positions")) subtract(*first, place + time * velocity);
      if (first->name.starts_with("displacements")) subtract(*first, time * velocity);
      if (first->name.starts_with("velocities at")) subtract(*first, velocity);
    }
  }
  return motion;
}

DrawnMotion in_order_of(DrawnMotion motion, const std::vector<std::size_t>& number) {
  std::vector<std::size_t> order;
  // the numbers of points of a time come after some of its quantities
  for (auto numbers = motion.quantities.begin(); numbers != motion.quantities.end(); ++numbers) {
    if (!numbers->name.starts_with("numbers of points")) continue;
    order.resize(numbers->values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {},
                             [&](std::size_t k) { return number.at(static_cast<std::size_t>(numbers->values[k])); });
    const std::string when = numbers->name.substr(numbers->name.find(" at "));
    for (Quantity& q : motion.quantities) {
      if (!of_each_vertex(q) || !q.name.ends_with(when) || q.values.empty()) continue;
      const std::size_t each = q.values.size() / order.size();
      const std::vector<double> old = q.values;
      for (std::size_t k = 0; k < q.values.size(); ++k) q.values[k] = old[each * order[k / each] + k % each];
    }
  }
  return motion;
}

std::optional<std::string> different_bits(const DrawnMotion& expected, const DrawnMotion& found) {
  if (expected.end != found.end) return other_end(expected, found);
  for (std::size_t k = 0; k < std::min(expected.quantities.size(), found.quantities.size()); ++k) {
    const Quantity &a = expected.quantities[k], &b = found.quantities[k];
    if (a.name != b.name) return fmt::format("{} in place of {}", b.name, a.name);
    if (a.values.size() != b.values.size())
      return fmt::format("{}: {} in place of {} numbers", a.name, b.values.size(), a.values.size());
    for (std::size_t i = 0; i < a.values.size(); ++i)
      if (!same(a.values[i], b.values[i]))
        return fmt::format("{}: {:.17g} in place of {:.17g}, number {} of {}", a.name, b.values[i], a.values[i], i,
                           a.values.size());
  }
  if (expected.quantities.size() != found.quantities.size()) return "one run has more quantities";
  return std::nullopt;
}

DrawnMotion by_vertex(DrawnMotion motion) {
  std::erase_if(motion.quantities, [](const Quantity& q) {
    return !of_each_vertex(q) && !q.name.starts_with("numbers of points") && !q.name.starts_with("time at");
  });
  for (const Quantity& numbers : std::vector<Quantity>(motion.quantities)) {
    if (!numbers.name.starts_with("numbers of points")) continue;
    std::map<double, int> count;
    for (const double number : numbers.values) ++count[number];
    const std::string when = numbers.name.substr(numbers.name.find(" at "));
    for (Quantity& q : motion.quantities) {
      if (!q.name.ends_with(when) || q.name.starts_with("time") || numbers.values.empty()) continue;
      const std::size_t each = q.values.size() / numbers.values.size();
      std::vector<double> kept;
      for (std::size_t k = 0; k < q.values.size(); ++k)
        if (const double number = numbers.values[k / each]; number >= 0.0 && count[number] == 1)
          kept.push_back(q.values[k]);
      q.values = kept;
    }
  }
  return motion;
}

DrawnMotion first_of(const DrawnMotion& motion, const DrawnMotion& other) {
  DrawnMotion first{motion.end, {}};
  for (const Quantity& q : other.quantities) {
    if (!of_each_vertex(q)) continue;
    const auto found = std::ranges::find(motion.quantities, q.name, &Quantity::name);
    if (found == motion.quantities.end()) continue;
    first.quantities.push_back(*found);
    std::vector<double>& values = first.quantities.back().values;
    values.resize(std::min(values.size(), q.values.size()));
  }
  return first;
}

double MotionScales::of(const Dimensions& unit) const {
  return std::pow(length, unit.length) * std::pow(time, unit.time) * std::pow(mass, unit.mass);
}

std::optional<Allowances> allowances(const DrawnMotion& motion, const DrawnMotion& disturbed,
                                     const MotionScales& scales, double factor) {
  constexpr double least = 1e-12;
  if (motion.end != disturbed.end || motion.quantities.size() != disturbed.quantities.size()) return std::nullopt;
  Allowances allowed;
  for (std::size_t k = 0; k < motion.quantities.size(); ++k) {
    const Quantity &a = motion.quantities[k], &b = disturbed.quantities[k];
    if (a.values.size() != b.values.size()) return std::nullopt;
    const double difference = different_values(a, b);
    if (a.kind == Quantity::Kind::numbers && difference > 0.0) return std::nullopt;
    allowed.push_back(a.kind == Quantity::Kind::numbers ? 0.0
                                                        : std::max(factor * difference, least * scales.of(a.unit)));
  }
  return allowed;
}

void add_differences(Allowances& allowed, const DrawnMotion& one, const DrawnMotion& other, double factor) {
  for (std::size_t k = 0; k < allowed.size(); ++k)
    allowed[k] += factor * different_values(one.quantities[k], other.quantities[k]);
}

std::optional<std::string> differs_by_more(const DrawnMotion& expected, const DrawnMotion& found,
                                           const Allowances& allowed) {
  if (expected.end != found.end) return other_end(expected, found);
  if (expected.quantities.size() != found.quantities.size()) return "one run has more quantities";
  for (std::size_t k = 0; k < expected.quantities.size(); ++k) {
    const Quantity &a = expected.quantities[k], &b = found.quantities[k];
    if (a.values.size() != b.values.size())
      return fmt::format("{}: {} in place of {} numbers", a.name, b.values.size(), a.values.size());
    const double difference = different_values(a, b);
    if (!(difference <= allowed[k]))
      return fmt::format("{}: {:.3g} apart, of {:.3g}, where rounding explains {:.3g}", a.name, difference,
                         magnitude(a.values), allowed[k]);
  }
  return std::nullopt;
}

}  // namespace dartboard
