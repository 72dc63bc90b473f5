#pragma once
// Claims, looked up and read.

#include <gtest/gtest.h>

#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "benchmarks/harness/claim.h"

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

/// The claim of this name states its target, its measurement and the basis of it in these words.
inline void expect_words(std::span<const Claim> claims, const std::string& id, const std::string& asked,
                         const std::string& measured, const std::string& rests_on) {
  const Claim& c = find_claim(claims, id);
  EXPECT_EQ(c.paper_value, asked) << id;
  EXPECT_EQ(c.measured, measured) << id;
  EXPECT_EQ(c.bound_or_interval, rests_on) << id;
  EXPECT_FALSE(c.text.empty()) << id;
}

}  // namespace dartboard
