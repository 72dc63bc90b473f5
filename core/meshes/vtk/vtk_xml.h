#pragma once
// The parts of an XML VTK file of a grid: a root, pieces, points, cells, data of cells.

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/meshes/formats/mesh_builder.h"
#include "core/meshes/text/xml_elements.h"
#include "core/meshes/vtk/vtk_cells.h"
#include "core/meshes/vtk/vtu_array.h"

namespace dartboard {

struct VtkXml {
  const std::string& name;
  std::vector<XmlElement> elements;
  VtuEncoding encoding = {};

  /// The elements called <Piece>, by their numbers.
  ///
  /// throws  IoError when there are none
  std::vector<std::size_t> pieces() const;
  std::uint64_t count_attribute(const XmlElement& tag, std::string_view key) const;
};

/// The elements of a file whose root is <VTKFile type="UnstructuredGrid">; both `text` and `name` must outlive them.
VtkXml read_vtk_xml(std::string_view text, const std::string& name);

/// The arrays of one <Piece>.
struct VtkPiece {
  std::size_t line = 0;
  std::uint64_t points = 0;
  std::map<std::pair<std::string_view, std::string>, VtuArray> arrays = {};  // by list and name: ("Cells", "types")
  std::vector<VtuArray> tags = {};                                           // of cells, one whole number each

  /// throws  IoError when it does not exist
  const VtuArray& array(std::string_view list, const std::string& key, const VtkXml& file) const;
};

/// Find <Points>, <Cells>, and the whole numbers of cells; other arrays, results for instance, may be in any format.
VtkPiece find_vtk_piece(const VtkXml& file, std::size_t number);

/// Add the points of a piece, numbered after the present ones; returns the number of the first.
std::uint64_t add_vtk_points(const VtkXml& file, const VtkPiece& piece, MeshBuilder& builder);

/// The cells of a piece: the points of all cells, and the end of each.
struct VtkXmlCells {
  std::size_t line = 0;
  std::vector<std::int64_t> connectivity, offsets;

  std::span<const std::int64_t> points(std::size_t c) const {
    const std::int64_t first = c == 0 ? 0 : offsets[c - 1];
    return std::span(connectivity)
        .subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(offsets[c] - first));
  }
};

/// throws  IoError unless there are `count` offsets, which grow from 0 to the number of points
VtkXmlCells read_vtk_cells(const VtkXml& file, const VtkPiece& piece, std::uint64_t count);

/// Integers, one for each of `count` cells.
std::vector<std::int64_t> read_vtk_integers(const VtkXml& file, const VtuArray& array, std::uint64_t count);

/// Give the cells of a piece the whole numbers that come with them.
void tag_vtk_cells(const VtkXml& file, const VtkPiece& piece, const VtkCellPlaces& places, MeshBuilder& builder);

}  // namespace dartboard
