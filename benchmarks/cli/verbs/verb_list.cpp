#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "benchmarks/cli/scene_names.h"
#include "benchmarks/cli/verbs/verbs.h"
#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/tell.h"
#include "benchmarks/paper/paper_bodies.h"
#include "benchmarks/paper/paper_claims.h"
#include "core/scene/file/scene_file.h"
#include "core/time/integrators.h"
#include "validation/contenders/contenders.h"
#include "validation/scenes/tradeoff_scenes.h"

namespace dartboard {
namespace {

struct Entry {
  std::string id, what;
  std::string verbs{};  // that accept a scene
};

std::vector<Entry> scene_entries() {
  std::vector<Entry> entries;
  for (const std::string& name : scene_names()) {
    const SceneFile scene = read_scene(gallery_folder() / (name + ".json"));
    entries.push_back({name, scene.about,
                       std::string("simulate, explain, ") + (scene.has_contact() ? "" : "explain-dt, ") +
                           "scene --check, gallery, tradeoff, recommend"});
  }
  for (const TradeoffEntry& s : tradeoff_scenes())
    entries.push_back({std::string(s.name), std::string(s.what), "tradeoff, recommend"});
  for (const PaperBody& s : paper_bodies())
    entries.push_back({s.name, s.what, "reproduce, bench (no need to name it)"});
  return entries;
}

std::vector<Entry> entries_of(std::string_view kind) {
  std::vector<Entry> entries;
  if (kind == "scenes") return scene_entries();
  if (kind == "contenders")
    for (const Contender& c : contenders()) entries.push_back({c.id, c.what});
  if (kind == "integrators")
    for (const IntegratorEntry& i : integrators())
      entries.push_back({std::string(i.name), std::string(i.make()->scheme().what)});
  if (kind == "claims")
    for (const PaperClaim& c : paper_claims)
      entries.push_back({std::string(c.id), fmt::format("(section {}) {}", c.section, c.text)});
  return entries;
}

}  // namespace

void add_list(CLI::App& app, Outcome&) {
  struct Options {
    std::vector<std::string> kinds;
    bool json = false;
  };
  auto options = std::make_shared<Options>();
  auto* verb = app.get_subcommand("list");
  verb->add_option("WHAT", options->kinds, "scenes, contenders, integrators or claims; all by default")
      ->check(CLI::IsMember({"scenes", "contenders", "integrators", "claims"}));
  verb->add_flag("--json", options->json, "print JSON");
  verb->callback([options] {
    if (options->kinds.empty()) options->kinds = {"scenes", "contenders", "integrators", "claims"};
    nlohmann::ordered_json json;
    for (const std::string& kind : options->kinds) {
      if (!options->json) tell("{}\n", kind);
      for (const auto& [id, what, verbs] : entries_of(kind)) {
        json[kind].push_back({{"id", id}, {"what", what}});
        if (!verbs.empty()) json[kind].back()["verbs"] = verbs;
        if (options->json) continue;
        tell("  {:22} {}\n", id, what);
        if (!verbs.empty()) tell("  {:22} for {}\n", "", verbs);
      }
    }
    if (options->json) tell("{}\n", json_text(json, 2));
  });
}

}  // namespace dartboard
