#pragma once
// The checkable sentences of the paper; `reproduce` answers them.

#include <span>
#include <string>
#include <string_view>

#include "benchmarks/harness/claim.h"

namespace dartboard {

/// The subject of a sentence of the paper: maps and bodies, which are the same here; times, which belong to its machine
/// and programs; or what its authors thought that programs could not do.
enum class About { bodies, times, programs };

struct PaperClaim {
  std::string id, text, section, paper_value;
  About about = About::bodies;
  std::string does_not_carry_over{};  // why it does not, if that is known; else it is expected to hold
};

/// In the order of the paper.
std::span<const PaperClaim> paper_claims();

/// A claim to be filled in, not tested yet.   throws  InputError if no claim has this id
Claim claim_of(std::string_view id);

/// Says whether the claim states that something is impossible, so that doing it contradicts the claim.
/// throws  InputError if no claim has this id
bool is_impossibility(std::string_view id);

/// A claim that was tested. A statement of the paper on bodies falls short where it is not met, one on times or
/// programs does not carry over, with the known reason if there is one; an open one is undecided.
///
/// throws  InputError if no claim has this id
Claim answered(std::string_view id, Met met, std::string measured, std::string bound_or_interval);

}  // namespace dartboard
