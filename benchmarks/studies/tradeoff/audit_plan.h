#pragma once
// Input of `dartboard recommend --audit`: scenes and errors drawn from a seed.

#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/plain/random.h"
#include "validation/scenes/tradeoff_scenes.h"

namespace dartboard {

/// `scenes`: scenes of any kind that a reference and a sweep can follow; longer ones without a sweep, and without a
/// reference by other codes; some of which only the costs are known; at last those of the gallery, without a sweep.
///
/// `long_motions` (`--long`): small bodies, of whose motion pilots see a hundredth at most: some 1e5 / omega_max,
/// thousands of the slow periods. Strains and gravity are a fortieth of those of `scenes`, and bodies are of springs,
/// with neither loads, contact nor events: errors of chaotic motions cannot be predicted, and the effect of an event
/// shows in no pilot before it.
enum class AuditKind { scenes, long_motions };

/// The checks in addition to following the recommendations.
enum class AuditCheck { reference_and_sweep, reference, costs_only };

struct AuditCase {
  TradeoffScene scene;
  std::vector<double> errors;  // [edges]
  AuditCheck check = AuditCheck::reference_and_sweep;
  double budget_s = 0.0;  // [s] of the pilots of a recommendation; 0: by its rule
};

/// [s] The longest time allowed for a run of the sweep, if the dearest pick takes that long. A run that takes longer
/// cannot be cheaper than it, except that steps are powers of two.
double longest_sweep_run(double dearest_pick_s);

/// The cases of an audit, one after the other. With `quick` there are two small ones, of `scenes` with a sweep.
class AuditCases {
 public:
  /// `gallery` are files of scenes.
  AuditCases(AuditKind kind, std::uint64_t seed, bool quick, std::vector<std::filesystem::path> gallery = {});

  std::uint64_t size() const;
  /// pre     fewer than size() were drawn
  AuditCase next();

 private:
  AuditCase next_long_motion();
  AuditCase next_of_gallery(std::uint64_t number);

  AuditKind kind_;
  std::uint64_t seed_;
  bool quick_;
  SplitMix64 random_;
  std::uint64_t drawn_ = 0;
  std::vector<std::filesystem::path> gallery_;
};

}  // namespace dartboard
