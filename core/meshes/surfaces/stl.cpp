#include <fmt/format.h>

#include <array>
#include <map>

#include "core/base/counted.h"
#include "core/meshes/bytes/file_numbers.h"
#include "core/meshes/surfaces/surface_formats.h"
#include "core/meshes/text/letter_case.h"
#include "core/meshes/text/text_scanner.h"

namespace dartboard {
namespace {

constexpr std::size_t header_bytes = 84, facet_bytes = 50;

/// Facets added to a surface that has no points of its own: equal corners are one.
class Facets {
 public:
  explicit Facets(MeshBuilder& builder) : builder_(builder) {}

  std::uint64_t number(const Eigen::Vector3d& x, std::size_t line) {
    const auto [at, is_new] = numbers_.try_emplace({x[0], x[1], x[2]}, builder_.point_count());
    if (is_new) builder_.add_point(at->second, x, line);
    return at->second;
  }
  /// A facet with two equal corners is a line, which joins nothing: it is left out.
  void add(const std::array<std::uint64_t, 3>& nodes, std::size_t line) {
    if (nodes[0] == nodes[1] || nodes[1] == nodes[2] || nodes[2] == nodes[0])
      ++lines_;
    else
      add_polygon(builder_, nodes, line);
  }
  void note_lines() const {
    if (lines_ != 0) builder_.add_notice(fmt::format("left out {} with two equal corners", counted(lines_, "facet")));
  }

 private:
  MeshBuilder& builder_;
  std::map<std::array<double, 3>, std::uint64_t> numbers_;
  std::size_t lines_ = 0;
};

void read_facet(TextScanner& scan, Facets& facets, MeshBuilder& builder) {
  const std::size_t line = scan.line();
  scan.keyword("normal", LetterCase::any);
  // some writers have nan here, for facets without area; the corners are used instead
  for (int k = 0; k < 3; ++k) scan.token("a component of a normal");
  scan.keyword("outer", LetterCase::any);
  scan.keyword("loop", LetterCase::any);
  std::array<std::uint64_t, 3> nodes{};
  for (auto& node : nodes) {
    scan.keyword("vertex", LetterCase::any);
    Eigen::Vector3d x;
    for (int k = 0; k < 3; ++k) x[k] = scan.real({"a coordinate of facet", builder.cell_count()});
    node = facets.number(x, scan.line());
  }
  scan.keyword("endloop", LetterCase::any);
  scan.keyword("endfacet", LetterCase::any);
  facets.add(nodes, line);
}

/// A file may hold several solids, one after the other; each becomes a region of its own, with its name.
std::string read_text(std::string_view text, MeshBuilder& builder) {
  TextScanner scan(text, builder.cell_file());
  Facets facets(builder);
  const std::size_t column = builder.tags().column("solid", false);
  for (std::int64_t solid = 1; !scan.at_end(); ++solid) {
    scan.keyword("solid", LetterCase::any);
    builder.tags().name_value(column, 2, solid, std::string(scan.rest_of_line()));
    for (;;) {
      const std::string_view word = scan.token("facet or endsolid");
      if (same_letters(word, "endsolid")) break;
      if (!same_letters(word, "facet")) scan.fail(fmt::format("found {}", in_quotes(word)), "facet or endsolid");
      builder.tags().set(column, builder.cell_count(), solid);
      read_facet(scan, facets, builder);
    }
    scan.rest_of_line();  // the name again
  }
  facets.note_lines();
  return "STL";
}

std::string read_binary(std::string_view text, MeshBuilder& builder) {
  TextScanner scan(text, builder.cell_file());
  FileNumbers numbers(scan);
  numbers.set_binary(false);
  numbers.skip(Scalar::uint8, header_bytes - 4, "the header of a binary STL file");
  const std::uint64_t count = numbers.count(Scalar::uint32, "the number of facets");
  if (const std::uint64_t left = scan.left(); left != count * facet_bytes)
    numbers.fail(fmt::format("{} facets in {} bytes", count, left), fmt::format("{} bytes for each", facet_bytes));
  Facets facets(builder);
  for (std::uint64_t f = 0; f < count; ++f) {
    numbers.skip(Scalar::float32, 3, "a normal");
    std::array<std::uint64_t, 3> nodes{};
    for (auto& node : nodes) {
      Eigen::Vector3d x;
      for (int k = 0; k < 3; ++k) x[k] = numbers.real(Scalar::float32, {"a coordinate of facet", f});
      node = facets.number(x, 0);
    }
    numbers.skip(Scalar::uint16, 1, "the attribute of a facet");
    facets.add(nodes, 0);
  }
  facets.note_lines();
  return "STL binary";
}

/// Has the file the size that its number of facets implies? Binary files may begin with the word solid, too.
bool is_binary(std::string_view text) {
  if (text.size() < header_bytes) return false;
  return text.size() ==
         header_bytes + facet_bytes * std::size_t{load<std::uint32_t>(text.substr(header_bytes - 4), false)};
}

}  // namespace

std::string read_stl(std::string_view text, MeshBuilder& builder) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");  // blanks, and a byte order mark
  const bool begins_as_text = begin != text.npos && same_letters(text.substr(begin, 5), "solid");
  return is_binary(text) || !begins_as_text ? read_binary(text, builder) : read_text(text, builder);
}

}  // namespace dartboard
