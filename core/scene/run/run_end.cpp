#include "core/scene/run/run_end.h"

#include <fmt/format.h>

#include "core/scene/run/body_in_words.h"

namespace dartboard {

std::string to_string(const Divergence& d) {
  return fmt::format("diverged at step {}, t = {:.6g} s: {} of {} is {:.6g}", d.step, d.time, d.quantity,
                     vertex_in_words(d.vertex), d.value);
}

std::string to_string(const StepRefusal& r) {
  return fmt::format("stopped before step {}, t = {:.6g} s: {}; at most {:.6g} s is stable", r.step, r.time, r.why,
                     r.stable);
}

std::string to_string(const EarlyEnd& end) {
  return std::visit([](const auto& reason) { return to_string(reason); }, end);
}

}  // namespace dartboard
