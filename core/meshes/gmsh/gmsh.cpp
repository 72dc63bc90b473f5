#include "core/meshes/gmsh/gmsh.h"

#include <fmt/format.h>

#include "core/base/counted.h"
#include "core/meshes/gmsh/gmsh_reader.h"
#include "core/meshes/text/letter_case.h"

namespace dartboard {
namespace {

std::string end_of(std::string_view section) { return fmt::format("$END{}", upper(section.substr(1))); }

// versions differ in the case of section names ($ENDNOD, $EndNodes), and so do their writers
void end_section(TextScanner& scan, std::string_view section) {
  const std::string wanted = fmt::format("the end of the section {}", section);
  const std::string_view found = scan.token(wanted.c_str());
  if (upper(found) != end_of(section)) scan.fail(fmt::format("found {}", in_quotes(found)), wanted);
}

void skip_section(GmshReader& r, const std::string& section) {
  const std::string end = end_of(section);
  const std::string wanted = fmt::format("the end of the section {}", section);
  // words cannot be recognised among bytes, and versions with bytes write $End
  if (r.numbers.is_binary()) r.scan.skip_to(fmt::format("$End{}", section.substr(1)));
  while (upper(r.scan.token(wanted.c_str())) != end) continue;
}

void read_format(GmshReader& r) {
  const std::string_view text = r.scan.token("the version of the format");
  r.version_text = text;
  if (text == "2" || text.starts_with("2.")) r.version = GmshVersion::v2;
  if (text == "4" || text == "4.0") r.version = GmshVersion::v40;
  if (text == "4.1") r.version = GmshVersion::v41;
  if (r.version == GmshVersion::unknown)
    r.scan.fail(fmt::format("version {}", in_quotes(text)), "version 1, 2.x, 4.0 or 4.1");
  const std::uint64_t type = r.scan.count("the file type");
  if (type > 1) r.scan.fail(fmt::format("file type {}", type), "file type 0 (text) or 1 (binary)");
  const std::uint64_t size = r.scan.count("the size of a real number");
  if (type == 0) return;
  if (size != 8) r.scan.fail(fmt::format("numbers of {} bytes", size), "8 bytes");
  r.scan.line_end();
  const std::string_view one = r.scan.bytes(4, "the number 1, which gives the order of bytes");
  const bool big_endian = load<std::int32_t>(one, true) == 1;
  if (!big_endian && load<std::int32_t>(one, false) != 1)
    fail_at_byte(r.scan.file(), r.scan.place() - 4, fmt::format("found {}", in_quotes(one)),
                 "the number 1, which gives the order of bytes");
  r.numbers.set_binary(big_endian);
}

/// Names are text also in binary files: a dimension, a number and a name in quotes on every line.
void read_physical_names(GmshReader& r) {
  const std::uint64_t count = r.scan.count("the number of physical names");
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t dimension = r.scan.count("the dimension of a physical group");
    if (dimension > 3) r.scan.fail(fmt::format("dimension {}", dimension), "a dimension from 0 to 3");
    const std::int64_t number = r.scan.integer("the number of a physical group");
    const std::string_view name = r.scan.rest_of_line();
    if (name.size() < 2 || name.front() != '"' || name.back() != '"')
      r.scan.fail(fmt::format("found {}", in_quotes(name)), "the name of a physical group, in double quotes");
    r.builder.tags().name_value(r.group_column, static_cast<int>(dimension), number,
                                std::string(name.substr(1, name.size() - 2)));
  }
}

void read_nodes_or_elements(GmshReader& r, const std::string& section, bool is_nodes) {
  switch (r.version) {
    case GmshVersion::v2: return is_nodes ? read_gmsh_node_list(r) : read_gmsh_element_list(r);
    case GmshVersion::v40:
    case GmshVersion::v41: return is_nodes ? read_gmsh_node_blocks(r) : read_gmsh_element_blocks(r);
    case GmshVersion::unknown:
    case GmshVersion::v1: break;
  }
  r.scan.fail(fmt::format("found {}", section), "$MeshFormat before it");
}

void read_section(GmshReader& r, const std::string& section) {
  const std::string name = upper(section);
  const bool is_version_4 = r.version == GmshVersion::v40 || r.version == GmshVersion::v41;
  if (name == "$NODES" || name == "$ELEMENTS") {
    read_nodes_or_elements(r, section, name == "$NODES");
  } else if (name == "$NOD" || name == "$ELM") {
    if (r.numbers.is_binary())
      r.scan.fail(fmt::format("found {}", section), "no section of version 1 in a binary file");
    r.version = GmshVersion::v1;
    r.version_text = "1";
    name == "$NOD" ? read_gmsh_node_list(r) : read_gmsh_element_list(r);
  } else if (name == "$MESHFORMAT") {
    if (r.numbers.is_binary()) r.scan.fail(fmt::format("found {} again", section), "it once");
    read_format(r);
  } else if (name == "$PHYSICALNAMES") {
    read_physical_names(r);
  } else if ((name == "$ENTITIES" || name == "$PARTITIONEDENTITIES") && is_version_4) {
    read_gmsh_entities(r, name != "$ENTITIES");
  } else {
    return skip_section(r, section);
  }
  end_section(r.scan, section);
}

}  // namespace

std::string read_gmsh(std::string_view text, MeshBuilder& builder) {
  TextScanner scan(text, builder.cell_file());
  GmshReader r{.scan = scan,
               .builder = builder,
               .numbers = GmshNumbers(scan),
               .group_column = builder.tags().column("physical group", true),
               .entity_column = builder.tags().column("entity", true)};
  while (!scan.at_end()) {
    const std::string_view found = scan.token("a section");
    if (found.size() < 2 || found[0] != '$')
      scan.fail(fmt::format("found {}", in_quotes(found)), "a section, such as $MeshFormat, $Nodes or $NOD");
    read_section(r, std::string(found));
  }
  // version 4 names the groups of an entity, others list an element once for each of its groups
  if (r.version == GmshVersion::v1 || r.version == GmshVersion::v2)
    if (const std::size_t again = builder.leave_out_further_groups(r.group_column); again != 0)
      builder.add_notice(fmt::format("{} listed again in a further physical group: only the first is kept",
                                     again == 1 ? "1 element is" : fmt::format("{} elements are", again)));
  if (r.further_groups != 0)
    builder.add_notice(
        fmt::format("{} in more than one physical group: only the first is kept",
                    r.further_groups == 1 ? "1 entity is" : fmt::format("{} entities are", r.further_groups)));
  return fmt::format("Gmsh MSH {}{}", r.version_text, r.numbers.is_binary() ? " binary" : "");
}

}  // namespace dartboard
