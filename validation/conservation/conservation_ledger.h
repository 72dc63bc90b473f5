#pragma once
// The ledger of a conservation run: every comparison goes through it.

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "validation/conservation/conservation.h"

namespace dartboard {

/// All comparisons; the rows of a ConservationResult are some of these, in this order.
enum class Check : std::size_t {
  counts,
  euler,
  valid,
  mass_of_vertex,
  mass_of_cells,
  spring_of_edge,
  duplicated,
  ends,
  views,
  total_mass,
  total_stiffness,
  total_damping,
  linear_momentum,
  angular_momentum,
  kinetic_energy,
  elastic_energy,
  boundary_area,
  side_by_side,
  same_cells,
  same_bits,
  oracle_position,
  oracle_velocity,
  reference_position,
  reference_velocity,
  split_cells,
  split_sums,
  split_bits,
  put_in_the_middle,
  mass_of_cell,
  forces_kept,
  mass_drift,
  stiffness_drift
};
inline constexpr std::size_t check_count = 32;

/// Fills the rows of a result, and keeps the first violation.
class ConservationLedger {
 public:
  /// Makes a row for each of `checks`.
  ConservationLedger(ConservationResult& result, std::uint64_t seed, std::span<const Check> checks);
  bool broken() const { return result_.violation.has_value(); }

  /// Requires the same bits. `of` and `number` name the object.
  template <class T>
  void equal(Check check, const T& actual, const T& expected, const char* of, std::size_t number) {
    ++row(check).checks;
    if (!(actual == expected))
      fail(check, fmt::format(", {} {}", of, number), fmt::format("{}", actual), fmt::format("{}", expected), "exact");
  }
  void require(Check check, bool ok, const char* of, std::size_t number) {
    ++row(check).checks;
    if (!ok) fail(check, fmt::format(", {} {}", of, number), "not so", "so", "exact");
  }
  /// Requires deviation <= bound, both recorded in units of `scale`. A deviation of NaN is too large.
  void within(Check check, double deviation, double bound, double scale, double actual, double expected);

 private:
  ConservedRow& row(Check check) { return result_.rows.at(row_[static_cast<std::size_t>(check)]); }
  void fail(Check check, const std::string& whose, std::string actual, std::string expected, std::string bound);

  ConservationResult& result_;
  std::uint64_t seed_;
  std::array<std::size_t, check_count> row_{};
  std::array<double, check_count> share_{};  // the largest share of the bound so far
};

}  // namespace dartboard
