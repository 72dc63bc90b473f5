#pragma once
// The remaining cells of a mesh after removals and dissociations: a witness that knows no dart.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/plain/mesh.h"
#include "core/plain/random.h"

namespace dartboard {

/// The sides of a cell of `kind`, each as a cycle of local nodes: the faces of a volume, the edges of a polygon.
std::span<const std::vector<int>> sides_of(CellKind kind);

/// The remaining cells of a mesh, and the sides by which they are still joined.
///
/// Two corners are one vertex where a chain of cells leads from one to the other through joined sides around the same
/// mesh point; edges likewise. Corner k of cell c has the number mesh.first[c] + k; sides (the order of `sides_of`) and
/// edges (each once, in the order in which the sides show them) are numbered through in the same way.
class RemainingCells {
 public:
  /// `mesh` must outlive it.
  /// throws  InputError if a side is shared by three cells
  explicit RemainingCells(const Mesh& mesh);

  void dissociate(std::uint32_t side);
  void remove(std::uint32_t cell);

  std::size_t count() const { return count_; }
  bool is_there(std::uint32_t cell) const { return there_[cell] != 0; }
  bool is_joined(std::uint32_t side) const { return opposite_[side] != side; }
  std::uint32_t opposite(std::uint32_t side) const { return opposite_[side]; }

  std::uint32_t cell_of_corner(std::uint32_t corner) const { return cell_of_corner_[corner]; }
  std::uint32_t first_side(std::uint32_t cell) const { return first_side_[cell]; }
  std::uint32_t first_edge(std::uint32_t cell) const { return first_edge_[cell]; }
  /// The corners at the ends of an edge of a cell.
  struct Ends {
    std::uint32_t a, b;
  };
  Ends ends(std::uint32_t edge) const { return ends_[edge]; }
  /// The corner, or the edge, of `cell` at the same mesh points.
  std::uint32_t same_corner(std::uint32_t corner, std::uint32_t cell) const;
  std::uint32_t same_edge(std::uint32_t edge, std::uint32_t cell) const;
  /// A side that is joined, drawn at random; nothing when there is none.
  std::optional<std::uint32_t> joined_side(SplitMix64& random) const;
  /// The size of a side at rest, the same bits on both sides: its area [m^2], in a surface the length [m] of an edge.
  double measure(std::uint32_t side) const { return measure_[side]; }

  /// The corners that form one vertex with `corner`, and the edges of cells that form one edge with `edge`.
  ///
  /// The results are valid until the next call.
  /// cost    O(cells around it)
  std::span<const std::uint32_t> vertex(std::uint32_t corner) const;
  std::span<const std::uint32_t> edge(std::uint32_t edge) const;

  /// Calls f(first corner or edge of the class, all of it).
  /// cost  O(cells)
  template <class F>
  void for_each_vertex(F&& f) const {
    for_each_class(
        first_corner(), [&](std::uint32_t k) { return vertex(k); }, f);
  }
  template <class F>
  void for_each_edge(F&& f) const {
    for_each_class(
        first_edge_, [&](std::uint32_t k) { return edge(k); }, f);
  }
  /// The cells connected with this one by joined sides, itself included.
  /// cost  O(mesh)
  std::vector<std::uint32_t> component(std::uint32_t cell) const;
  std::size_t count_components() const;
  std::size_t count_sides() const;  // two joined sides count as one

 private:
  std::span<const std::uint32_t> first_corner() const { return mesh_->first; }
  std::uint32_t corner_at(std::uint32_t cell, std::uint32_t point) const;
  std::uint32_t edge_at(std::uint32_t cell, std::uint32_t p, std::uint32_t q) const;
  bool has_point(std::uint32_t side, std::uint32_t point) const;

  template <class First, class Class, class F>
  void for_each_class(const First& first, Class&& class_of, F& f) const {
    std::vector<char> met(first.back(), 0);
    for (std::uint32_t c = 0; c < there_.size(); ++c)
      for (std::uint32_t k = first[c]; there_[c] && k < first[c + 1]; ++k) {
        if (met[k]) continue;
        const auto members = class_of(k);
        for (const std::uint32_t m : members) met[m] = 1;
        f(k, members);
      }
  }

  std::vector<std::uint32_t> component(std::uint32_t cell, std::vector<char>& met) const;

  const Mesh* mesh_;
  std::size_t count_;
  std::vector<char> there_;                             // by cell
  std::vector<std::uint32_t> first_side_, first_edge_;  // by cell, and the end
  std::vector<std::uint32_t> cell_of_corner_, cell_of_side_, cell_of_edge_;
  std::vector<std::uint32_t> opposite_;                   // by side; the side itself if nothing is joined there
  std::vector<std::uint32_t> first_point_, side_points_;  // the mesh points of side s: first_point_[s] .. [s + 1]
  std::vector<double> measure_;
  std::vector<Ends> ends_;
  mutable std::vector<std::uint32_t> found_;
};

}  // namespace dartboard
