#include "core/views/attachments_view.h"

#include <algorithm>
#include <utility>

#include "core/base/bytes.h"

namespace dartboard {

AttachmentsView::AttachmentsView(std::vector<Attachment> attachments, FollowedCells::MeshCell mesh_cell)
    : attachments_(std::move(attachments)) {
  std::ranges::stable_sort(attachments_, {}, &Attachment::point);
  std::vector<std::uint32_t> cells;
  for (std::uint32_t k = 0; k < attachments_.size(); ++k)
    if (attachments_[k].has_cell()) {
      cells.push_back(attachments_[k].cell);
      by_target_.push_back(k);
    }
  targets_ = FollowedCells(std::move(cells), std::move(mesh_cell));
  for (const Attachment& one : attachments_) target_.push_back(one.has_cell() ? targets_.place_of(one.cell) : nothing);
  std::ranges::stable_sort(by_target_, {}, [this](std::uint32_t k) { return target_[k]; });
  first_.assign(targets_.size() + 1, 0);
  for (const std::uint32_t k : by_target_) ++first_[target_[k] + 1];
  for (std::size_t t = 0; t < targets_.size(); ++t) first_[t + 1] += first_[t];
}

template <class Body>
void AttachmentsView::rebuild(const Body& body) {
  rows.clear();
  links_.clear();
  first_of_vertex_.assign(body.vertices.size(), nothing);
  first_of_attachment_.assign(attachments_.size(), nothing);
  targets_.rebuild(body);
  for (std::uint32_t k = 0; k < body.vertices.size(); ++k) add_rows(body, k);
  for (std::uint32_t t = 0; t < targets_.size(); ++t) find_corners(body, t);
}

template <class Body>
void AttachmentsView::apply(const Body& body, const ChangedEmbeddings& changed) {
  // columns by number follow as `ChangedEmbeddings` says
  targets_.apply(changed, [this](std::uint32_t target) { erase_target(target); });
  first_of_vertex_.resize(changed.vertex_count + changed.moved_vertices.size(), nothing);
  for (const auto& [from, to] : changed.moved_vertices) {
    while (first_of_vertex_[to] != nothing) erase(first_of_vertex_[to]);
    if (from != to) {
      first_of_vertex_[to] = first_of_vertex_[from];
      for (std::uint32_t row = first_of_vertex_[to]; row != nothing; row = links_[row].next_of_vertex)
        rows[row].nodes[0] = to;
    }
    first_of_vertex_.pop_back();
  }

  // new parts get their rows; corners in the cells around changed vertices may be other vertices now
  touched_.clear();
  Mark seen(body.map);
  for (const std::uint32_t k : changed.vertices) {
    add_rows(body, k);
    for (std::uint32_t row = first_of_vertex_[k]; row != nothing; row = links_[row].next_of_vertex)
      if (const std::uint32_t target = target_[links_[row].attachment]; target != nothing) touched_.push_back(target);
    targets_.for_each_around(body, k, seen, [this](std::uint32_t target) { touched_.push_back(target); });
  }
  std::ranges::sort(touched_);
  touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
  for (const std::uint32_t target : touched_) find_corners(body, target);
}

/// The rows that a vertex lacks; their corners are left to `find_corners`.
template <class Body>
void AttachmentsView::add_rows(const Body& body, std::uint32_t vertex) {
  const std::uint32_t point = body.vertices.point[vertex];
  for (auto one = std::ranges::lower_bound(attachments_, point, {}, &Attachment::point);
       one != attachments_.end() && one->point == point; ++one) {
    const auto number = static_cast<std::uint32_t>(one - attachments_.begin());
    if (target_[number] != nothing && !targets_.is_there(target_[number])) continue;
    bool is_there = false;
    for (std::uint32_t row = first_of_vertex_[vertex]; row != nothing; row = links_[row].next_of_vertex)
      is_there = is_there || links_[row].attachment == number;
    if (is_there) continue;
    const auto row = static_cast<std::uint32_t>(rows.size());
    rows.push_back(attached(*one, vertex));
    links_.push_back({number, first_of_vertex_[vertex], first_of_attachment_[number]});
    first_of_vertex_[vertex] = first_of_attachment_[number] = row;
  }
}

template <class Body>
void AttachmentsView::find_corners(const Body& body, std::uint32_t target) {
  if (!targets_.is_there(target)) return;
  targets_.find_corners(body, target, corners_);
  for (std::uint32_t k = first_[target]; k < first_[target + 1]; ++k)
    for (std::uint32_t row = first_of_attachment_[by_target_[k]]; row != nothing; row = links_[row].next_of_attachment)
      set_corners(rows[row], attachments_[by_target_[k]]);
}

void AttachmentsView::set_corners(AttachedVertex& row, const Attachment& attachment) const {
  for (std::size_t a = 0; a < attachment.count; ++a)
    row.nodes[a + 1] = FollowedCells::vertex_at(corners_, attachment.corners[a]);
}

AttachmentsView::References AttachmentsView::references(std::uint32_t row) {
  std::uint32_t* of_vertex = &first_of_vertex_[rows[row].nodes[0]];
  while (*of_vertex != row) of_vertex = &links_[*of_vertex].next_of_vertex;
  std::uint32_t* of_attachment = &first_of_attachment_[links_[row].attachment];
  while (*of_attachment != row) of_attachment = &links_[*of_attachment].next_of_attachment;
  return {*of_vertex, *of_attachment};
}

/// The last row takes the place of the one erased.
void AttachmentsView::erase(std::uint32_t row) {
  const References erased = references(row);
  erased.of_vertex = links_[row].next_of_vertex;
  erased.of_attachment = links_[row].next_of_attachment;
  if (const auto last = static_cast<std::uint32_t>(rows.size() - 1); row != last) {
    const References moved = references(last);
    moved.of_vertex = moved.of_attachment = row;
    rows[row] = rows[last];
    links_[row] = links_[last];
  }
  rows.pop_back();
  links_.pop_back();
}

void AttachmentsView::erase_target(std::uint32_t target) {
  for (std::uint32_t k = first_[target]; k < first_[target + 1]; ++k)
    while (first_of_attachment_[by_target_[k]] != nothing) erase(first_of_attachment_[by_target_[k]]);
}

std::size_t AttachmentsView::bytes() const {
  return bytes_of(rows, attachments_, links_) + bytes_of(by_target_, target_, first_) +
         bytes_of(first_of_vertex_, first_of_attachment_) + targets_.bytes();
}

void AttachmentsView::shrink_to_fit() {
  const auto fit = [](auto&... columns) { (columns.shrink_to_fit(), ...); };
  fit(rows, attachments_, links_, targets_, by_target_, target_);
}

bool operator==(const AttachmentsView& a, const AttachmentsView& b) {
  if (a.rows.size() != b.rows.size() || a.targets_ != b.targets_) return false;
  const auto sorted = [](const AttachmentsView& view) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> order;  // the attachment, the row
    for (std::uint32_t row = 0; row < view.rows.size(); ++row) order.push_back({view.links_[row].attachment, row});
    std::ranges::sort(order, {},
                      [&view](const auto& one) { return std::pair(one.first, view.rows[one.second].nodes[0]); });
    return order;
  };
  return std::ranges::equal(sorted(a), sorted(b), [&](const auto& one, const auto& other) {
    return one.first == other.first && a.rows[one.second] == b.rows[other.second];
  });
}

DARTBOARD_ATTACHMENTS(, Map2)
DARTBOARD_ATTACHMENTS(, Map3)
DARTBOARD_ATTACHMENTS(, TetMap)

}  // namespace dartboard
