#include <fmt/format.h>

#include "core/meshes/gmsh/gmsh_reader.h"

namespace dartboard {
namespace {

/// The tags of an element: its physical group, the entity that it lies on, and others.
void read_tags_and_nodes(GmshReader& r, const GmshElement& element, std::uint64_t number, std::uint64_t tags) {
  std::int64_t group = 0, entity = 0;
  for (std::uint64_t k = 0; k < tags; ++k) {
    const std::int64_t tag = r.numbers.integer({"a tag of element", number});
    if (k == 0) group = tag;
    if (k == 1) entity = tag;
  }
  read_gmsh_element(r, element, number, group, entity);
}

void read_first_version(GmshReader& r, std::uint64_t count) {
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t number = r.numbers.count("the number of an element");
    const GmshElement& element = read_gmsh_element_type(r.numbers);
    const std::int64_t group = r.numbers.integer({"the physical region of element", number});
    const std::int64_t entity = r.numbers.integer({"the elementary region of element", number});
    const std::uint64_t nodes = r.numbers.count({"the number of nodes of element", number});
    if (nodes != static_cast<std::uint64_t>(element.nodes))
      r.numbers.fail(fmt::format("{} nodes in a {}", nodes, element.name), fmt::format("{}", element.nodes));
    read_gmsh_element(r, element, number, group, entity);
  }
}

void read_text(GmshReader& r, std::uint64_t count) {
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t number = r.numbers.count("the number of an element");
    const GmshElement& element = read_gmsh_element_type(r.numbers);
    const std::uint64_t tags = r.numbers.count({"the number of tags of element", number});
    read_tags_and_nodes(r, element, number, tags);
  }
}

/// Type and number of tags are given once for all elements that follow.
void read_binary(GmshReader& r, std::uint64_t count) {
  for (std::uint64_t i = 0; i < count;) {
    const GmshElement& element = read_gmsh_element_type(r.numbers);
    const std::uint64_t together = r.numbers.count("the number of elements that follow");
    if (together == 0 || together > count - i)
      r.numbers.fail(fmt::format("{} elements follow", together), fmt::format("1 to {}", count - i));
    const std::uint64_t tags = r.numbers.count("the number of tags");
    for (std::uint64_t k = 0; k < together; ++k, ++i) {
      const std::uint64_t number = r.numbers.count("the number of an element");
      read_tags_and_nodes(r, element, number, tags);
    }
  }
}

}  // namespace

void read_gmsh_node_list(GmshReader& r) {
  const std::uint64_t count = r.scan.count("the number of nodes");
  r.numbers.begin();
  r.builder.reserve_points(r.numbers.plausible(count, 28, 8));
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t number = r.numbers.count("the number of a node");
    const std::size_t line = r.numbers.line();
    r.builder.add_point(number, read_gmsh_coordinates(r.numbers, number), line);
  }
}

void read_gmsh_element_list(GmshReader& r) {
  const std::uint64_t count = r.scan.count("the number of elements");
  r.numbers.begin();
  if (r.version == GmshVersion::v1)
    read_first_version(r, count);
  else
    r.numbers.is_binary() ? read_binary(r, count) : read_text(r, count);
}

}  // namespace dartboard
