#pragma once
// The audit of `dartboard recommend`, a run of its own.

#include <cstdint>
#include <string>

#include "benchmarks/cli/cli.h"

namespace dartboard {

struct AuditOptions {
  std::uint64_t seed = 1;
  bool quick = false, json = false;
  std::string out;
};

/// Recommend for scenes and errors drawn from a seed, follow the recommendations, and compare with certified
/// references and with sweeps of all methods; writes a run folder.
void audit_recommendations(const AuditOptions& options, Outcome& outcome);

}  // namespace dartboard
