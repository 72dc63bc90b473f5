#pragma once
// The conclusions of `validate contact` from its results.

#include <optional>
#include <string>
#include <vector>

#include "benchmarks/harness/claim.h"
#include "benchmarks/harness/table.h"
#include "validation/contact/bouncing_bodies.h"
#include "validation/contact/contact_run.h"
#include "validation/contact/drawn_contacts.h"
#include "validation/contact/hertz.h"
#include "validation/contact/pressed_operations.h"
#include "validation/contact/random_placements.h"
#include "validation/contact/stack_at_rest.h"

namespace dartboard {

// The deepest overlap that need not be felt, in least altitudes of a cell. Contact is felt at vertices and in the
// middles of faces: edges that cross, and a corner in a face between these, overlap by a part of a face before a sample
// is inside: a third of its height each, which exceeds the least altitude of a cell by the variation among cells.
constexpr double most_unfelt = 0.75;

struct ContactResults {
  struct Placed {
    std::string bodies;
    PlacementsFound found;
  };
  std::vector<Placed> placements;
  std::vector<ContactRun> runs;
  struct Pressed {
    HertzCase ball;
    HertzResult found;
  };
  std::vector<Pressed> balls;
  std::vector<BounceFound> bounces;
  struct Drawn {
    DrawnContact scene;
    DrawnContactFound found;
  };
  std::vector<Drawn> drawn;
  std::optional<StackAtRest> stack;
  std::optional<PressedOperations> operations;
};

std::vector<Claim> claims_of(const ContactResults& results);

/// A row for each pair of bodies; and for each class of depth, how many pairs of cells overlap and how many of these no
/// body feels.
Table placements_table(const ContactResults& results);
Table depths_table(const ContactResults& results);
Table runs_table(const std::vector<ContactRun>& runs);
/// Hertz's force, case by case; and the stack.
Table carried_table(const ContactResults& results);
/// A row for each body and restitution, over all integrators.
Table bounces_table(const std::vector<BounceFound>& bounces);
/// A row for each kind of scene, over obstacles and over bodies.
Table drawn_table(const std::vector<ContactResults::Drawn>& drawn);
/// The figures of the operations in a pressed stack, with their limits.
Table operations_table(const PressedOperations& found);

}  // namespace dartboard
