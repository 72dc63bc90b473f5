#include "core/scene/run/body_in_words.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace dartboard {
namespace {

/// "3 m", "0.5 to 0.87 m"
struct Span {
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  void add(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
  std::string text(std::string_view unit) const {
    const std::string from = fmt::format("{:.3g}", least), to = fmt::format("{:.3g}", most);
    return from == to ? fmt::format("{} {}", to, unit) : fmt::format("{} to {} {}", from, to, unit);
  }
};

}  // namespace

std::string map_in_words(std::string_view map_name) {
  return map_name == "no map" ? "no map is needed" : std::string(map_name);
}

std::string vertex_in_words(std::uint32_t number) {
  return number == no_point ? "a vertex that refinement made" : fmt::format("vertex {}", number);
}

std::string mass_in_words(double kg) {
  if (kg >= 1000.0) return fmt::format("{:.3g} tonnes", kg / 1000.0);
  if (kg >= 1.0 || kg == 0.0) return fmt::format("{:.3g} kg", kg);
  if (kg >= 1e-3) return fmt::format("{:.3g} g", kg * 1e3);
  return fmt::format("{:.3g} mg", kg * 1e6);
}

std::string in_words(const SimulatedBody& body) {
  const SpringSystem system = body.system();
  const auto& x = body.vertices().position;
  if (x.empty()) return "nothing";
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : x) box.extend(p);
  const Eigen::Vector3d size = box.sizes();
  std::string text = fmt::format("{:.3g} m along x, {:.3g} m along y, {:.3g} m along z; {}", size[0], size[1], size[2],
                                 mass_in_words(body.mass()));
  for (const ForceTerm* term : system.terms) text += fmt::format("; {} {}", term->size(), term->pieces_name());
  if (system.springs.size() == 0) return text;
  Span length, stiffness;
  for (std::size_t k = 0; k < system.springs.size(); ++k) {
    length.add((x[system.ends[k][1]] - x[system.ends[k][0]]).norm());
    stiffness.add(system.springs[k].stiffness);
  }
  return text + fmt::format("; edges of {}; springs of {}", length.text("m"), stiffness.text("N/m"));
}

}  // namespace dartboard
