#pragma once
// Relations tried on scenes, drawn or given, and what breaks one cut down.

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "validation/drawn/relations/relations.h"

namespace dartboard {

struct RelationTrial {
  const Relation* relation;
  RelationFound found;
};

/// The relation of that name.
/// throws  InputError that lists all
const Relation& find_relation(std::string_view name);

/// The first steps of a scene: what begins later is left out, and what is driven later is held.
nlohmann::ordered_json first_steps(nlohmann::ordered_json scene, std::uint64_t steps);

/// A relation tried on a scene. A run that throws breaks it.
RelationFound try_relation(const JudgedScene& scene, const Relation& relation);

/// The relations tried on a scene, all or one of that name.
///
/// throws  InputError for a scene that is wrong
std::vector<RelationTrial> try_relations(const nlohmann::ordered_json& scene, const std::filesystem::path& folder,
                                         const std::filesystem::path& scratch, std::string_view only = "");

/// The smallest scene found that breaks the same relation.
/// pre  the scene breaks it
nlohmann::ordered_json smallest_breaking(const nlohmann::ordered_json& scene, const Relation& relation,
                                         const std::filesystem::path& folder, const std::filesystem::path& scratch);

}  // namespace dartboard
