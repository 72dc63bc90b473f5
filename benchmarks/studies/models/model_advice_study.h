#pragma once
// `dartboard recommend --against truth`: the cheapest model, mesh, integrator and step for an error.

#include <string>
#include <vector>

#include "benchmarks/harness/table.h"
#include "benchmarks/report/report.h"
#include "benchmarks/report/study_log.h"
#include "benchmarks/studies/models/models_study.h"
#include "validation/elements/model_advice.h"

namespace dartboard {

/// "neo-hookean hexahedra with sides of 0.05 m, verlet with a step of 0.0012 s: ..."
std::string in_words(const ClampedBar& bar, const ModelAdvice& advice);
/// A row for each trend: what two meshes predict for a model.
Table trends_table(const ModelAdvice& advice);
nlohmann::ordered_json json_of(const ClampedBar& bar, const ModelAdvice& advice);

Report model_advice_study(const ModelsPlan& plan, const std::vector<double>& errors, StudyLog& log);

}  // namespace dartboard
