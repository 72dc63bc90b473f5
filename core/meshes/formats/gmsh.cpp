#include <fmt/format.h>

#include <array>
#include <utility>
#include <vector>

#include "core/meshes/formats/gmsh_elements.h"
#include "core/meshes/formats/mesh_formats.h"

namespace dartboard {
namespace {

enum class Version { unknown, v1, v2, v4 };

struct Reader {
  TextScanner& scan;
  MeshBuilder& builder;
  Version version = Version::unknown;
  std::string_view version_text = {};  // into the text, or a literal
};

std::string upper(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return out;
}

std::string end_of(std::string_view section) { return fmt::format("$END{}", upper(section.substr(1))); }

// versions differ in the case of section names ($ENDNOD, $EndNodes), and so do their writers
void end_section(TextScanner& scan, std::string_view section) {
  const std::string wanted = fmt::format("the end of the section {}", section);
  const std::string_view found = scan.token(wanted.c_str());
  if (upper(found) != end_of(section)) scan.fail(fmt::format("found {}", in_quotes(found)), wanted);
}

void skip_section(TextScanner& scan, const std::string& section) {
  const std::string end = end_of(section);
  const std::string wanted = fmt::format("the end of the section {}", section);
  while (upper(scan.token(wanted.c_str())) != end) continue;
}

void read_format(Reader& r) {
  const std::string_view text = r.scan.token("the version of the format");
  r.version_text = text;
  if (text == "2" || text.starts_with("2.")) r.version = Version::v2;
  if (text == "4.1") r.version = Version::v4;
  if (r.version == Version::unknown) r.scan.fail(fmt::format("version {}", in_quotes(text)), "version 1, 2.x or 4.1");
  const std::uint64_t type = r.scan.count("the file type");
  if (type != 0) r.scan.fail(fmt::format("file type {}, a binary file", type), "file type 0: save the mesh as ASCII");
  r.scan.count("the size of a real number");
}

Eigen::Vector3d read_coordinates(TextScanner& scan, std::uint64_t number) {
  Eigen::Vector3d x;
  for (int k = 0; k < 3; ++k) x[k] = scan.real({"a coordinate of node", number});
  return x;
}

const GmshElement& read_element_type(TextScanner& scan) {
  const std::uint64_t type = scan.count("an element type");
  const GmshElement* element = gmsh_element(type);
  if (element == nullptr)
    scan.fail(fmt::format("found element type {}", type),
              "a point (15), edge (1), triangle (2), quadrilateral (3), tetrahedron (4), hexahedron (5), prism (6) or "
              "pyramid (7)");
  return *element;
}

void read_element_nodes(Reader& r, const GmshElement& element, std::uint64_t number) {
  const std::size_t line = r.scan.line();
  std::array<std::uint64_t, 125> nodes{};
  const auto used = std::span(nodes).first(static_cast<std::size_t>(element.nodes));
  for (auto& node : used) node = r.scan.count({"a node of element", number});
  if (element.kind)
    r.builder.add_cell(*element.kind, used, line);
  else if (element.dimension < 2)
    r.builder.skip(element.dimension);
  else
    r.builder.add_higher_order(element.name, element.dimension, line);
}

// --- versions 1 and 2

void read_node_list(Reader& r) {
  const std::uint64_t count = r.scan.count("the number of nodes");
  r.builder.reserve_points(r.scan.plausible(count, 8));
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t number = r.scan.count("the number of a node");
    const std::size_t line = r.scan.line();
    r.builder.add_point(number, read_coordinates(r.scan, number), line);
  }
}

void read_element_list(Reader& r, Version version) {
  const std::uint64_t count = r.scan.count("the number of elements");
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t number = r.scan.count("the number of an element");
    const GmshElement& element = read_element_type(r.scan);
    if (version == Version::v1) {
      r.scan.integer({"the physical region of element", number});
      r.scan.integer({"the elementary region of element", number});
      const std::uint64_t nodes = r.scan.count({"the number of nodes of element", number});
      if (nodes != static_cast<std::uint64_t>(element.nodes))
        r.scan.fail(fmt::format("{} nodes in a {}", nodes, element.name), fmt::format("{}", element.nodes));
    } else {
      const std::uint64_t tags = r.scan.count({"the number of tags of element", number});
      for (std::uint64_t k = 0; k < tags; ++k) r.scan.integer({"a tag of element", number});
    }
    read_element_nodes(r, element, number);
  }
}

