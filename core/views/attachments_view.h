#pragma once
// The attachments of a body, as they follow every change of the topology.

#include <cstdint>
#include <vector>

#include "core/elements/attachments.h"
#include "core/views/followed_cells.h"

namespace dartboard {

/// One row for each vertex at an attached point of the mesh. Each part of a vertex that comes apart has a row of its
/// own; the corner that a row refers to is the part in the cell that it is attached to, so that it stays at its cell
/// whatever is cut around that. A cell that is removed takes its attachments along.
///
/// pre  the body is not refined
class AttachmentsView {
 public:
  AttachmentsView() = default;
  AttachmentsView(std::vector<Attachment> attachments, FollowedCells::MeshCell mesh_cell);

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
    archive(rows, links_, first_of_vertex_, first_of_attachment_, targets_);
  }
  std::size_t bytes() const;
  void shrink_to_fit();

 private:
  static constexpr std::uint32_t nothing = FollowedCells::nothing;

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
  void set_corners(AttachedVertex& row, const Attachment& attachment) const;
  struct References {
    std::uint32_t &of_vertex, &of_attachment;
  };
  References references(std::uint32_t row);

  // constant
  std::vector<Attachment> attachments_;   // ascending by point
  std::vector<std::uint32_t> by_target_;  // numbers of attachments to cells, ascending by target
  std::vector<std::uint32_t> target_;     // by attachment: its target; nothing for a fixed place
  std::vector<std::uint32_t> first_{0};   // of each target in by_target_, and the end

  // in step with the body
  FollowedCells targets_;                           // the cells that some are attached to
  std::vector<Link> links_;                         // by row
  std::vector<std::uint32_t> first_of_vertex_;      // row, by vertex
  std::vector<std::uint32_t> first_of_attachment_;  // row, by attachment

  // scratch, kept between calls
  std::vector<std::uint32_t> touched_;
  std::vector<FollowedCells::Corner> corners_;
};

#define DARTBOARD_ATTACHMENTS(prefix, Map)                                                        \
  prefix template void AttachmentsView::rebuild(const MassSpringBody<Map, Held::by_every_dart>&); \
  prefix template void AttachmentsView::apply(const MassSpringBody<Map, Held::by_every_dart>&,    \
                                              const ChangedEmbeddings&);
DARTBOARD_ATTACHMENTS(extern, Map2)
DARTBOARD_ATTACHMENTS(extern, Map3)
DARTBOARD_ATTACHMENTS(extern, TetMap)

}  // namespace dartboard
