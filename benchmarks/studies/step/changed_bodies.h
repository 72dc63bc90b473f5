#pragma once
// Steps of bodies that have changed, compared in time with fresh bodies of the same cells and vertices.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/harness/paired.h"
#include "benchmarks/studies/step/kept_columns.h"
#include "core/plain/problem.h"

namespace dartboard {

/// "random faces dissociated", "planar cuts", "random tetrahedra removed".
const std::vector<std::string>& kinds_of_change();

/// A body after changes.
struct ChangedBody {
  double asked = 0.0, reached = 0.0;  // new springs over those at the start; of removals, cells removed over all cells
  Problem present;                    // its cells and vertices
  KeptColumns columns;
};

/// Change a body more and more, and hand it over each time that it has reached one of the amounts, which ascend, or
/// that nothing is left to change.
///
/// throws  InputError for a kind that does not exist
void change_body(const Problem& problem, const std::string& kind, std::span<const double> amounts, std::uint64_t seed,
                 const std::function<void(ChangedBody&&)>& sink);

/// How many of the bodies made anew have other forces: as a scene makes it, and with the springs of the changed body.
std::size_t count_differing(const ChangedBody& changed, const FreshBody& fresh);

/// A changed body, as it is compared and timed.
struct ChangedCase {
  std::string changed;  // the body and its changes: "10^5 in grid order, 10 % planar cuts"
  std::string body, kind;
  double asked = 0.0, reached = 0.0;
  std::size_t tetrahedra = 0, vertices = 0, springs = 0;
  int steps = 1;              // in a sample
  std::size_t differing = 0;  // fresh bodies with other forces: with its springs, and as a scene makes it
};
void to_json(nlohmann::json& json, const ChangedCase& one);
void from_json(const nlohmann::json& json, ChangedCase& one);

/// The two tasks of a case.
namespace changed_task {
inline constexpr const char *changed = ": changed", *fresh = ": fresh";
}

struct ChangedPlan {
  std::string body;              // a name of step_bodies.h
  std::string kind;              // one of kinds_of_change
  std::filesystem::path folder;  // for columns: written by the comparison or the first process that times, read by each
  int process = 0;
  int rounds = 10;  // a fifth of them for the largest box
  std::uint64_t seed = 1;
};

/// Change the body by 1, 10 and 50 %, and compare each result with a fresh body.
/// throws  IoError
void compare_changed(const ChangedPlan& plan, const std::function<void(const ChangedCase&)>& sink);

/// Let the changed columns and the fresh ones take turns, case by case, four springs at a time on one thread.
/// throws  IoError
void measure_changed(const ChangedPlan& plan, const std::function<void(const Sample&)>& sink);

}  // namespace dartboard
