#pragma once
// Measurements of `bench operations`: topological operations on a body, one by one, with the updates that follow them.

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/plain/problem.h"

namespace dartboard {

/// The phases of an operation, in this order: the map, the embeddings, then each view.
const std::vector<std::string>& operation_phases();

/// The operations timed: "dissociate, cut" (face after face along an oblique plane), "dissociate, random", "remove",
/// "tear fan", "refine edge", "refine tetrahedron", "split off" (some hundred tetrahedra that have come loose), "undo"
/// (of a dissociation, by the map's journal: topology alone).
const std::vector<std::string>& operations();

/// One operation, many times on one body in one process.
struct OperationSample {
  std::string body, operation;
  int process = 0;
  std::vector<std::vector<std::int64_t>> ns;  // wall time [ns] of each, by phase; the clock's own time is in it
  std::int64_t cpu_ns = 0;                    // processor time of all together, including their preparation
};
void to_json(nlohmann::json& json, const OperationSample& sample);
void from_json(const nlohmann::json& json, OperationSample& sample);

/// One view built from scratch, one step of the classical Runge-Kutta method, and steps with an operation in each.
struct BodySample {
  std::string body;
  int process = 0;
  std::vector<std::vector<std::int64_t>> rebuild_ns;    // by view, a few times each
  std::vector<std::int64_t> step_ns, eventful_step_ns;  // taking turns; the second with a dissociation and its views
};
void to_json(nlohmann::json& json, const BodySample& sample);
void from_json(const nlohmann::json& json, BodySample& sample);

/// "liver564", or "kuhn-N" for a box of N tetrahedra.
const std::vector<std::string>& operation_bodies();
Problem operation_problem(const std::string& body);

struct OperationStudyOptions {
  int process = 0;
  int times = 200;  // for each operation, fewer if the body has fewer places for it
  std::uint64_t seed = 1;
};

/// Run all operations on one body, each on a fresh copy of it, with all views followed incrementally.
void study_operations(const std::string& body, const OperationStudyOptions& options,
                      const std::function<void(const OperationSample&)>& operation_sink,
                      const std::function<void(const BodySample&)>& body_sink);

/// Time [ns] of a series of `count` removals, map and embeddings, and of rebuilding the cell arrays after it: the
/// paper's way (section 5.2).
struct SeriesTime {
  std::int64_t changes_ns = 0, rebuild_ns = 0;
};
void to_json(nlohmann::json& json, const SeriesTime& time);
void from_json(const nlohmann::json& json, SeriesTime& time);
SeriesTime time_series_of_removals(const Problem& problem, int count, std::uint64_t seed);

}  // namespace dartboard
