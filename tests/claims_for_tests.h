#pragma once
// Claims, looked up.

#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "benchmarks/claim.h"

namespace dartboard {

/// The claims with a verdict, by their ids.
inline std::vector<std::string> ids_of(std::span<const Claim> claims, Verdict verdict) {
  std::vector<std::string> ids;
  for (const Claim& claim : claims)
    if (claim.verdict == verdict) ids.push_back(claim.id);
  return ids;
}

/// throws  std::out_of_range if there is none
inline const Claim& find_claim(std::span<const Claim> claims, const std::string& id) {
  for (const Claim& claim : claims)
    if (claim.id == id) return claim;
  throw std::out_of_range("no claim " + id);
}

}  // namespace dartboard
