#pragma once
// What the paper (or we) assert, beside what was measured.

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>

#include "benchmarks/table.h"

namespace dartboard {

enum class Verdict { holds, falls_short, not_tested };

/// "holds", "falls short", "not tested".
std::string_view name(Verdict verdict);

/// One assertion; values are text as printed, the raw numbers are in the samples of the run.
/// The braces allow `Claim{.id = ...}` to leave members out.
struct Claim {
  std::string id{};                 // "arrays-over-adjacency"
  std::string text{};               // the claim in one line
  std::string section{};            // of the paper: "5.2"; empty for a target of our own
  std::string paper_value{};        // "<= 1.10"
  std::string measured{};           // "1.04"
  std::string bound_or_interval{};  // "[1.02, 1.07] at 96.9 %"
  Verdict verdict = Verdict::not_tested;
  std::string reason{};  // why it falls short or was not tested; may be empty
};

/// The reason is left out where it is empty.
void to_json(nlohmann::json& json, const Claim& claim);

/// 0 when every tested claim holds, 1 otherwise. Claims that were not tested do not count against a run, so that a
/// quick run can succeed; their reasons are in the report.
int exit_code(std::span<const Claim> claims);

/// For the terminal: verdict, section and text of each claim on one line, what it rests on below.
std::string to_text(std::span<const Claim> claims);

/// One row per claim; a column of reasons only if there is one.
Table table_of(std::span<const Claim> claims);

}  // namespace dartboard
