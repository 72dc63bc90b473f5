#pragma once
// From numbered points and elements, as files list them, to a mesh of one dimension.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/meshes/formats/loaded_mesh.h"
#include "core/plain/mesh.h"

namespace dartboard {

/// Collects the points and elements of a file in any order, with the numbers that the file gives them.
class MeshBuilder {
 public:
  /// Errors of points name one file and errors of cells the other; mostly they are the same.
  MeshBuilder(std::string point_file, std::string cell_file);

  const std::string& point_file() const { return point_file_; }
  const std::string& cell_file() const { return cell_file_; }

  void reserve_points(std::size_t count);
  std::uint64_t point_count() const { return points_.size(); }
  void add_point(std::uint64_t number, const Eigen::Vector3d& x, std::size_t line);
  void add_cell(CellKind kind, std::span<const std::uint64_t> points, std::size_t line);
  /// Count elements of dimension 0 or 1, which no body is made of.
  void skip(int dimension, std::uint64_t count = 1) { skipped_.at(static_cast<std::size_t>(dimension)) += count; }
  /// Note an element of second or higher order; an error unless it is of lower dimension than the body.
  void add_higher_order(std::string_view name, int dimension, std::size_t line, std::uint64_t count = 1);

  /// The mesh of the cells with the highest dimension, with its notices; `last_line` is where "no cells" is reported.
  ///
  /// throws  IoError for an undefined or twice defined point, elements of higher order, and a mesh without cells
  LoadedMesh finish(std::string format, std::size_t last_line);
  /// The line of each cell of the finished mesh.
  const std::vector<std::uint32_t>& cell_lines() const { return cell_lines_; }

 private:
  struct HigherOrder {
    int dimension;
    std::size_t line;
    std::uint64_t count;
  };

  std::vector<std::uint32_t> number_points();
  std::uint32_t find_point(std::uint64_t number, std::span<const std::uint32_t> by_number) const;
  void check_order(int dimension) const;
  std::string skipped_notice(int dimension, std::size_t kept) const;

  std::string point_file_, cell_file_;
  std::vector<std::uint64_t> point_numbers_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<std::uint32_t> point_lines_;
  std::vector<CellKind> kinds_;
  std::vector<std::uint64_t> cell_points_;  // back to back
  std::vector<std::uint32_t> all_cell_lines_, cell_lines_;
  std::array<std::uint64_t, 2> skipped_{};  // points, edges
  std::map<std::string, HigherOrder, std::less<>> higher_order_;
};

}  // namespace dartboard
