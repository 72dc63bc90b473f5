#include "benchmarks/studies/contact/contact_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/base/counted.h"
#include "core/plain/nan_maximum.h"

namespace dartboard {
namespace {

// A sample is in contact with one cell, so that for some of the pairs found there the contact lies in a neighbour cell.
constexpr double least_share = 0.95;
constexpr std::size_t deep_class = 3;  // from 0.6 of the least altitude on
static_assert(OverlapTally::classes == 10);
// Velocity Verlet with h omega of some 0.2 leaves (h omega)^2 / 24 of the energy of vibrations, kinks of the depth as
// much again.
constexpr double most_energy = 5e-3;
// Sums of some hundred forces in each of some hundred steps, by their roundings.
constexpr double most_momentum = 1e-12;
// Linear cells are too stiff, least so with six faces and more to the edge of the contact.
constexpr double most_hertz = 0.1;
constexpr int least_faces = 6;
// Rest is where inertia has gone: backward Euler leaves less than this of the ball's way in its last step.
constexpr double most_moved = 1e-3;
// A stack at rest has lost its drop to rounding, and creeps nowhere in friction that sticks.
constexpr double most_kinetic = 1e-10, most_creep = 1e-6;
// Of the 200 steps of a bounce by methods of order 2 and more, and a tenth over the ratio of stiffnesses. Restitutions
// below are exact in shorter steps only: their losses are fast.
constexpr double most_bounce = 0.02, least_asked = 0.2, least_stiffness = 10.0;
// What Newton's method leaves of its equations.
constexpr double most_pulled = 1e-9;
// A slide is over some hundred steps in each of which forces across it are rounded, or solved for to 1e-10 of the
// others.
constexpr double most_caught = 1e-6;
// A soft body that is drawn off turns the normals along which it is pushed.
constexpr double most_pulled_of_bodies = 2e-3;
// Sums of some thousand terms that an operation leaves or takes whole, and those of steps over what was added to them:
// some dozens of roundings of each term at most.
constexpr double most_rounding = 1e-14;
// The energy of contact is no continuous function of places in rubble: a sample that leaves a cell near the tip of a
// crack, where overlaps count for nothing, for one beyond has a contact at once, and its way out may be longer in the
// next cell. A shorter step does not help; 10,000 operations have left 0.011 and 0.020.
constexpr double most_of_steps = 0.05;

Claim claim(std::string id, std::string text, double bound, double worst, const std::string& unit) {
  return target(std::move(id), std::move(text), fmt::format("<= {:g}{}", bound, unit),
                fmt::format("{:.2g}{}", worst, unit), "", met(worst <= bound));
}

double stiffness_of(const BounceFound& found) {
  return std::ranges::find(bouncing_bodies(), found.body, &BouncingBody::name)->stiffness;
}

struct PressedFigure {
  std::string quantity;
  double found, limit;
};
std::vector<PressedFigure> figures_of(const PressedOperations& p) {
  const auto count = [](std::size_t k) { return static_cast<double>(k); };
  return {{"skins that are not their rebuilds", count(p.strangers), 0.0},
          {"invalid maps, and contacts that a search of all pairs does not find", count(p.invalid), 0.0},
          {"elastic energy over an operation", p.elastic, most_rounding},
          {"kinetic energy, gravity and momenta over an operation", p.sums, most_rounding},
          {"energy of contacts away from a cut", p.contact, most_rounding},
          {"energy of contacts across a fresh cut", p.across, 0.0},
          {"energy over steps, of the largest", p.energy, most_of_steps},
          {"momentum over steps, sideways", p.momentum, most_rounding},
          {"angular momentum over steps, about the vertical", p.angular, most_rounding},
          {"deepest overlap over the least altitude of a cell", p.by_depth.deepest, most_unfelt}};
}

std::string share_of(std::size_t part, std::size_t all) {
  return all == 0 ? "" : fmt::format("{:.3g} %", 100.0 * static_cast<double>(part) / static_cast<double>(all));
}

/// The worst of all figures, as a share of its limit.
Claim claim_on_operations(const std::optional<PressedOperations>& found) {
  double worst = found && found->ended && found->contacts > 0 && found->by_depth.count() > 0 ? 0.0 : NAN;
  if (found)
    for (const PressedFigure& one : figures_of(*found))
      worst = max_or_nan(worst, one.found == 0.0 ? 0.0 : one.found / one.limit);
  Claim made = claim("contact-pressed-operations",
                     "cuts, tears and removals in a pressed stack keep its skin, its sums and its overlaps", 1.0, worst,
                     " of each limit");
  if (found)
    made.bound_or_interval = fmt::format("in {} operations, {} of them removals", found->operations(), found->removed);
  return made;
}

/// The worst of the drawn scenes; NaN where none of a kind has ended and touched something.
struct WorstOfDrawn {
  std::size_t scenes = 0, ended = 0, touched = 0, lost = 0, silent = 0;
  double pulled = NAN, caught = NAN;
  void add(const ContactResults::Drawn& one) {
    const DrawnContactFound& found = one.found;
    ++scenes;
    ended += found.ended ? 1 : 0;
    touched += found.touched ? 1 : 0;
    lost += found.lost ? 1 : 0;
    silent += found.lost && !found.warned ? 1 : 0;
    if (!found.touched) return;
    if (one.scene.kind == DrawnKind::leaves)
      pulled = std::isnan(pulled) ? found.pulled : max_or_nan(pulled, found.pulled);
    if (one.scene.kind == DrawnKind::slides)
      caught = std::isnan(caught) ? found.caught : max_or_nan(caught, found.caught);
  }
};

std::vector<Claim> claims_on(const std::vector<ContactResults::Drawn>& drawn) {
  WorstOfDrawn all, obstacles, bodies;
  for (const ContactResults::Drawn& one : drawn) {
    all.add(one);
    (one.scene.with_bodies ? bodies : obstacles).add(one);
  }
  std::vector<Claim> claims{
      claim("contact-drawn-pulls", "an obstacle that leaves, drawn at random, does not pull, of its speed", most_pulled,
            obstacles.pulled, ""),
      claim("contact-drawn-pulls-bodies", "nor does a body, of its speed", most_pulled_of_bodies, bodies.pulled, ""),
      claim("contact-drawn-seams", "what slides over seams is pushed upwards alone", most_caught, all.caught, ""),
      claim("contact-drawn-silence", "scenes in which a body comes through a plate without a warning", 0.0,
            drawn.empty() ? NAN : static_cast<double>(all.silent), "")};
  for (Claim& one : claims) one.bound_or_interval = fmt::format("in {}", counted(drawn.size(), "drawn scene"));
  return claims;
}

}  // namespace

std::vector<Claim> claims_of(const ContactResults& results) {
  // what was not measured does not count as right
  double quiet = results.placements.empty() ? NAN : 0.0, in_motion = results.runs.empty() ? NAN : 0.0,
         depth = in_motion, energy = in_motion;
  double momentum = std::ranges::any_of(results.runs, &ContactRun::alone) ? 0.0 : NAN, angular = momentum;
  std::size_t overlapping = 0, pairs = 0, felt = 0;
  for (const ContactResults::Placed& placed : results.placements) {
    quiet = max_or_nan(quiet, placed.found.deepest_quiet);
    overlapping += placed.found.overlapping;
    const OverlapTally& tally = placed.found.by_depth;
    for (std::size_t k = deep_class; k < OverlapTally::classes; ++k) {
      pairs += tally.overlaps[k];
      felt += tally.overlaps[k] - tally.missed[k];
    }
    if (placed.found.overlapping == 0) quiet = NAN;
  }
  std::size_t looks = 0;
  for (const ContactRun& run : results.runs) {
    in_motion = max_or_nan(in_motion, run.by_depth.deepest_missed);
    depth = max_or_nan(depth, run.deepest / run.allowed);
    energy = max_or_nan(energy, run.energy);
    momentum = max_or_nan(momentum, run.momentum);
    angular = max_or_nan(angular, run.angular);
    looks += run.looks;
    if (!run.ended || run.contacts == 0) in_motion = depth = energy = momentum = angular = NAN;
  }
  double hertz = results.balls.empty() ? NAN : 0.0;
  for (const auto& [ball, found] : results.balls) {
    if (ball.across >= least_faces) hertz = max_or_nan(hertz, std::abs(found.error()));
    if (!found.ended || !(found.moved <= most_moved) || ball.across < least_faces) hertz = NAN;
  }
  double bounce = results.bounces.empty() ? NAN : 0.0, pulled = bounce;
  for (const BounceFound& one : results.bounces) {
    if (one.ended) pulled = max_or_nan(pulled, one.pulled);
    if (one.order >= 2 && one.asked >= least_asked && stiffness_of(one) >= least_stiffness)
      bounce = max_or_nan(bounce, one.ended ? std::abs(one.found - one.asked) : NAN);
  }
  const bool rests = results.stack && results.stack->ended && results.stack->drop > 0.0;
  std::vector<Claim> claims{
      claim("contact-placed", "bodies that overlap deeper than 3/4 of the least altitude of a cell are felt",
            most_unfelt, quiet, " altitudes"),
      claim_on_share("contact-placed-pairs", "pairs of cells deeper than 0.6 of it have a contact at their own corners",
                     felt, pairs, least_share),
      claim("contact-moving-pairs", "in motion, cells that overlap deeper than their law allows are felt", 1.0,
            in_motion, " depths"),
      claim("contact-depth", "no cells overlap deeper than their law allows", 1.0, depth, " depths"),
      claim("contact-energy", "energy is what it was, less what was lost, of the largest kinetic energy", most_energy,
            energy, ""),
      claim("contact-momentum", "bodies on which nothing acts keep their momentum", most_momentum, momentum, ""),
      claim("contact-angular-momentum", "and their angular momentum", most_momentum, angular, "")};
  claims[0].bound_or_interval = fmt::format("of {} placements that overlap", overlapping);
  for (std::size_t k = 2; k < claims.size(); ++k) claims[k].bound_or_interval = fmt::format("in {} looks", looks);
  claims.push_back(claim("contact-hertz", "a ball in a half-space is carried by Hertz's force", most_hertz, hertz, ""));
  claims.back().bound_or_interval = fmt::format("the worst of {}", counted(results.balls.size(), "case"));
  claims.push_back(claim("contact-restitution",
                         "bodies ten times as stiff as their contact, and loose vertices, keep the restitution",
                         most_bounce, bounce, ""));
  claims.push_back(
      claim("contact-pushes", "a floor that leaves does not pull, of its speed in a step", most_pulled, pulled, ""));
  for (std::size_t k = claims.size() - 2; k < claims.size(); ++k)
    claims[k].bound_or_interval = fmt::format("in {}", counted(results.bounces.size(), "run"));
  claims.push_back(claim("contact-stack-rests", "a stack comes to rest: its kinetic energy over that of the drop",
                         most_kinetic, rests ? results.stack->kinetic / results.stack->drop : NAN, ""));
  claims.push_back(claim("contact-stack-still", "and stays where it is", most_creep, rests ? results.stack->moved : NAN,
                         " cell edges"));
  if (rests)
    for (std::size_t k = claims.size() - 2; k < claims.size(); ++k)
      claims[k].bound_or_interval = fmt::format("in {} steps", results.stack->steps);
  for (const Claim& of_drawn : claims_on(results.drawn)) claims.push_back(of_drawn);
  claims.push_back(claim_on_operations(results.operations));
  return claims;
}

Table operations_table(const PressedOperations& found) {
  Table table({{"quantity"}, {"found", Align::right}, {"limit", Align::right}});
  for (const PressedFigure& one : figures_of(found))
    table.add_row({one.quantity, fmt::format("{:.2g}", one.found), fmt::format("{:g}", one.limit)});
  const auto add = [&table](const char* quantity, const std::string& value) { table.add_row({quantity, value, ""}); };
  add("energy of contacts that an operation meets, of all", fmt::format("{:.2g}", found.reopened));
  add("pairs of cells that overlap", std::to_string(found.by_depth.count()));
  add("unfelt", share_of(found.by_depth.count_missed(), found.by_depth.count()));
  add("deepest unfelt", fmt::format("{:.2g}", found.by_depth.deepest_missed));
  const std::size_t near = found.of_neighbours.count();
  add("pairs within two rings of a crack's tip, of all that overlap", share_of(near, near + found.by_depth.count()));
  add("deepest of these", fmt::format("{:.2g}", found.of_neighbours.deepest));
  return table;
}

Table bounces_table(const std::vector<BounceFound>& bounces) {
  Table table({{"body"},
               {"stiffness over contact's", Align::right},
               {"asked", Align::right},
               {"order 2 and more", Align::right},
               {"order 1", Align::right},
               {"failed", Align::right},
               {"largest pull", Align::right}});
  struct Range {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    void add(double value) {
      least = std::min(least, value);
      most = std::max(most, value);
    }
    std::string text() const {
      if (!(least <= most)) return "-";
      return most - least < 5e-4 ? fmt::format("{:.3f}", least) : fmt::format("{:.3f} to {:.3f}", least, most);
    }
  };
  for (auto row = bounces.begin(); row != bounces.end();) {
    const BounceFound& first = *row;
    Range exact, rough;
    std::string failed;
    double pulled = 0.0;
    for (; row != bounces.end() && row->body == first.body && row->asked == first.asked; ++row) {
      if (!row->ended) {
        failed += (failed.empty() ? "" : ", ") + std::string(row->integrator);
        continue;
      }
      (row->order >= 2 ? exact : rough).add(row->found);
      pulled = max_or_nan(pulled, row->pulled);
    }
    const double stiffness = stiffness_of(first);
    table.add_row({std::string(first.body), std::isfinite(stiffness) ? fmt::format("{:g}", stiffness) : "",
                   fmt::format("{:g}", first.asked), exact.text(), rough.text(), failed,
                   fmt::format("{:.1e}", pulled)});
  }
  return table;
}

Table drawn_table(const std::vector<ContactResults::Drawn>& drawn) {
  Table table({{"scenes"},
               {"of", Align::right},
               {"ended", Align::right},
               {"touched", Align::right},
               {"largest pull", Align::right},
               {"largest push sideways", Align::right},
               {"through a plate", Align::right},
               {"without a warning", Align::right}});
  const auto figure = [](double value) { return std::isnan(value) ? "" : fmt::format("{:.1e}", value); };
  for (const DrawnKind kind : {DrawnKind::leaves, DrawnKind::slides, DrawnKind::drops})
    for (const bool with_bodies : {false, true}) {
      WorstOfDrawn of;
      for (const ContactResults::Drawn& one : drawn)
        if (one.scene.kind == kind && one.scene.with_bodies == with_bodies) of.add(one);
      const bool drops = kind == DrawnKind::drops;
      table.add_row({fmt::format("{}, {}", name_of(kind), with_bodies ? "bodies" : "obstacles"),
                     std::to_string(of.scenes), std::to_string(of.ended), std::to_string(of.touched), figure(of.pulled),
                     figure(of.caught), drops ? std::to_string(of.lost) : "", drops ? std::to_string(of.silent) : ""});
    }
  return table;
}

Table placements_table(const ContactResults& results) {
  Table table({{"bodies"},
               {"placements", Align::right},
               {"overlap", Align::right},
               {"unfelt", Align::right},
               {"deepest unfelt", Align::right},
               {"pairs of cells", Align::right},
               {"unfelt", Align::right},
               {"deepest unfelt", Align::right}});
  for (const auto& [bodies, f] : results.placements)
    table.add_row({bodies, std::to_string(f.placements), std::to_string(f.overlapping), std::to_string(f.quiet),
                   fmt::format("{:.2g}", f.deepest_quiet), std::to_string(f.by_depth.count()),
                   std::to_string(f.by_depth.count_missed()), fmt::format("{:.2g}", f.by_depth.deepest_missed)});
  return table;
}

Table depths_table(const ContactResults& results) {
  Table table({{"depth over least altitude"},
               {"pairs of cells", Align::right},
               {"unfelt", Align::right},
               {"share", Align::right}});
  OverlapTally all;
  for (const ContactResults::Placed& placed : results.placements) all.add(placed.found.by_depth);
  constexpr double width = 2.0 / static_cast<double>(OverlapTally::classes);
  for (std::size_t k = 0; k < OverlapTally::classes; ++k) {
    const double from = width * static_cast<double>(k);
    table.add_row({k + 1 < OverlapTally::classes ? fmt::format("{:.1f} to {:.1f}", from, from + width)
                                                 : fmt::format("{:.1f} and more", from),
                   std::to_string(all.overlaps[k]), std::to_string(all.missed[k]),
                   share_of(all.missed[k], all.overlaps[k])});
  }
  return table;
}

Table runs_table(const std::vector<ContactRun>& runs) {
  Table table({{"scene"},
               {"looks", Align::right},
               {"contacts", Align::right},
               {"pairs of cells", Align::right},
               {"unfelt", Align::right},
               {"deepest m", Align::right},
               {"allowed m", Align::right},
               {"energy", Align::right},
               {"momentum", Align::right},
               {"angular", Align::right}});
  for (const ContactRun& run : runs)
    table.add_row({run.scene, std::to_string(run.looks), std::to_string(run.contacts),
                   std::to_string(run.by_depth.count()), std::to_string(run.by_depth.count_missed()),
                   fmt::format("{:.2g}", run.deepest), fmt::format("{:g}", run.allowed),
                   fmt::format("{:.1e}", run.energy), run.alone ? fmt::format("{:.1e}", run.momentum) : "",
                   run.alone ? fmt::format("{:.1e}", run.angular) : ""});
  return table;
}

Table carried_table(const ContactResults& results) {
  Table table({{"scene"},
               {"quantity"},
               {"found", Align::right},
               {"expected", Align::right},
               {"error", Align::right},
               {"limit", Align::right}});
  for (const auto& [ball, found] : results.balls)
    table.add_row(
        {fmt::format("ball in {}, {} faces to the edge of the contact, p = {}",
                     ball.cells == CellKind::hexahedron ? "hexahedra" : "tetrahedra", ball.across, ball.exponent),
         "force [N]", fmt::format("{:.4g}", found.force), fmt::format("{:.4g}", found.closed_form),
         fmt::format("{:+.1f} %", 100.0 * found.error()), fmt::format("{:g} %", 100.0 * most_hertz)});
  if (!results.stack) return table;
  const StackAtRest& stack = *results.stack;
  const std::string name = fmt::format("stack of {} boxes, {} steps", stack.boxes, stack.steps);
  table.add_row({name, "kinetic energy over that of the drop", fmt::format("{:.1e}", stack.kinetic / stack.drop), "0",
                 "", fmt::format("{:g}", most_kinetic)});
  table.add_row({name, "largest way of a vertex over a cell edge", fmt::format("{:.1e}", stack.moved), "0", "",
                 fmt::format("{:g}", most_creep)});
  return table;
}

}  // namespace dartboard
