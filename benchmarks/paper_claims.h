#pragma once
// The checkable sentences of the paper that `reproduce` answers.

#include <span>
#include <string>
#include <string_view>

#include "benchmarks/claim.h"

namespace dartboard {

struct PaperClaim {
  std::string id, text, section, paper_value;
};

/// In the order of the paper.
std::span<const PaperClaim> paper_claims();

/// A claim to be filled in.   throws  InputError if no claim has this id
Claim claim_of(std::string_view id);

}  // namespace dartboard
