#pragma once
// `dartboard tradeoff --models`: errors of springs and elements on a bar, each at its best integrator and step, and
// what each costs.

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/report/report.h"
#include "benchmarks/report/study_log.h"
#include "benchmarks/studies/models/models_results.h"
#include "validation/elements/bar_of_scene.h"

namespace dartboard {

struct ModelsPlan {
  std::string name = "cantilever";  // name of the bar, or of its scene
  BarOfScene of{};                  // the cantilever, unless a scene says otherwise
  bool quick = false;               // coarse meshes of three models, few processes
  std::uint64_t seed = 1;           // seeds the order of the timed tasks
};
/// "cantilever", or the bar of a scene file.
/// throws  as read_scene, bar_of_scene and bar_meshes
ModelsPlan models_plan(const std::string& name_or_file);

/// The bar's own ratio and the one of 0.25 and 0.45 that is far from it; ascending.
std::pair<double, double> ratios_for(double poisson);

Report models_study(const ModelsPlan& plan, StudyLog& log);

}  // namespace dartboard
