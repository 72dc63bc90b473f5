#pragma once
// What the judges of relations share: outcomes, and what rounding may change.

#include <optional>
#include <string>
#include <vector>

#include "validation/drawn/relations/relations.h"

namespace dartboard {

RelationFound breaks(std::string words);
RelationFound does_not_apply(std::string words);
/// Breaks by a difference; holds without one.
RelationFound unless(const std::optional<std::string>& difference);

/// [m] The root mean square of the difference of positions, at the time at which it is largest.
double distance(const DrawnMotion& a, const DrawnMotion& b);

/// The part of a run that is compared.
using View = DrawnMotion (*)(const DrawnMotion& motion);

/// Is the difference between what is compared of the scene's own motion and what was found one of rounding? Where
/// `order_counts`, as that of dampers or of contacts with losses, eight times what halving the step changes is allowed,
/// too.
RelationFound unless_rounding(const JudgedScene& s, View view, const DrawnMotion& found, bool order_counts);

// ---- the relations of each file, in the order of the table

std::vector<Relation> relations_of_runs();
std::vector<Relation> relations_of_forms();
std::vector<Relation> relations_of_physics();
std::vector<Relation> relations_of_keys();

}  // namespace dartboard
