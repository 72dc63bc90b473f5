#pragma once
// The findings of a study: the same whether they are printed, written, drawn, compared or tested.

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "benchmarks/figures/body_picture.h"
#include "benchmarks/figures/panels.h"
#include "benchmarks/figures/plot.h"
#include "benchmarks/harness/claim.h"
#include "benchmarks/harness/table.h"

namespace dartboard {

/// A diagram: what to plot, and the name of its files.
struct Picture {
  std::string name;
  std::variant<Plot, Panels, BodyStrip> what;
};

/// The braces allow members to be left out.
struct Report {
  bool silent = false;    // written and counted, but not shown
  std::string opening{};  // a paragraph before the tables
  std::vector<NamedTable> tables{};
  std::vector<Claim> claims{};
  std::vector<std::string> limits{};  // what the study does not show, in sentences
  std::vector<Picture> pictures{};
  std::vector<std::pair<std::string, nlohmann::ordered_json>> data_files{};  // file names and values
  nlohmann::ordered_json facts = nlohmann::ordered_json::object();           // on the run, for its manifest
  nlohmann::ordered_json numbers{};          // for programs; null where claims and tables hold them all
  std::vector<std::string> disagreements{};  // each in words, beyond the claims that fall short
  std::vector<std::string> troubles{};       // requested pictures that could not be made
  std::string sentence{};                    // the finding; empty: the words of `in_words` on the claims
};

/// 1 where something disagrees or a claim falls short or surprises, else 0.
int exit_code(const Report& report);

}  // namespace dartboard
