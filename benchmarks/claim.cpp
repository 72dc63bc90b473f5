#include "benchmarks/claim.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace dartboard {

std::string_view name(Verdict verdict) {
  switch (verdict) {
    case Verdict::holds: return "holds";
    case Verdict::falls_short: return "falls short";
    case Verdict::not_tested: return "not tested";
  }
  return "unknown verdict";
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
}

int exit_code(std::span<const Claim> claims) {
  const bool all_hold = std::none_of(claims.begin(), claims.end(),
                                     [](const Claim& claim) { return claim.verdict == Verdict::falls_short; });
  return all_hold ? 0 : 1;
}

std::string to_text(std::span<const Claim> claims) {
  std::string text;
  for (const Claim& c : claims) {
    const bool of_paper = !c.section.empty();  // else a target of our own
    text += fmt::format("{:<12}  {}{}\n", name(c.verdict), c.text, of_paper ? " (section " + c.section + ")" : "");
    std::string below;
    const auto add = [&](std::string_view what, const std::string& value) {
      if (!value.empty()) below += fmt::format("{}{}{}", below.empty() ? "" : "; ", what, value);
    };
    add(of_paper ? "paper: " : "target: ", c.paper_value);
    add("here: ", c.measured);
    add("", c.bound_or_interval);
    add("", c.reason);
    if (!below.empty()) text += fmt::format("{:<12}  {}\n", "", below);
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
