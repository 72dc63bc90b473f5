#pragma once
// The checkable sentences of the paper that `reproduce` answers.

#include <span>
#include <string>
#include <string_view>

#include "benchmarks/harness/claim.h"

namespace dartboard {

/// What a sentence of the paper is about: maps and bodies, which are here what they were there; times, which are those
/// of its machine and programs; or what its authors thought that programs could not do.
enum class About { bodies, times, programs };

struct PaperClaim {
  std::string id, text, section, paper_value;
  About about = About::bodies;
  std::string does_not_carry_over{};  // why it does not, where that is known; else it is expected to hold
};

/// In the order of the paper.
std::span<const PaperClaim> paper_claims();

/// A claim to be filled in, not tested yet.   throws  InputError if no claim has this id
Claim claim_of(std::string_view id);

/// Whether it says that something cannot be done, so that doing it contradicts it.
/// throws  InputError if no claim has this id
bool is_impossibility(std::string_view id);

/// A claim that was tested. What the paper says of bodies falls short where it is not met, what it says of times
/// or programs does not carry over, for the reason that is known or for none; what is open is undecided.
///
/// throws  InputError if no claim has this id
Claim answered(std::string_view id, Met met, std::string measured, std::string bound_or_interval);

}  // namespace dartboard
