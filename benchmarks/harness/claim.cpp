#include "benchmarks/harness/claim.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace dartboard {

std::string_view name(Verdict verdict) {
  switch (verdict) {
    case Verdict::holds: return "holds";
    case Verdict::falls_short: return "falls short";
    case Verdict::does_not_carry_over: return "does not carry over";
    case Verdict::undecided: return "undecided";
    case Verdict::not_tested: return "not tested";
  }
  return "unknown verdict";
}

Claim claim_on_share(std::string id, std::string text, std::size_t good, std::size_t all, double asked) {
  Claim claim{.id = std::move(id), .text = std::move(text), .paper_value = fmt::format(">= {:g} %", 100.0 * asked)};
  if (all == 0) {
    claim.reason = "no pair to judge by";
    return claim;
  }
  const Figure part{static_cast<double>(good) / static_cast<double>(all), share_interval(good, all)};
  claim.measured = fmt::format("{} of {}, {:.1f} %", good, all, 100.0 * part.median);
  claim.bound_or_interval = fmt::format("[{:.1f}, {:.1f}] % at {:g} %", 100.0 * part.interval.low,
                                        100.0 * part.interval.high, 100.0 * part.interval.coverage);
  judge(claim, at_least(part, asked));
  return claim;
}

void to_json(nlohmann::json& json, const Claim& claim) {
  json = {{"id", claim.id},
          {"claim", claim.text},
          {"section", claim.section},
          {"paper", claim.paper_value},
          {"measured", claim.measured},
          {"bound_or_interval", claim.bound_or_interval},
          {"verdict", name(claim.verdict)}};
  if (!claim.reason.empty()) json["reason"] = claim.reason;
  if (claim.expected != Verdict::holds) json["expected"] = name(claim.expected);
}

bool Claim::surprises() const {
  const bool is_answered = verdict != Verdict::not_tested && verdict != Verdict::undecided;
  return is_answered && verdict != expected && reason.empty();
}

namespace {

bool is_number(const Figure& figure) {
  return !std::isnan(figure.median) && !std::isnan(figure.interval.low) && !std::isnan(figure.interval.high);
}

/// `worse` and `better` say whether that end of the interval keeps the bound.
Met met_by(const Figure& figure, bool worse, bool better) {
  if (!is_number(figure)) return Met::no;
  if (!figure.interval.reached) return Met::open;
  return worse ? Met::yes : better ? Met::open : Met::no;
}

}  // namespace

Met at_most(const Figure& figure, double bound) {
  return met_by(figure, figure.interval.high <= bound, figure.interval.low <= bound);
}

Met at_least(const Figure& figure, double bound) {
  return met_by(figure, figure.interval.low >= bound, figure.interval.high >= bound);
}

void judge(Claim& claim, Met met, std::string cause) {
  claim.verdict = verdict_of(met);
  if (met == Met::open)
    claim.reason = "the interval lies on both sides of the bound, or has too few values: this run cannot decide";
  if (met == Met::no && !cause.empty()) claim.reason = std::move(cause);
}

Claim target(std::string id, std::string text, std::string asked) {
  return {.id = std::move(id), .text = std::move(text), .paper_value = std::move(asked)};
}

Claim target(std::string id, std::string text, std::string asked, std::string measured, std::string interval, Met met,
             std::string cause) {
  Claim claim = target(std::move(id), std::move(text), std::move(asked));
  claim.measured = std::move(measured);
  claim.bound_or_interval = std::move(interval);
  judge(claim, met, std::move(cause));
  return claim;
}

int exit_code(std::span<const Claim> claims) {
  const bool disagrees = std::any_of(claims.begin(), claims.end(), [](const Claim& claim) {
    return claim.verdict == Verdict::falls_short || claim.surprises();
  });
  return disagrees ? 1 : 0;
}

std::string in_words(std::span<const Claim> claims) {
  const auto those = [&claims](auto&& is_meant, const char* one, const char* several) {
    std::vector<std::string> ids;
    for (const Claim& claim : claims)
      if (is_meant(claim)) ids.push_back(claim.id);
    return ids.empty() ? std::string()
                       : fmt::format("{} {} ({})", ids.size(), ids.size() == 1 ? one : several, fmt::join(ids, ", "));
  };
  const auto of = [](Verdict verdict) { return [verdict](const Claim& claim) { return claim.verdict == verdict; }; };
  const auto holding = std::count_if(claims.begin(), claims.end(), of(Verdict::holds));
  std::string text = fmt::format("{} claim{} hold{}", holding, holding == 1 ? "" : "s", holding == 1 ? "s" : "");
  for (const std::string& more :
       {those(of(Verdict::falls_short), "falls short", "fall short"),
        those(of(Verdict::does_not_carry_over), "of the paper's does not carry over to this machine",
              "of the paper's do not carry over to this machine"),
        those(of(Verdict::undecided), "is undecided", "are undecided"),
        those(of(Verdict::not_tested), "was not tested", "were not tested"),
        those([](const Claim& claim) { return claim.verdict != Verdict::falls_short && claim.surprises(); },
              "has another answer than the known one, and no reason is known",
              "have another answer than the known one, and no reason is known")})
    if (!more.empty()) text += "; " + more;
  return text + ".";
}

std::string to_text(std::span<const Claim> claims) {
  std::string text;
  std::size_t width = 12;
  for (const Claim& c : claims) width = std::max(width, name(c.verdict).size());
  for (const Claim& c : claims) {
    const bool of_paper = !c.section.empty();  // else a target of our own
    text +=
        fmt::format("{:<{}}  {}{}\n", name(c.verdict), width, c.text, of_paper ? " (section " + c.section + ")" : "");
    std::string below;
    const auto add = [&](std::string_view what, const std::string& value) {
      if (!value.empty()) below += fmt::format("{}{}{}", below.empty() ? "" : "; ", what, value);
    };
    add(of_paper ? "paper: " : "target: ", c.paper_value);
    add("here: ", c.measured);
    add("", c.bound_or_interval);
    add("", c.reason);
    if (!below.empty()) text += fmt::format("{:<{}}  {}\n", "", width, below);
  }
  return text;
}

Table table_of(std::span<const Claim> claims) {
  const bool reasons =
      std::any_of(claims.begin(), claims.end(), [](const Claim& claim) { return !claim.reason.empty(); });
  // without a section of the paper it is a target of our own
  const auto of_paper = std::count_if(claims.begin(), claims.end(), [](const Claim& c) { return !c.section.empty(); });
  const bool sections = of_paper > 0;
  const std::string asserted = !sections ? "target" : of_paper == std::ssize(claims) ? "paper" : "paper, or target";
  std::vector<Column> columns{{"claim"}};
  if (sections) columns.push_back({"section"});
  columns.insert(columns.end(),
                 {{asserted, Align::right}, {"measured", Align::right}, {"interval or bound"}, {"verdict"}});
  if (reasons) columns.push_back({"reason"});
  Table table(std::move(columns));
  for (const Claim& claim : claims) {
    std::vector<std::string> row{claim.text};
    if (sections) row.push_back(claim.section);
    row.insert(row.end(),
               {claim.paper_value, claim.measured, claim.bound_or_interval, std::string(name(claim.verdict))});
    if (reasons) row.push_back(claim.reason);
    table.add_row(std::move(row));
  }
  return table;
}

}  // namespace dartboard
