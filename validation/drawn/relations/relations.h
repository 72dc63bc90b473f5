#pragma once
// Relations between runs of one scene, or one scene written in two ways, that hold whatever the motion is: no truth is
// needed to judge it.

#include <span>
#include <string>
#include <string_view>

#include "validation/drawn/relations/judged_scene.h"

namespace dartboard {

enum class RelationOutcome { holds, breaks, does_not_apply };
struct RelationFound {
  RelationOutcome outcome = RelationOutcome::holds;
  std::string words;  // what differs, or why it does not apply
};

struct Relation {
  std::string_view name, sentence, bound;
  RelationFound (*judge)(const JudgedScene& scene);
};
/// All of them: those of runs (relations_of_runs.cpp), of forms (relations_of_forms.cpp), of physics
/// (relations_of_physics.cpp) and of what keys say (relations_of_keys.cpp).
std::span<const Relation> relations();

}  // namespace dartboard
