#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "benchmarks/cli.h"
#include "benchmarks/paper_claims.h"
#include "benchmarks/scenes.h"
#include "core/time/integrators.h"
#include "validation/contenders.h"

namespace dartboard {
namespace {

using Entries = std::vector<std::pair<std::string, std::string>>;

Entries entries_of(std::string_view kind) {
  Entries entries;
  if (kind == "scenes")
    for (const Scene& s : scenes()) entries.emplace_back(s.name, s.what);
  if (kind == "contenders")
    for (const Contender& c : contenders()) entries.emplace_back(c.id, c.what);
  if (kind == "integrators")
    for (const IntegratorEntry& i : integrators()) entries.emplace_back(i.name, i.make()->scheme().what);
  if (kind == "claims")
    for (const PaperClaim& c : paper_claims())
      entries.emplace_back(c.id, fmt::format("(section {}) {}", c.section, c.text));
  return entries;
}

}  // namespace

void add_list(CLI::App& app, Outcome&) {
  struct Options {
    std::vector<std::string> kinds;
    bool json = false;
  };
  auto options = std::make_shared<Options>();
  auto* verb = app.add_subcommand("list", "List scenes, contenders, integrators and claims.");
  verb->add_option("WHAT", options->kinds, "scenes, contenders, integrators or claims; all by default")
      ->check(CLI::IsMember({"scenes", "contenders", "integrators", "claims"}));
  verb->add_flag("--json", options->json, "print JSON");
  verb->callback([options] {
    if (options->kinds.empty()) options->kinds = {"scenes", "contenders", "integrators", "claims"};
    nlohmann::ordered_json json;
    for (const std::string& kind : options->kinds) {
      if (!options->json) fmt::print("{}\n", kind);
      for (const auto& [id, what] : entries_of(kind)) {
        json[kind].push_back({{"id", id}, {"what", what}});
        if (!options->json) fmt::print("  {:22} {}\n", id, what);
      }
    }
    if (options->json) fmt::print("{}\n", json.dump(2));
  });
}

}  // namespace dartboard
