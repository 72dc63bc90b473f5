#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/meshes/gmsh/gmsh_reader.h"

namespace dartboard {
namespace {

/// The two totals at the head of a section: blocks, and nodes or elements in all of them.
std::pair<std::uint64_t, std::uint64_t> read_totals(GmshReader& r) {
  r.numbers.begin();
  const std::uint64_t blocks = r.numbers.size("the number of entity blocks");
  const std::uint64_t total = r.numbers.size("the number of nodes or elements");
  if (r.version == GmshVersion::v41) {
    r.numbers.size("the smallest tag");
    r.numbers.size("the largest tag");
  }
  return {blocks, total};
}

void check_total(const GmshNumbers& numbers, std::uint64_t found, std::uint64_t declared) {
  if (found != declared)
    numbers.fail(fmt::format("the blocks hold {}", found), fmt::format("{}, as declared for the section", declared));
}

struct Entity {
  std::uint64_t dimension;
  std::int64_t tag;
};

/// Version 4.0 has the tag first, 4.1 the dimension.
Entity read_entity(GmshReader& r) {
  Entity entity{};
  if (r.version == GmshVersion::v40) entity.tag = r.numbers.integer("the tag of an entity");
  entity.dimension = r.numbers.count("the dimension of an entity");
  if (entity.dimension > 3) r.numbers.fail(fmt::format("dimension {}", entity.dimension), "a dimension from 0 to 3");
  if (r.version == GmshVersion::v41) entity.tag = r.numbers.integer("the tag of an entity");
  return entity;
}

void read_coordinates_and_parameters(GmshReader& r, std::uint64_t tag, std::uint64_t parameters) {
  const Eigen::Vector3d x = read_gmsh_coordinates(r.numbers, tag);
  r.builder.add_point(tag, x, r.numbers.line());
  for (std::uint64_t k = 0; k < parameters; ++k) r.numbers.real({"a parameter of node", tag});
}

/// The numbers of partitions and of entities of ghosts, and the partition of each of these.
void skip_partitions(GmshReader& r) {
  r.numbers.size("the number of partitions");
  const std::uint64_t ghosts = r.numbers.size("the number of entities of ghosts");
  for (std::uint64_t k = 0; k < ghosts; ++k) {
    r.numbers.integer("the tag of an entity of ghosts");
    r.numbers.integer("the partition of an entity of ghosts");
  }
}

/// The entity that this one is a part of after partitioning, if it has its dimension: interfaces are parts of larger
/// ones.
std::optional<std::int64_t> read_parent(GmshReader& r, std::uint64_t dimension) {
  const std::int64_t of_dimension = r.numbers.integer("the dimension of the entity before partitioning");
  const std::int64_t tag = r.numbers.integer("the tag of the entity before partitioning");
  const std::uint64_t partitions = r.numbers.size("the number of partitions of an entity");
  for (std::uint64_t k = 0; k < partitions; ++k) r.numbers.integer("a partition of an entity");
  if (of_dimension != static_cast<std::int64_t>(dimension)) return {};
  return tag;
}

}  // namespace

/// Only the first physical group of each entity is used.
void read_gmsh_entities(GmshReader& r, bool are_partitioned) {
  constexpr std::int64_t largest = std::numeric_limits<std::int64_t>::max();
  r.numbers.begin();
  if (are_partitioned) skip_partitions(r);
  std::array<std::uint64_t, 4> counts{};
  for (auto& count : counts) count = r.numbers.size("the number of entities");
  for (std::uint64_t dimension = 0; dimension < 4; ++dimension)
    for (std::uint64_t i = 0; i < counts[dimension]; ++i) {
      const std::int64_t tag = r.numbers.integer("the tag of an entity");
      if (are_partitioned)
        if (const auto parent = read_parent(r, dimension))
          r.parent_of_entity.insert_or_assign({dimension, tag}, *parent);
      const int bounds = dimension == 0 && r.version == GmshVersion::v41 ? 3 : 6;
      for (int k = 0; k < bounds; ++k) r.numbers.real("a bound of an entity");
      const std::uint64_t groups = r.numbers.size("the number of physical groups of an entity");
      for (std::uint64_t k = 0; k < groups; ++k) {
        // a group with the other orientation has a negative number
        const std::int64_t group = r.numbers.integer("a physical group of an entity");
        if (k == 0) r.group_of_entity.insert_or_assign({dimension, tag}, std::max(group, -std::max(group, -largest)));
      }
      if (groups > 1 && dimension > 1 && !are_partitioned) ++r.further_groups;
      if (dimension == 0) continue;
      const std::uint64_t boundary = r.numbers.size("the number of entities at the boundary of an entity");
      for (std::uint64_t k = 0; k < boundary; ++k) r.numbers.integer("an entity at the boundary of an entity");
    }
}

void read_gmsh_node_blocks(GmshReader& r) {
  const auto [blocks, total] = read_totals(r);
  r.builder.reserve_points(r.numbers.plausible(total, 28, 8));
  std::uint64_t found = 0;
  std::vector<std::uint64_t> tags;
  for (std::uint64_t b = 0; b < blocks; ++b) {
    const std::uint64_t dimension = read_entity(r).dimension;
    const std::uint64_t parametric = r.numbers.count("whether nodes have parametric coordinates");
    if (parametric > 1)
      r.numbers.fail(fmt::format("found {}", parametric), "0 or 1: nodes with parametric coordinates");
    const std::uint64_t count = r.numbers.size("the number of nodes in the block");
    const std::uint64_t parameters = parametric * dimension;
    if (r.version == GmshVersion::v40) {
      for (std::uint64_t i = 0; i < count; ++i)
        read_coordinates_and_parameters(r, r.numbers.count("the tag of a node"), parameters);
    } else {
      tags.clear();
      tags.reserve(r.numbers.plausible(count, 32, 8));
      for (std::uint64_t i = 0; i < count; ++i) tags.push_back(r.numbers.size("the tag of a node"));
      for (const std::uint64_t tag : tags) read_coordinates_and_parameters(r, tag, parameters);
    }
    found += count;
  }
  check_total(r.numbers, found, total);
}

void read_gmsh_element_blocks(GmshReader& r) {
  const auto [blocks, total] = read_totals(r);
  std::uint64_t found = 0;
  for (std::uint64_t b = 0; b < blocks; ++b) {
    Entity entity = read_entity(r);
    const GmshElement& element = read_gmsh_element_type(r.numbers);
    const auto part = r.parent_of_entity.find({entity.dimension, entity.tag});
    if (part != r.parent_of_entity.end()) entity.tag = part->second;
    const auto group = r.group_of_entity.find({entity.dimension, entity.tag});
    const std::int64_t group_number = group == r.group_of_entity.end() ? 0 : group->second;
    const std::uint64_t count = r.numbers.size("the number of elements in the block");
    for (std::uint64_t i = 0; i < count; ++i) {
      const std::uint64_t tag = r.version == GmshVersion::v40 ? r.numbers.count("the tag of an element")
                                                              : r.numbers.size("the tag of an element");
      read_gmsh_element(r, element, tag, group_number, entity.tag);
    }
    found += count;
  }
  check_total(r.numbers, found, total);
}

}  // namespace dartboard
