#pragma once
// From numbered points and elements, as files list them, to a mesh of one dimension.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/meshes/formats/cell_tags_builder.h"
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
  /// Add a cell by its corners; `element` is its name when it has more nodes. A line of 0 means no line.
  void add_cell(CellKind kind, std::span<const std::uint64_t> corners, std::size_t line, std::string_view element = {});
  std::size_t cell_count() const { return kinds_.size(); }
  /// Take a cell that was added out of the mesh again.
  void leave_out(std::size_t cell);
  std::size_t left_out_count() const { return left_out_count_; }
  /// Leave out each cell that has the kind and the points of earlier cells and, in the column `tags`, a number other
  /// than all of theirs: it is the same cell in a further group.
  ///
  /// returns  the number of cells left out
  std::size_t leave_out_further_groups(std::size_t tags);
  /// Count elements of dimension 0 or 1, which no body is made of.
  void skip(int dimension, std::uint64_t count = 1) { skipped_.at(static_cast<std::size_t>(dimension)) += count; }
  void add_notice(std::string notice) { notices_.push_back(std::move(notice)); }
  /// Report so many points of two coordinates, if any.
  void notice_plane(std::uint64_t points);
  /// Report a section of which nothing is kept; each name once.
  void skip_section(std::string_view name);
  /// The tags of cells, by their places in the order in which they were added.
  CellTagsBuilder& tags() { return tags_; }

  /// The mesh of the cells with the highest dimension, with its notices; "no cells" is reported in the last line of
  /// `text`.
  ///
  /// throws  IoError for an undefined or twice defined point, and a mesh without cells
  LoadedMesh finish(std::string format, std::string_view text);
  /// The line of each cell of the finished mesh.
  const std::vector<std::uint32_t>& cell_lines() const { return cell_lines_; }

 private:
  std::vector<std::uint32_t> number_points();
  std::uint32_t find_point(std::uint64_t number, std::span<const std::uint32_t> by_number) const;
  void notice_sections();
  std::string skipped_notice(int dimension, std::size_t kept) const;
  std::string straightened_notice(int dimension) const;
  std::map<std::string_view, std::size_t> count_elements(auto&& is_counted) const;
  bool is_left_out(std::size_t cell) const { return cell < left_out_.size() && left_out_[cell]; }

  std::string point_file_, cell_file_;
  std::vector<std::uint64_t> point_numbers_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<std::uint32_t> point_lines_;
  std::vector<CellKind> kinds_;
  std::vector<std::uint8_t> elements_;          // by cell: the number of its name, or 0
  std::vector<std::string> element_names_{""};  // of higher order
  std::vector<std::uint64_t> cell_points_;      // back to back
  std::vector<std::uint32_t> all_cell_lines_, cell_lines_;
  std::vector<bool> left_out_;  // by cell, up to the last one left out
  std::size_t left_out_count_ = 0;
  std::array<std::uint64_t, 2> skipped_{};  // points, edges
  std::vector<std::string> skipped_sections_;
  std::set<std::string> known_sections_;  // the same in small letters
  std::vector<std::string> notices_;
  CellTagsBuilder tags_;
};

}  // namespace dartboard
