#include "validation/extremes/extremes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/plain/error.h"
#include "core/time/integrators.h"
#include "validation/extremes/extreme_matrix.h"

namespace dartboard {
namespace {

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
    ExtremeAxis{"elements", "elastic solids: models, Poisson's ratio, spread of stiffness, flat and inverted cells"},
    ExtremeAxis{"regions",
                "springs and elements of two materials: stiffness, density, damping, flat cells between them"},
};

}  // namespace

std::string_view to_string(ExtremeOutcome outcome) {
  switch (outcome) {
    case ExtremeOutcome::ok: return "OK";
    case ExtremeOutcome::scheme: return "SCHEME";
    case ExtremeOutcome::survived: return "SURVIVED";
    case ExtremeOutcome::degraded: return "DEGRADED";
    case ExtremeOutcome::diagnosed: return "DIAGNOSED";
    case ExtremeOutcome::silent: return "SILENT";
    case ExtremeOutcome::crash: return "CRASH";
  }
  return "?";
}

std::string_view to_string(JudgedBy by) {
  switch (by) {
    case JudgedBy::motion: return "motion";
    case JudgedBy::scheme: return "scheme";
    case JudgedBy::survival: return "survival";
    case JudgedBy::diagnosis: return "diagnosis";
  }
  return "?";
}

std::unique_ptr<Integrator> make_sound(std::string_view name) { return make_integrator(name); }

bool names_a_quantity(const StepResult& diagnosis) {
  return !std::isnan(diagnosis.value) || diagnosis.code == StepCode::nonfinite;
}

std::span<const ExtremeAxis> extreme_axes() { return axes; }

std::vector<ExtremeCase> extreme_cases(std::string_view axis, bool quick) {
  if (std::ranges::none_of(axes, [axis](const ExtremeAxis& a) { return a.name == axis; })) {
    std::string known;
    for (const ExtremeAxis& a : axes) known += fmt::format("{}{}", known.empty() ? "" : ", ", a.name);
    throw InputError(fmt::format("there is no axis '{}'; there are {}", axis, known));
  }
  ExtremeMatrix matrix(axis, quick);
  add_numbers(matrix, axis);
  if (axis == "shape") add_shapes(matrix);
  if (axis == "vertices") add_vertices(matrix);
  if (axis == "denormal") add_denormals(matrix);
  if (axis == "input") add_bad_numbers(matrix, false);
  if (axis == "injected") add_bad_numbers(matrix, true);
  if (axis == "events") add_events(matrix);
  if (axis == "elements") add_elements(matrix);
  if (axis == "regions") add_regions(matrix);
  return matrix.take();
}

}  // namespace dartboard
