#include "core/scene/file/scene_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string>
#include <string_view>

#include "core/plain/error.h"
#include "core/scene/file/force_kind.h"
#include "core/time/integrators.h"

namespace dartboard {
namespace {

/// The key that breaks a rule, empty where the rule is kept; what it breaks it with, and the bound that is expected,
/// where the words name these.
struct Breach {
  std::string path, other = {}, bound = {};
};

struct Rule {
  ReadUpTo part;
  Breach (*breach)(const SceneFile& scene);
  std::string_view found, expected;  // {} stands for `other` in the first, and for `bound` in the second
};

Breach breach_if(bool is_broken, std::string_view path) { return {is_broken ? std::string(path) : ""}; }

template <class Kind>
bool is_any(const Kind&) {
  return true;
}

/// The path of the last event with an action of a kind for which `test` holds; empty without one.
template <class Kind>
std::string last(const SceneFile& scene, bool (*test)(const Kind&) = is_any<Kind>) {
  std::string path;
  for (const SceneEvent& event : scene.events)
    if (const auto* action = std::get_if<Kind>(&event.action); action != nullptr && test(*action))
      path = event.action_path();
  return path;
}

/// The reason why the integrator does not take the solver; empty if it does.
std::string refusal_of_solver(const SceneFile& scene) {
  try {
    make_integrator(scene.integrator, scene.solver);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// The key of something that takes or supplies energy; empty without one.
std::string key_that_changes_energy(const SceneFile& scene) {
  if (!std::ranges::all_of(scene.forces, &SceneForce::lasts)) return "/forces";
  if (scene.material.damping > 0.0) return "/material/damping";
  if (scene.material.viscosity > 0.0) return "/material/viscosity";
  if (!scene.driven.empty()) return "/driven";
  if (!scene.events.empty()) return "/events";
  if (scene.sleep) return "/sleep";
  for (const ForceKind& kind : force_kinds())
    if (kind.changes_energy && kind.is_in(scene)) return fmt::format("/{}", kind.name);
  for (const SceneFile::Tissue& tissue : scene.tissues())
    if (tissue.material.damping_time > 0.0) return tissue.path + "/damping";
  for (const SceneObstacle& one : scene.obstacles) {
    if (one.moves()) return one.path + "/velocity";
    if (one.law.friction > 0.0) return one.path + "/friction";
    if (one.law.restitution < 1.0) return one.path + "/restitution";
  }
  for (const SceneTouch& touch : scene.touches) {
    const std::string path = touch.path == "/contact/bodies" ? "/contact" : touch.path;
    if (touch.law.friction > 0.0) return path + "/friction";
    if (touch.law.restitution < 1.0) return path + "/restitution";
  }
  return "";
}

/// The breach of a /sleep/time for which a `bound` [s] is expected.
Breach short_sleep_time(const SceneFile& scene, bool is_broken, double bound) {
  if (!is_broken) return {};
  return {"/sleep/time", fmt::format("{}", scene.sleep->time), fmt::format("{:.6g}", bound)};
}

/// In the order in which they are checked: the first breach is reported.
std::span<const Rule> rules_between_keys() {
  using enum ReadUpTo;
  using S = const SceneFile&;
  static constexpr Rule rules[] = {
      // ---- integrators and solvers
      {events,
       [](S s) {
         return Breach{!s.solver.empty() && s.integrator.empty() ? "/solver" : "", s.solver};
       },
       "is \"{}\" without an 'integrator'", "an implicit one to be named"},
      {events,
       [](S s) {
         const std::string refusal = s.solver.empty() ? "" : refusal_of_solver(s);
         return Breach{refusal.empty() ? "" : "/solver", refusal};
       },
       "{}", "one of those as 'integrator', or no 'solver'"},

      // ---- chains
      {events, [](S s) { return breach_if(s.is_chain() && !s.regions.empty(), "/regions"); },
       "cannot be combined with /body/generate/chain, which has no cells", "no such key"},
      {events,
       [](S s) {
         for (const SceneFile::Tissue& tissue : s.tissues())
           if (s.is_chain() && tissue.material.model != Model::springs) return Breach{tissue.path + "/poisson"};
         return Breach();
       },
       "cannot be combined with /body/generate/chain", "cells"},
      {events, [](S s) { return breach_if(s.is_chain(), s.key_beside_edges()); },
       "cannot be combined with /body/generate/chain, which has no cells", "cells"},

      // ---- contact
      {events,
       [](S s) {
         const bool is_broken = !s.touches.empty() && s.integrator == "energy-momentum";
         return is_broken ? Breach{s.touches.front().path} : Breach();
       },
       "cannot be combined with the integrator \"energy-momentum\", whose forces are not defined where depths have kinks",
       "another integrator, or only obstacles"},

      // ---- times and forces
      {events,
       [](S s) {
         for (const SceneForce& force : s.forces)
           if (s.is_chain() && (force.pressure || force.shared_by != SharedBy::vertices))
             return Breach{fmt::format("{}/{}", force.path, force.force ? "on" : force.kind())};
         return Breach();
       },
       "cannot be combined with /body/generate/chain, which has no faces", "'force'"},
      {events,
       [](S s) {
         return breach_if(s.accuracy && s.material.stiffness == 0.0 && s.material.damping > 0.0, "/accuracy");
       },
       "cannot be combined with /material/stiffness of 0 and a damping", "'step' in its place"},

      // ---- sleep
      {events, [](S s) { return breach_if(s.accuracy && s.sleep, "/accuracy"); },
       "cannot be combined with /sleep, which changes motions on purpose", "'step' in its place"},
      {events,
       [](S s) {
         const double gravity = s.gravity.norm(), top = s.sleep && gravity > 0.0 ? 2.0 * s.sleep->speed / gravity : 0.0;
         return short_sleep_time(s, s.sleep && s.sleep->time <= top, top);
       },
       "is {} s, and a body thrown upwards is slower than /sleep/speed for longer at the top of its flight",
       "more than 2 speed / gravity, {} s"},
      {events, [](S s) { return short_sleep_time(s, s.sleep && s.sleep->time < s.step, s.step); }, "is {} s",
       "at least one step, {} s"},

      // ---- events
      {events,
       [](S s) {
         for (const SceneEvent& event : s.events)
           if (s.is_chain() && changes_topology(event.action)) return Breach{event.action_path()};
         return Breach();
       },
       "needs cells, which a chain does not have", "no such event"},
      // a seam is a set of faces of the body at rest, and refinement replaces faces
      {events,
       [](S s) {
         const auto seam = last<TearWhereStressed>(s, [](const auto& tear) { return tear.seam.has_value(); });
         return Breach{seam.empty() ? "" : last<Refine>(s), seam};
       },
       "cannot be combined with {}/plane", "no refinement where a seam is given"},
      // a vertex that it puts between fixed ones would never be released
      {events,
       [](S s) {
         return Breach{has<Release>(s.events) ? last<Refine>(s) : "", last<Release>(s)};
       },
       "cannot be combined with {}", "no refinement where fixed vertices are released"},
      // one between driven ones would have no path of its own
      {events, [](S s) { return breach_if(!s.driven.empty(), last<Refine>(s)); }, "cannot be combined with /driven",
       "no refinement where vertices are driven"},
      {events, [](S s) { return breach_if(!s.forces.empty(), last<Refine>(s)); },
       "cannot be combined with /forces: it takes mass from the vertices that share them",
       "no refinement where forces are applied"},
      {events, [](S s) { return breach_if(!s.attachments.empty(), last<Refine>(s)); },
       "cannot be combined with /attachments: it replaces the cells that they refer to, and takes mass from vertices",
       "no refinement where vertices are attached"},

      // ---- output and expectations
      {output, [](S s) { return breach_if(s.output.fields.springs && !s.has_springs(), "/output/fields"); },
       "has \"springs\", and the body is made of elements", "fields without it"},
      {output, [](S s) { return breach_if(s.output.fields.contact && !s.has_contact(), "/output/fields"); },
       "has \"contact\" without /contact", "obstacles or bodies that touch, or no such field"},
      {expectation,
       [](S s) {
         const std::string key = s.expect.energy_drift_at_most ? key_that_changes_energy(s) : "";
         return Breach{key.empty() ? "" : "/expect/energy_drift_at_most", key};
       },
       "cannot be combined with {}, which changes the energy",
       "damping and viscosity of 0, no driven vertices or events, and constant forces from start to end"},
  };
  return rules;
}

}  // namespace

void require_rules(const SceneFile& scene, ReadUpTo part) {
  for (const Rule& rule : rules_between_keys()) {
    if (rule.part != part) continue;
    const Breach breach = rule.breach(scene);
    if (!breach.path.empty())
      scene.fail(breach.path, fmt::format(fmt::runtime(rule.found), breach.other),
                 fmt::format(fmt::runtime(rule.expected), breach.bound));
  }
}

}  // namespace dartboard
