#include "benchmarks/cli/studies/settle_with_progress.h"

#include <string>

#include "benchmarks/harness/clock.h"
#include "benchmarks/harness/progress.h"
#include "validation/recommend/settle_accuracy.h"

namespace dartboard {

std::optional<SettledAccuracy> settle_with_progress(SceneFile& scene, bool quiet) {
  Progress progress("choosing a step", 0, quiet);
  return settle_accuracy(scene, thread_cpu_ns,
                         [&progress](const std::string& integrator) { progress.advance(integrator); });
}

}  // namespace dartboard
