#include "core/scene/run/run_end.h"

#include <fmt/format.h>

#include <string_view>

#include "core/scene/run/body_in_words.h"

namespace dartboard {
namespace {

std::string unit_of(std::string_view quantity) {
  if (quantity.starts_with("speed") || quantity.starts_with("velocity")) return " m/s";
  if (quantity.starts_with("position")) return " m";
  return quantity == "stress" ? " Pa" : "";
}

std::string meaning_of(std::string_view quantity) {
  if (quantity == "speed") return ": faster than light";
  if (quantity.find("UNSTABLE_DT") != quantity.npos)
    return ": there is more energy than anything in the scene supplies";
  return "";
}

}  // namespace

std::string to_string(const Divergence& d) {
  if (d.quantity.find("NEWTON_STALLED") != std::string::npos)
    return fmt::format(
        "diverged at step {}, t = {:.6g} s: Newton's method found no velocities at its end (NEWTON_STALLED, with a "
        "residual of {:.3g}); 'ros2' and 'baraff-witkin', which solve linear systems alone, go on",
        d.step, d.time, d.value);
  return fmt::format("diverged at step {}, t = {:.6g} s: {} of {} is {:.6g}{}{}", d.step, d.time, d.quantity,
                     vertex_in_words(d.vertex), d.value, unit_of(d.quantity), meaning_of(d.quantity));
}

std::string to_string(const StepRefusal& r) {
  return fmt::format("stopped before step {}, t = {:.6g} s: {}; at most {:.6g} s is stable", r.step, r.time, r.why,
                     r.stable);
}

std::string to_string(const EarlyEnd& end) {
  return std::visit([](const auto& reason) { return to_string(reason); }, end);
}

}  // namespace dartboard
