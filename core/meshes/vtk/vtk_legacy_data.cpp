#include "core/meshes/vtk/vtk_legacy_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "core/meshes/text/letter_case.h"
#include "core/meshes/vtk/vtk_legacy_types.h"

namespace dartboard {
namespace {

constexpr std::string_view keywords[] = {
    "POINTS",  "CELLS",    "CELL_TYPES",      "METADATA",      "FIELD",        "VERTICES",
    "LINES",   "POLYGONS", "TRIANGLE_STRIPS", "POINT_DATA",    "CELL_DATA",    "SCALARS",
    "VECTORS", "NORMALS",  "TENSORS",         "COLOR_SCALARS", "LOOKUP_TABLE", "TEXTURE_COORDINATES"};

bool is_keyword(std::string_view word) { return std::ranges::find(keywords, upper(word)) != std::end(keywords); }

/// Data of POINT_DATA or CELL_DATA, one tuple for each of `count` points or cells.
struct Data {
  TextScanner& scan;
  FileNumbers& numbers;
  const VtkCellPlaces& places;
  MeshBuilder& builder;
  bool is_of_cells = false;
  std::uint64_t count = 0;
};

void read_values(Data& d, std::string_view name, Scalar type, std::uint64_t components, std::uint64_t tuples) {
  const std::string what = fmt::format("a value of {}", in_quotes(name));
  d.numbers.begin();
  const bool is_tag = d.is_of_cells && !is_real(type) && components == 1 && tuples == d.places.count();
  if (!is_tag) {
    for (std::uint64_t k = 0; k < components; ++k) d.numbers.skip(type, tuples, what.c_str());
    return;
  }
  std::vector<std::int64_t> values;
  values.reserve(d.numbers.plausible(tuples, size_of(type), 2));
  for (std::uint64_t k = 0; k < tuples; ++k) values.push_back(d.numbers.integer(type, {what, k}));
  d.places.tag(d.builder, name, values);
}

std::uint64_t checked_components(const TextScanner& scan, std::uint64_t components) {
  constexpr std::uint64_t most = 1u << 20;  // far beyond any number that occurs: a tensor has 9
  if (components > most) scan.fail(fmt::format("{} components", components), fmt::format("at most {}", most));
  return components;
}

/// The number of components that the rest of a line gives; one if it gives no number.
std::uint64_t read_components(TextScanner& scan) {
  return scan.more_on_line() ? checked_components(scan, scan.count("the number of components")) : 1;
}

void read_field(Data& d) {
  d.scan.token("the name of a field");
  const std::uint64_t arrays = d.scan.count("the number of arrays");
  for (std::uint64_t k = 0; k < arrays; ++k) {
    if (!d.scan.at_end() && same_letters(d.scan.peek(), "METADATA")) {
      d.scan.token("METADATA");
      skip_vtk_metadata(d.scan);
    }
    const std::string name(d.scan.token({"the name of array", k}));
    const std::uint64_t components = d.scan.count("the number of components");
    const std::uint64_t tuples = d.scan.count("the number of tuples");
    const std::string_view type_name = d.scan.token("the type of an array");
    if (const auto type = vtk_legacy_type(type_name)) {
      read_values(d, name, *type, tuples == 0 ? 0 : components, tuples);
    } else if (d.numbers.is_binary()) {
      d.scan.fail(fmt::format("an array of the type {} among bytes", in_quotes(type_name)), "a type of numbers");
    } else {
      while (!d.scan.at_end() && !is_keyword(d.scan.peek())) d.scan.token("the rest of a field");
      return;
    }
  }
}

/// Colours are bytes in a binary file and numbers from 0 to 1 in a text; no type is given.
void skip_colours(Data& d, std::uint64_t components, std::uint64_t tuples) {
  d.numbers.begin();
  for (std::uint64_t k = 0; k < components; ++k) d.numbers.skip(Scalar::uint8, tuples, "a colour");
}

/// Read one attribute, whose keyword was read; false when the keyword is not known.
bool read_attribute(Data& d, std::string_view keyword) {
  if (keyword == "FIELD") {
    read_field(d);
    return true;
  }
  if (keyword == "LOOKUP_TABLE" || keyword == "COLOR_SCALARS") {
    d.scan.token("the name of colours");
    const std::uint64_t number = d.scan.count("the number of colours, or of their components");
    keyword == "LOOKUP_TABLE" ? skip_colours(d, 4, number)
                              : skip_colours(d, checked_components(d.scan, number), d.count);
    return true;
  }
  const bool is_vector = keyword == "VECTORS" || keyword == "NORMALS";
  const bool is_index = keyword == "GLOBAL_IDS" || keyword == "PEDIGREE_IDS";
  const bool is_texture = keyword == "TEXTURE_COORDINATES", is_tensor = keyword == "TENSORS" || keyword == "TENSORS6";
  if (keyword != "SCALARS" && !is_tensor && !is_texture && !is_vector && !is_index) return false;
  const std::string name(d.scan.token("the name of data"));
  std::uint64_t components = is_vector ? 3 : keyword == "TENSORS" ? 9 : is_tensor ? 6 : 1;
  if (is_texture) components = checked_components(d.scan, d.scan.count("the number of texture coordinates"));
  const auto type = vtk_legacy_type(d.scan.token("the type of data"));
  if (!type) return false;
  if (keyword == "SCALARS") {
    components = read_components(d.scan);
    if (same_letters(d.scan.peek(), "LOOKUP_TABLE")) {
      d.scan.token("LOOKUP_TABLE");
      d.scan.token("the name of a lookup table");
    }
  }
  read_values(d, name, *type, components, d.count);
  return true;
}

}  // namespace

void skip_vtk_metadata(TextScanner& scan) {
  scan.rest_of_line();
  while (!scan.at_line_of_blanks() && !is_keyword(scan.peek())) {
    if (scan.at_end()) return;
    scan.rest_of_line();
  }
}

void skip_vtk_field(TextScanner& scan, FileNumbers& numbers) {
  MeshBuilder nothing("", "");
  const VtkCellPlaces nowhere;
  Data d{scan, numbers, nowhere, nothing};
  read_field(d);
}

void read_vtk_legacy_data(TextScanner& scan, FileNumbers& numbers, const VtkCellPlaces& places, MeshBuilder& builder) {
  Data d{scan, numbers, places, builder};
  while (!scan.at_end()) {
    const std::string keyword = upper(scan.token("data"));
    if (keyword == "METADATA") {
      skip_vtk_metadata(scan);
    } else if (keyword == "POINT_DATA" || keyword == "CELL_DATA") {
      d.is_of_cells = keyword == "CELL_DATA";
      d.count = scan.count("the number of points or cells");
      if (const std::uint64_t right = d.is_of_cells ? places.count() : builder.point_count(); d.count != right)
        scan.fail(fmt::format("{} for {}", keyword, d.count), fmt::format("{}", right));
    } else if (!read_attribute(d, keyword)) {
      builder.add_notice(
          fmt::format("did not read the data from {} on: of a kind that is not known", in_quotes(keyword)));
      return;
    }
  }
}

}  // namespace dartboard
