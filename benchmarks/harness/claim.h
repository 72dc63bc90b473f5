#pragma once
// What the paper (or we) assert, beside what was measured.

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>

#include "benchmarks/harness/paired.h"
#include "benchmarks/harness/table.h"

namespace dartboard {

/// A target of ours, or what the paper says of maps and bodies, holds or falls short. What the paper says of the times
/// of its machine holds here too or does not carry over: that is a finding, and no failure. Each may be undecided,
/// where what was measured leaves it open, or not tested, for a reason.
enum class Verdict { holds, falls_short, does_not_carry_over, undecided, not_tested };

/// "holds", "falls short", "does not carry over", "undecided", "not tested".
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
  std::string reason{};               // of a verdict that is not "holds"; may be empty
  Verdict expected = Verdict::holds;  // the answer that is known

  /// A tested claim with another answer than the known one, and no reason for it.
  bool surprises() const;
};

/// What a measurement says of a bound: its whole interval keeps it, a part of it does, or none. The median has no say:
/// that of another run may be anywhere in the interval. An interval of too few values tells nothing. What is not a
/// number keeps no bound. What is counted in full (bytes, the runs of a list) has no interval and needs none.
enum class Met { no, open, yes };
Met at_most(const Figure& figure, double bound);
Met at_least(const Figure& figure, double bound);

/// The verdict on a target of ours: what is open does not fall short, but is undecided, and the reason says so.
void judge(Claim& claim, Met met);

/// A target of ours on the share of what was drawn that is good; the interval is that of the share of all there are.
Claim claim_on_share(std::string id, std::string text, std::size_t good, std::size_t all, double asked);

/// The reason is left out where it is empty, the expected answer where it is that a claim holds.
void to_json(nlohmann::json& json, const Claim& claim);

/// 1 when a claim falls short or surprises, else 0. What does not carry over is a finding, and what is undecided or
/// was not tested does not count against a run, so that a quick run can succeed; their reasons are in the report.
int exit_code(std::span<const Claim> claims);

/// What was found, in words: "27 claims hold, 2 of the paper's do not carry over to this machine (arrays, ladder)."
std::string in_words(std::span<const Claim> claims);

/// For the terminal: verdict, section and text of each claim on one line, what it rests on below.
std::string to_text(std::span<const Claim> claims);

/// One row per claim; a column of reasons only if there is one.
Table table_of(std::span<const Claim> claims);

}  // namespace dartboard
