#include "core/meshes/gmsh/gmsh_reader.h"

#include <fmt/format.h>

#include <array>
#include <span>

namespace dartboard {

Eigen::Vector3d read_gmsh_coordinates(GmshNumbers& numbers, std::uint64_t node) {
  Eigen::Vector3d x;
  for (int k = 0; k < 3; ++k) x[k] = numbers.real({"a coordinate of node", node});
  return x;
}

const GmshElement& read_gmsh_element_type(GmshNumbers& numbers) {
  const std::uint64_t type = numbers.count("an element type");
  const GmshElement* element = gmsh_element(type);
  if (element == nullptr)
    numbers.fail(fmt::format("found element type {}", type),
                 "a point (15), edge (1), triangle (2), quadrilateral (3), tetrahedron (4), hexahedron (5), prism (6), "
                 "pyramid (7), or one of these of higher order");
  return *element;
}

void read_gmsh_element(GmshReader& r, const GmshElement& element, std::uint64_t number, std::int64_t group,
                       std::int64_t entity) {
  const std::size_t line = r.numbers.line();
  const bool has_wide_numbers = r.version == GmshVersion::v41;
  std::array<std::uint64_t, 125> nodes{};
  for (auto& node : std::span(nodes).first(static_cast<std::size_t>(element.nodes)))
    node = has_wide_numbers ? r.numbers.size({"a node of element", number})
                            : r.numbers.count({"a node of element", number});
  if (!element.kind) return r.builder.skip(element.dimension);
  const std::size_t cell = r.builder.cell_count();
  r.builder.add_cell(*element.kind, std::span(nodes).first(static_cast<std::size_t>(node_count(*element.kind))), line,
                     element.is_first_order() ? std::string_view{} : element.name);
  r.builder.tags().set(r.group_column, cell, group);
  r.builder.tags().set(r.entity_column, cell, entity);
}

}  // namespace dartboard
