#pragma once
// Checks for the options of all verbs.

#include <CLI/App.hpp>
#include <cstdint>

namespace dartboard {

/// A check for options: digits alone, up to `most`. CLI11 reads -1, and numbers that are too large, as the largest
/// number there is.
CLI::Validator whole_number(std::uint64_t most);

/// Checks the options that verbs have in common: --steps and --seed are whole numbers, --out is not empty.
void check_common_options(CLI::App& app);

}  // namespace dartboard
