#pragma once
// The report of `dartboard validate conservation` on a body that it took apart.

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "benchmarks/harness/table.h"
#include "validation/conservation/conservation.h"

namespace dartboard {

/// One body on one storage, and the outcome.
struct TakenApart {
  std::string name, storage;  // "liver564.mesh", "tetrahedral"
  std::size_t cells = 0;      // at the start
  std::uint64_t seed = 0;
  double h = 0.0;  // [s]
  ConservationResult result;
  double operations_per_s = 0.0;

  bool holds() const;
};

/// The quantities compared, and how close each came to its bound.
Table table_of(const ConservationResult& result);

/// Numbers, table, and the violation if there is one, with the command that repeats it.
std::string to_text(const TakenApart& body, const std::string& repeat);

nlohmann::ordered_json to_json(const TakenApart& body);

}  // namespace dartboard
