#pragma once
// `dartboard validate elements --with calculix`: do elements bend as those of CalculiX do?

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/harness/claim.h"
#include "benchmarks/harness/table.h"
#include "validation/statics/calculix_questions.h"

namespace dartboard {

/// The distance of one beam from that of CalculiX.
struct CalculixAnswer {
  std::string what;
  bool large = false;
  std::size_t nodes = 0;
  double largest = 0.0;  // [m] displacement; the beam is 1 m long
  double apart = 0.0;    // the largest difference over that
};
/// `printed`: the .dat file that CalculiX made of the question's deck.
CalculixAnswer answer_to(const CalculixQuestion& question, std::string_view printed);

std::vector<Claim> claims_of(std::span<const CalculixAnswer> answers);
Table calculix_table(std::span<const CalculixAnswer> answers);

/// "2.20"
/// throws  IoError where there is no `ccx` on the PATH
std::string calculix_version();
/// The text that `ccx` prints into the .dat file of a deck; it runs in a folder of its own, of which nothing is left.
/// throws  IoError where it fails
std::string run_calculix(const std::string& deck);

}  // namespace dartboard
