#pragma once
// What options of all verbs must be.

#include <CLI/App.hpp>
#include <cstdint>

namespace dartboard {

/// A check for options: digits alone, up to `most`. CLI11 takes -1, and what is too large, for the largest number there
/// is.
CLI::Validator whole_number(std::uint64_t most);

/// Check what verbs have in common: --steps and --seed are whole numbers, --out is not empty.
void check_common_options(CLI::App& app);

}  // namespace dartboard
