#pragma once
// The attachments of a body, as they follow every change of the topology.

#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "core/elements/attachments.h"
#include "core/mechanics/adapt.h"

namespace dartboard {

/// One row for each vertex at an attached point of the mesh. Each part of a vertex that comes apart has a row of its
/// own; the corner that a row refers to is the part in the cell that it is attached to, so that it stays at its cell
/// whatever is cut around that. A cell that is removed takes its attachments along.
///
/// pre  the body is not refined
class AttachmentsView {
 public:
  /// The cell of the mesh that a cell of the body is, by its number.
  using MeshCell = std::function<std::uint32_t(std::uint32_t)>;

  AttachmentsView() = default;
  AttachmentsView(std::vector<Attachment> attachments, MeshCell mesh_cell);

  std::vector<AttachedVertex> rows;

  /// cost    O(vertices + cells)
  template <class Body>
  void rebuild(const Body& body);

  /// Follow what `adapt` reports; gives what `rebuild` would, but for the order of the rows.
  ///
  /// cost    O(changed vertices and cells, the cells around changed vertices, and what is attached to these), whatever
  ///         the size of the body
  template <class Body>
  void apply(const Body& body, const ChangedEmbeddings& changed);

  /// Have both the same rows, in whatever order?
  friend bool operator==(const AttachmentsView& a, const AttachmentsView& b);

  template <class Archive>
  void state(Archive& archive) {
    archive(rows, links_, first_of_vertex_, first_of_attachment_, cell_of_target_, target_of_cell_);
  }
  std::size_t bytes() const;
  void shrink_to_fit();

 private:
  static constexpr std::uint32_t nothing = std::numeric_limits<std::uint32_t>::max();

  /// The attachment of a row, and the next row of two lists: of its vertex, and of its attachment.
  struct Link {
    std::uint32_t attachment = nothing, next_of_vertex = nothing, next_of_attachment = nothing;
    template <class Archive>
    void state(Archive& archive) {
      archive(attachment, next_of_vertex, next_of_attachment);
    }
  };

  template <class Body>
  void add_rows(const Body& body, std::uint32_t vertex);
  template <class Body>
  void find_corners(const Body& body, std::uint32_t target);
  void erase(std::uint32_t row);
  void erase_target(std::uint32_t target);
  std::uint32_t target_of(std::uint32_t mesh_cell) const;
  void set_corners(AttachedVertex& row, const Attachment& attachment) const;
  struct References {
    std::uint32_t &of_vertex, &of_attachment;
  };
  References references(std::uint32_t row);

  // constant
  std::vector<Attachment> attachments_;  // ascending by point
  MeshCell mesh_cell_;
  std::vector<std::uint32_t> targets_;    // the cells of the mesh that some are attached to, ascending
  std::vector<std::uint32_t> by_target_;  // numbers of attachments to cells, ascending by target
  std::vector<std::uint32_t> target_;     // by attachment: its target; nothing for a fixed place
  std::vector<std::uint32_t> first_{0};   // of each target in by_target_, and the end

  // in step with the body
  std::vector<Link> links_;                         // by row
  std::vector<std::uint32_t> first_of_vertex_;      // row, by vertex
  std::vector<std::uint32_t> first_of_attachment_;  // row, by attachment
  std::vector<std::uint32_t> cell_of_target_;       // of the body; nothing where it was removed
  std::vector<std::uint32_t> target_of_cell_;       // by cell of the body; empty without targets

  // scratch, kept between calls
  std::vector<std::uint32_t> touched_;
  struct Corner {
    std::uint32_t point, vertex;
  };
  std::vector<Corner> corners_;
};

#define DARTBOARD_ATTACHMENTS(prefix, Map)                                                        \
  prefix template void AttachmentsView::rebuild(const MassSpringBody<Map, Held::by_every_dart>&); \
  prefix template void AttachmentsView::apply(const MassSpringBody<Map, Held::by_every_dart>&,    \
                                              const ChangedEmbeddings&);
DARTBOARD_ATTACHMENTS(extern, Map2)
DARTBOARD_ATTACHMENTS(extern, Map3)
DARTBOARD_ATTACHMENTS(extern, TetMap)

}  // namespace dartboard
