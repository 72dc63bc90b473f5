#pragma once
// Claims of the paper (or ours), compared with what was measured.

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>

#include "benchmarks/harness/paired.h"
#include "benchmarks/harness/table.h"

namespace dartboard {

/// A target of ours, or a statement of the paper on maps and bodies, holds or falls short. A statement of the paper on
/// the times of its machine holds here too or does not carry over: that is a finding, and no failure. Each may be
/// undecided, where the measurements leave it open, or not tested, for a reason.
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
  std::string reason{};               // why the verdict is not "holds"; may be empty
  Verdict expected = Verdict::holds;  // the answer that is known

  /// A tested claim with another answer than the known one, and no reason for it.
  bool surprises() const;
};

/// How a measurement meets a bound: its whole interval keeps it, a part of it does, or no part. The verdict depends on
/// the interval only: the median of another run may be anywhere in it. An interval of too few values decides nothing.
/// NaN keeps no bound. A full count (bytes, the runs of a list) has no interval and needs none.
enum class Met { no, open, yes };
/// Of what is exact.
constexpr Met met(bool holds) { return holds ? Met::yes : Met::no; }
/// The verdict on a target of ours.
constexpr Verdict verdict_of(Met met) {
  return met == Met::yes ? Verdict::holds : met == Met::no ? Verdict::falls_short : Verdict::undecided;
}
Met at_most(const Figure& figure, double bound);
Met at_least(const Figure& figure, double bound);

/// The verdict on a target of ours: an open comparison does not fall short, but is undecided, and the reason says so.
/// `cause` is the reason where the target falls short, and may be empty.
void judge(Claim& claim, Met met, std::string cause = "");

/// A target of ours that is not judged yet; `asked` is its bound as printed.
Claim target(std::string id, std::string text, std::string asked);
/// The same, judged.
Claim target(std::string id, std::string text, std::string asked, std::string measured, std::string interval, Met met,
             std::string cause = "");
/// The reason why a target was not tested that asks for a larger body.
inline constexpr const char* too_quick = "a quick run has no body of this size: leave out --quick";

/// A target of ours on the share of good ones among those drawn; the interval is for the share in the whole population.
Claim claim_on_share(std::string id, std::string text, std::size_t good, std::size_t all, double asked);

/// The reason is left out if it is empty, the expected answer if it is "holds".
void to_json(nlohmann::json& json, const Claim& claim);

/// 1 when a claim falls short or surprises, else 0. A claim that does not carry over is a finding, and one undecided or
/// not tested does not count against a run, so that a quick run can succeed; the report has the reasons.
int exit_code(std::span<const Claim> claims);

/// The findings in words: "27 claims hold, 2 of the paper's do not carry over to this machine (arrays, ladder)."
std::string in_words(std::span<const Claim> claims);

/// For the terminal: verdict, section and text of each claim on one line, what it rests on below.
std::string to_text(std::span<const Claim> claims);

/// One row per claim; a column of reasons only if there is one.
Table table_of(std::span<const Claim> claims);

}  // namespace dartboard