// --- version 4.1: blocks, each of one geometric entity

/// The two totals at the head of a section: blocks, and nodes or elements in all of them.
std::pair<std::uint64_t, std::uint64_t> read_totals(TextScanner& scan) {
  const std::uint64_t blocks = scan.count("the number of entity blocks");
  const std::uint64_t total = scan.count("the number of nodes or elements");
  scan.count("the smallest tag");
  scan.count("the largest tag");
  return {blocks, total};
}

void check_total(TextScanner& scan, std::uint64_t found, std::uint64_t declared) {
  if (found != declared)
    scan.fail(fmt::format("the blocks hold {}", found), fmt::format("{}, as declared for the section", declared));
}

void read_node_blocks(Reader& r) {
  const auto [blocks, total] = read_totals(r.scan);
  r.builder.reserve_points(r.scan.plausible(total, 8));
  std::uint64_t found = 0;
  std::vector<std::uint64_t> tags;
  for (std::uint64_t b = 0; b < blocks; ++b) {
    const std::uint64_t dimension = r.scan.count("the dimension of an entity");
    if (dimension > 3) r.scan.fail(fmt::format("dimension {}", dimension), "a dimension from 0 to 3");
    r.scan.integer("the tag of an entity");
    const std::uint64_t parametric = r.scan.count("whether nodes have parametric coordinates");
    if (parametric > 1) r.scan.fail(fmt::format("found {}", parametric), "0 or 1: nodes with parametric coordinates");
    const std::uint64_t count = r.scan.count("the number of nodes in the block");
    tags.clear();
    tags.reserve(r.scan.plausible(count, 8));
    for (std::uint64_t i = 0; i < count; ++i) tags.push_back(r.scan.count("the tag of a node"));
    for (const std::uint64_t tag : tags) {
      const Eigen::Vector3d x = read_coordinates(r.scan, tag);
      r.builder.add_point(tag, x, r.scan.line());
      for (std::uint64_t k = 0; k < parametric * dimension; ++k) r.scan.real({"a parameter of node", tag});
    }
    found += count;
  }
  check_total(r.scan, found, total);
}

void read_element_blocks(Reader& r) {
  const auto [blocks, total] = read_totals(r.scan);
  std::uint64_t found = 0;
  for (std::uint64_t b = 0; b < blocks; ++b) {
    r.scan.count("the dimension of an entity");
    r.scan.integer("the tag of an entity");
    const GmshElement& element = read_element_type(r.scan);
    const std::uint64_t count = r.scan.count("the number of elements in the block");
    for (std::uint64_t i = 0; i < count; ++i) {
      const std::uint64_t tag = r.scan.count("the tag of an element");
      read_element_nodes(r, element, tag);
    }
    found += count;
  }
  check_total(r.scan, found, total);
}

void read_section(Reader& r, const std::string& section) {
  const std::string name = upper(section);
  if (name == "$NODES" || name == "$ELEMENTS") {
    if (r.version != Version::v2 && r.version != Version::v4)
      r.scan.fail(fmt::format("found {}", section), "$MeshFormat before it");
    if (name == "$NODES")
      r.version == Version::v2 ? read_node_list(r) : read_node_blocks(r);
    else
      r.version == Version::v2 ? read_element_list(r, Version::v2) : read_element_blocks(r);
  } else if (name == "$NOD" || name == "$ELM") {
    r.version = Version::v1;
    r.version_text = "1";
    name == "$NOD" ? read_node_list(r) : read_element_list(r, Version::v1);
  } else if (name == "$MESHFORMAT") {
    read_format(r);
  } else {
    return skip_section(r.scan, section);
  }
  end_section(r.scan, section);
}

}  // namespace

std::string read_gmsh(std::string_view text, MeshBuilder& builder) {
  TextScanner scan(text, builder.cell_file());
  Reader r{scan, builder};
  while (!scan.at_end()) {
    const std::string_view found = scan.token("a section");
    if (found.size() < 2 || found[0] != '$')
      scan.fail(fmt::format("found {}", in_quotes(found)), "a section, such as $MeshFormat, $Nodes or $NOD");
    read_section(r, std::string(found));
  }
  return fmt::format("Gmsh MSH {}", r.version_text);
}

}  // namespace dartboard
