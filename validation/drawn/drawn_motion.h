#pragma once
// The motion of a scene as numbers with units, so that two runs can be compared after a change of units or of axes.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/run/simulation.h"
#include "validation/drawn/scene_walk.h"

namespace dartboard {

/// Numbers of one kind at one time.
struct Quantity {
  enum class Kind { numbers, scalars, vectors, tensors };  // numbers of things: rounding changes none

  std::string name;  // "positions at step 12"
  Dimensions unit;
  Kind kind = Kind::numbers;
  std::vector<double> values;  // of vectors by components, of tensors by columns
};

/// The quantities of frames and diagnostics at three times of a run.
struct DrawnMotion {
  std::string end;  // empty for a run that came to its end; "speed at step 12": a divergence; or a refused step
  std::vector<Quantity> quantities;
};

struct DrawnRunOptions {
  unsigned threads = 1;
  bool lanes = true;
  std::uint64_t parts = 1;  // that each step of the scene has been divided into: quantities are those of the same times
  std::uint64_t late = 0;   // steps at the start that do not count; a run that moves in them ends with them
  bool continued = false;   // halfway the state is written, and read by another simulation that goes on
};

/// The first or last quantity whose name begins so.
/// pre  there is one
const Quantity& first_named(const DrawnMotion& motion, std::string_view name);
const Quantity& last_named(const DrawnMotion& motion, std::string_view name);

/// All of the run, in memory.
///
/// throws  InputError for a scene that is wrong
DrawnMotion run_drawn(const nlohmann::ordered_json& scene, const std::filesystem::path& folder,
                      const DrawnRunOptions& options = {});

/// The motion, of a run in other units: lengths, times and masses are 2^length, 2^time and 2^mass times as large.
DrawnMotion in_units(DrawnMotion motion, const Dimensions& powers);
/// The motion, of a run in other axes: the old y, z and x are the new x, y and z.
DrawnMotion in_turned_axes(DrawnMotion motion);
/// The motion, of a run seen in a mirror across x.
DrawnMotion in_mirror(DrawnMotion motion);

/// The motion, of a run in a frame in which the origin is at a place and moves.
DrawnMotion out_of_moving_frame(DrawnMotion motion, const Eigen::Vector3d& place, const Eigen::Vector3d& velocity);
/// The motion, with the vertices in the order of other numbers: `number` has that of each point.
DrawnMotion in_order_of(DrawnMotion motion, const std::vector<std::size_t>& number);

/// The first difference of bits, in words; none where all are equal. NaN equals NaN.
std::optional<std::string> different_bits(const DrawnMotion& expected, const DrawnMotion& found);
/// Of each time the quantities that have a value by vertex, of the vertices whose number no other has: those of
/// vertices that came apart have no order, and those of refinement no number.
DrawnMotion by_vertex(DrawnMotion motion);
/// Of these quantities as many values as the other run has, without those of all bodies together: what a run with
/// another body has of the first ones.
DrawnMotion first_of(const DrawnMotion& motion, const DrawnMotion& other);

/// What is small for the quantities of a run: one for each of these.
struct MotionScales {
  double length = 1.0, time = 1.0, mass = 1.0;  // [m] its size; [s] its step; [kg]

  double of(const Dimensions& unit) const;
};

/// By quantity, the largest absolute differences that are allowed.
using Allowances = std::vector<double>;
/// The differences of two runs that only rounding tells apart: `factor` times those of `disturbed`, which begins
/// elsewhere by far more than rounding, and at least 1e-12 in units of `scales`. None where that one differs in numbers
/// of things: then rounding decides what happens.
std::optional<Allowances> allowances(const DrawnMotion& motion, const DrawnMotion& disturbed,
                                     const MotionScales& scales, double factor = 64.0);
/// Allows for each quantity a multiple of the difference of two more runs, too.
void add_differences(Allowances& allowed, const DrawnMotion& one, const DrawnMotion& other, double factor);
/// The first quantity that differs by more, in words.
std::optional<std::string> differs_by_more(const DrawnMotion& expected, const DrawnMotion& found,
                                           const Allowances& allowed);

}  // namespace dartboard
