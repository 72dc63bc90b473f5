#pragma once
// Section 5.1: a coverage has to check every dart, whatever cells it looks for.

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "core/plain/mesh.h"
#include "core/topology/generalized_map.h"
#include "validation/topology/claim_answer.h"

namespace dartboard {

/// General storage that counts the look-ups of alphas.
class CountingTable : public AlphaTable<3> {
 public:
  Dart alpha(int i, Dart d) const {
    ++looks_;
    return AlphaTable<3>::alpha(i, d);
  }
  std::size_t looks() const { return looks_; }

 private:
  mutable std::size_t looks_ = 0;
};
using CountingMap = GeneralizedMap<3, CountingTable>;

/// Covers the i-cells of a map and returns how many there are: core's coverage, or a faulty stand-in.
using Coverage = std::function<std::size_t(const CountingMap&, int i)>;
Coverage core_coverage();

/// Cover the vertices, edges, faces and volumes of some bodies and count look-ups. Their number is proportional to the
/// darts if the number per dart is the same, at least one, in all bodies and for cells of any dimension: within 1 %.
/// pre  bodies of different sizes
ClaimAnswer try_coverages(std::span<const Mesh> bodies, const Coverage& cover = core_coverage());

}  // namespace dartboard
