#include "benchmarks/studies/contact/contact_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "benchmarks/studies/contact/contact_report.h"
#include "benchmarks/studies/contact/ipctk_study.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/time/integrators.h"
#include "validation/contact/contact_scenes.h"

namespace dartboard {
namespace {

struct Pair {
  std::string bodies;
  Mesh first, second;
};
// boxes with cells of all shapes, balls, and bodies finer than their partners
std::array<Pair, 4> pairs() {
  return {{{"two boxes", kuhn_box(2, 2, 2, 0.5, 0.15, 5), kuhn_box(2, 2, 2, 0.5, 0.15, 6)},
           {"a box and a ball", kuhn_box(2, 2, 2, 0.5, 0.15, 5), tetrahedron_ball(2, 0.5)},
           {"a finer box and ball", kuhn_box(3, 3, 3, 1.0 / 3, 0.15, 5), tetrahedron_ball(3, 0.5)},
           {"two balls", tetrahedron_ball(2, 0.5), tetrahedron_ball(2, 0.7)}}};
}

nlohmann::json depths_of(const OverlapTally& tally) {
  return {{"overlaps", tally.overlaps}, {"unfelt", tally.missed}, {"deepest_unfelt", tally.deepest_missed}};
}

IpctkResults ask_ipctk(const ContactStudyPlan& plan, StudyLog& log) {
  IpctkResults results;
  const auto bodies = pairs();
  log.begin("validate contact: ipctk", bodies.size() + 2);
  const std::size_t each = std::max<std::size_t>(1, plan.certified / bodies.size());
  for (const Pair& pair : bodies) {
    const IpctkPlacements placed =
        ipctk_placements(pair.bodies, pair.first, pair.second, {.placements = each, .seed = plan.seed});
    const IpctkPlacementsFound& found = results.placements.emplace_back(certified(placed, plan.ipctk));
    log.sample({{"ipctk", pair.bodies},
                {"placements", found.placements},
                {"crossing", found.crossing},
                {"disputed", found.disputed},
                {"false_felt", found.false_felt},
                {"quiet", found.quiet},
                {"deepest_quiet", found.deepest_quiet},
                {"contacts", found.contacts},
                {"shallow", found.shallow},
                {"longer", found.longer},
                {"longest", found.longest},
                {"apart", found.apart}});
    log.advance(pair.bodies);
  }
  const std::vector<IpctkShot> shots = ipctk_shots(plan.shots, plan.seed);
  log.advance("shots");
  results.shots = certified(shots, plan.ipctk);
  log.sample({{"ipctk", "shots"},
              {"shots", results.shots.shots},
              {"slow", results.shots.slow},
              {"fast", results.shots.fast},
              {"hits", results.shots.hits},
              {"at_once", results.shots.at_once},
              {"passes", results.shots.passes},
              {"early", results.shots.early},
              {"late", results.shots.late},
              {"false_warnings", results.shots.false_warnings},
              {"silent", results.shots.silent}});
  log.advance("collisions of shots");
  return results;
}

}  // namespace

Report contact_study(const ContactStudyPlan& plan, StudyLog& log) {
  // in parts, to show progress
  constexpr std::size_t part = 250;
  ContactResults results;
  // before what takes long, since another program may fail
  std::optional<IpctkResults> by_ipctk;
  if (plan.ipctk) by_ipctk = ask_ipctk(plan, log);
  const auto bodies = pairs();
  const std::size_t each = std::max<std::size_t>(1, plan.placements / bodies.size());
  log.begin("validate contact: placements", bodies.size() * ((each + part - 1) / part));
  for (const Pair& pair : bodies) {
    ContactResults::Placed placed{pair.bodies, {}};
    for (std::size_t done = 0; done < each; done += part) {
      placed.found.add(
          judge_placements(pair.first, pair.second,
                           {.placements = std::min(part, each - done), .seed = plan.seed * 1'000'003 + done / part}));
      log.advance(pair.bodies);
    }
    log.sample({{"bodies", pair.bodies},
                {"seed", plan.seed},
                {"placements", placed.found.placements},
                {"overlapping", placed.found.overlapping},
                {"quiet", placed.found.quiet},
                {"deepest_quiet", placed.found.deepest_quiet},
                {"pairs", depths_of(placed.found.by_depth)}});
    results.placements.push_back(std::move(placed));
  }
  const std::vector<SceneFile> scenes = contact_scenes();
  log.begin("validate contact: runs", scenes.size());
  for (const SceneFile& scene : scenes) {
    const ContactRun run = judge_run(scene, plan.looks);
    log.sample({{"scene", run.scene},
                {"looks", run.looks},
                {"contacts", run.contacts},
                {"ended", run.ended},
                {"deepest", run.deepest},
                {"allowed", run.allowed},
                {"energy", run.energy},
                {"momentum", run.momentum},
                {"angular", run.angular},
                {"pairs", depths_of(run.by_depth)}});
    results.runs.push_back(run);
    log.advance(scene.name);
  }
  std::vector<HertzCase> balls{{}, {.exponent = 2}, {.exponent = 4}, {.across = 8}, {.cells = CellKind::tetrahedron}};
  if (plan.one_ball) balls = {{.growth = 2.0}};
  log.begin("validate contact: closed forms", balls.size() + 1);
  for (const HertzCase& ball : balls) {
    const HertzResult found = press_ball(ball);
    log.sample({{"ball_in", ball.cells == CellKind::hexahedron ? "hexahedra" : "tetrahedra"},
                {"faces", ball.across},
                {"exponent", ball.exponent},
                {"force", found.force},
                {"hertz", found.closed_form},
                {"depth", found.depth},
                {"contacts", found.contacts},
                {"ended", found.ended}});
    results.balls.push_back({ball, found});
    log.advance("a ball in a half-space");
  }
  results.stack = watch_stack();
  log.sample({{"stack_of", results.stack->boxes},
              {"steps", results.stack->steps},
              {"drop", results.stack->drop},
              {"kinetic", results.stack->kinetic},
              {"moved", results.stack->moved},
              {"ended", results.stack->ended}});
  log.advance("a stack");
  std::vector<std::string_view> methods{"verlet", "backward-euler"};
  if (plan.every_integrator) {
    methods.clear();
    for (const IntegratorEntry& entry : integrators()) methods.push_back(entry.name);
  }
  log.begin("validate contact: bounces", bouncing_bodies().size());
  for (const BouncingBody& body : bouncing_bodies()) {
    for (const double asked : {0.9, 0.5, 0.2, 0.05})
      for (const std::string_view method : methods) {
        const BounceFound& found = results.bounces.emplace_back(bounce_body(body, method, asked));
        log.sample({{"bounces", found.body},
                    {"integrator", found.integrator},
                    {"asked", found.asked},
                    {"found", found.found},
                    {"pulled", found.pulled},
                    {"ended", found.ended}});
      }
    log.advance(std::string(body.name));
  }
  log.begin("validate contact: drawn scenes", plan.drawn);
  for (std::size_t k = 0; k < plan.drawn; ++k) {
    const DrawnContact scene = draw_contact(plan.seed, k);
    const DrawnContactFound found = run_drawn_contact(scene);
    results.drawn.push_back({scene, found});
    log.sample({{"drawn", k},
                {"seed", plan.seed},
                {"kind", name_of(scene.kind)},
                {"bodies", scene.with_bodies},
                {"integrator", scene.integrator},
                {"about", scene.about},
                {"ended", found.ended},
                {"touched", found.touched},
                {"pulled", found.pulled},
                {"caught", found.caught},
                {"lost", found.lost},
                {"warned", found.warned}});
    log.advance(scene.about);
  }
  constexpr std::size_t look_every = 100;
  log.begin("validate contact: operations", (plan.operations + look_every - 1) / look_every);
  const PressedOperations found =
      operate_under_pressure({.operations = plan.operations, .look_every = look_every, .seed = plan.seed},
                             [&log](std::size_t) { log.advance("a pressed stack"); });
  log.sample({{"pressed_stacks", found.stacks},
              {"dissociated", found.dissociated},
              {"torn", found.torn},
              {"removed", found.removed},
              {"steps", found.steps},
              {"looks", found.looks},
              {"ended", found.ended},
              {"strangers", found.strangers},
              {"invalid", found.invalid},
              {"elastic", found.elastic},
              {"sums", found.sums},
              {"contact", found.contact},
              {"across", found.across},
              {"reopened", found.reopened},
              {"energy", found.energy},
              {"momentum", found.momentum},
              {"angular", found.angular},
              {"contacts", found.contacts},
              {"out_of_reach", found.out_of_reach},
              {"deepest", found.by_depth.deepest},
              {"pairs", depths_of(found.by_depth)},
              {"deepest_of_neighbours", found.of_neighbours.deepest},
              {"pairs_of_neighbours", depths_of(found.of_neighbours)}});
  results.operations = found;
  Report report{
      .tables = {{"placements", "Bodies put into each other at random; depths over the least altitude of a cell",
                  placements_table(results)},
                 {"depths", "Pairs of cells that overlap, by their least translation", depths_table(results)},
                 {"runs", "Runs, looked at on the way", runs_table(results.runs)},
                 {"carried", "What contact carries, and where it stands still", carried_table(results)},
                 {"bounces", "Bodies that fall flat on a floor, and one that leaves them",
                  bounces_table(results.bounces)},
                 {"drawn",
                  "Scenes drawn at random: what leaves, slides over seams, or drops on plates of all thicknesses",
                  drawn_table(results.drawn)},
                 {"operations", "Cut, torn and eroded at random in a pressed stack", operations_table(found)}},
      .claims = claims_of(results),
      .limits = {
          "A body that is less than ten times as stiff as its contact vibrates after a bounce and is left more than the "
          "restitution asked for; a run warns of that. A restitution below a fifth needs shorter steps. Explicit Euler "
          "does not get through a bounce of a stiff body.",
          "Soft bodies turn the normals along which they are pushed, so that one body draws on another one as it leaves.",
          "What is too fast for the thickness of a plate comes through it; a run warns of that before."}};
  if (by_ipctk) {
    std::ranges::copy(claims_of(*by_ipctk), std::back_inserter(report.claims));
    report.tables.push_back(
        {"ipctk",
         fmt::format("Surfaces put to each other at random, by ipctk {}; lengths as above, apart over "
                     "the size",
                     plan.ipctk_version),
         ipctk_table(*by_ipctk)});
    report.tables.push_back({"ipctk_shots", "Shots at a plate: the first step that collides, by ipctk, and contact",
                             ipctk_shots_table(by_ipctk->shots)});
    report.facts["ipctk"] = plan.ipctk_version;
  }
  return report;
}

}  // namespace dartboard
