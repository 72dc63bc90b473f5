#pragma once
// The data shared by the sections of a Gmsh file: version, numbers as text or bytes, and the groups of its elements.

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "core/meshes/bytes/file_numbers.h"
#include "core/meshes/formats/mesh_builder.h"
#include "core/meshes/gmsh/gmsh_elements.h"
#include "core/meshes/text/text_scanner.h"

namespace dartboard {

/// The numbers of a file by the types that Gmsh gives them.
class GmshNumbers : public FileNumbers {
 public:
  using FileNumbers::FileNumbers;

  std::int64_t integer(Wanted wanted) { return FileNumbers::integer(Scalar::int32, wanted); }
  std::uint64_t count(Wanted wanted) { return FileNumbers::count(Scalar::int32, wanted); }
  std::uint64_t size(Wanted wanted) { return FileNumbers::count(Scalar::uint64, wanted); }
  double real(Wanted wanted) { return FileNumbers::real(Scalar::float64, wanted); }
};

enum class GmshVersion { unknown, v1, v2, v40, v41 };

struct GmshReader {
  TextScanner& scan;
  MeshBuilder& builder;
  GmshNumbers numbers;
  GmshVersion version = GmshVersion::unknown;
  std::string_view version_text = {};  // into the text, or a literal
  std::size_t group_column, entity_column;
  using ByEntity = std::map<std::pair<std::uint64_t, std::int64_t>, std::int64_t>;  // by dimension and tag
  ByEntity group_of_entity = {};
  ByEntity parent_of_entity = {};    // before the mesh was partitioned
  std::uint64_t further_groups = 0;  // entities of more than one
};

Eigen::Vector3d read_gmsh_coordinates(GmshNumbers& numbers, std::uint64_t node);
const GmshElement& read_gmsh_element_type(GmshNumbers& numbers);
/// Read the nodes of an element and add it, with its physical group and its entity.
void read_gmsh_element(GmshReader& r, const GmshElement& element, std::uint64_t number, std::int64_t group,
                       std::int64_t entity);

// sections of versions 1 and 2: lists
void read_gmsh_node_list(GmshReader& r);
void read_gmsh_element_list(GmshReader& r);

// sections of version 4: blocks, each of one geometric entity
/// Those of a mesh or, after it was partitioned, their parts.
void read_gmsh_entities(GmshReader& r, bool are_partitioned);
void read_gmsh_node_blocks(GmshReader& r);
void read_gmsh_element_blocks(GmshReader& r);

}  // namespace dartboard
