#include "validation/paper/maps/fans_take_apart.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/operations/dissociate_all.h"
#include "core/operations/tear_fan.h"
#include "reference/dart_table.h"
#include "validation/conservation/mesh_places.h"
#include "validation/paper/maps/dart_table_of.h"

namespace dartboard {
namespace {

/// Whether two cells at a mesh point hold together around it when some sides are dissociated.
class Around {
 public:
  Around(const Mesh& mesh, const RemainingCells& cells) : mesh_(mesh), cells_(cells) {
    for (std::uint32_t c = 0; c < mesh.cell_count(); ++c)
      for (std::uint32_t s = cells.first_side(c); s < cells.first_side(c + 1); ++s) cell_of_.push_back(c);
  }

  std::uint32_t cell_of(std::uint32_t side) const { return cell_of_[side]; }

  bool together(std::uint32_t point, std::uint32_t from, std::uint32_t to, const std::set<std::uint32_t>& apart) const {
    std::vector<std::uint32_t> met{from};
    for (std::size_t at = 0; at < met.size(); ++at) {
      if (met[at] == to) return true;
      for (std::uint32_t side = cells_.first_side(met[at]); side < cells_.first_side(met[at] + 1); ++side) {
        if (!cells_.is_joined(side) || apart.contains(side) || !has(side, point)) continue;
        const std::uint32_t next = cell_of_[cells_.opposite(side)];
        if (std::ranges::find(met, next) == met.end()) met.push_back(next);
      }
    }
    return false;
  }

 private:
  bool has(std::uint32_t side, std::uint32_t point) const {
    const std::uint32_t c = cell_of_[side];
    return std::ranges::any_of(sides_of(mesh_.kinds[c])[side - cells_.first_side(c)],
                               [&](int k) { return mesh_.cell(c)[static_cast<std::size_t>(k)] == point; });
  }

  const Mesh& mesh_;
  const RemainingCells& cells_;
  std::vector<std::uint32_t> cell_of_;
};

}  // namespace

FanOf core_fan() {
  return [](const TetMap& map, Dart d) { return fan(map, d); };
}

FanAnswers try_fans(const Mesh& mesh, const FanOf& fan) {
  Problem problem;
  problem.mesh = mesh;
  const auto body = build_body<TetMap, Held::by_every_dart>(problem);
  const TetMap& map = body.map;
  const RemainingCells cells(mesh);
  const MeshPlaces places(body, mesh, cells);
  const Around around(mesh, cells);
  const auto table = dart_table_of(map);
  const auto face = orbits(table, {0, 1, 3});

  // Whether the corner of d parts from that across alpha_3 when the faces of some darts are dissociated: by the
  // witness, and by what the operation reports.
  struct Parted {
    bool witnessed, reported;
  };
  const auto part = [&](Dart d, const std::vector<Dart>& darts) {
    std::set<std::uint32_t> apart;
    for (const Dart e : darts)
      for (const Dart side : {e, map.alpha<3>(e)}) apart.insert(places.side_of[side.index]);
    const std::uint32_t side = places.side_of[d.index], point = mesh.nodes[places.corner_of[d.index]];
    const bool together = around.together(point, around.cell_of(side), around.cell_of(cells.opposite(side)), apart);
    TetMap cut = map;
    dissociate_all(cut, std::span<const Dart>(darts));
    return Parted{!together, !same_cell<0>(cut, d, map.alpha<3>(d))};
  };

  std::size_t faces = 0, faces_that_part = 0, fans = 0, fans_that_part = 0, closed = 0, at_surface = 0;
  bool as_reported = true, as_written = true;
  for (std::uint32_t side = 0; side < places.side.size(); ++side) {
    if (!cells.is_joined(side) || cells.opposite(side) < side) continue;
    ++faces;
    bool any = false;
    Dart d = places.side[side];
    for (int corner = 0; corner < 3; ++corner, d = map.alpha<0, 1>(d)) {
      const Parted alone = part(d, {d});
      any = any || alone.witnessed;
      const std::vector<Dart> darts = fan(map, d);
      const Parted whole = part(d, darts);
      as_reported = as_reported && alone.witnessed == alone.reported && whole.witnessed == whole.reported;
      ++fans;
      fans_that_part += whole.witnessed ? 1 : 0;

      const auto letter = reference::paper_fan(table, d.index);
      (letter.closed ? closed : at_surface) += 1;
      std::set<std::uint32_t> written, listed;
      for (const std::uint32_t e : letter.darts) written.insert(face[e]);
      for (const Dart e : darts) listed.insert(face[e.index]);
      as_written = as_written && written == listed && listed.size() == darts.size();
    }
    faces_that_part += any ? 1 : 0;
  }

  const char* agree = as_reported ? "" : ", NOT as the operation reports";
  FanAnswers answers;
  answers.one_face = {as_reported && faces > 0 && 10 * faces_that_part <= faces,
                      fmt::format("{} of {} inner faces, {:.1f} %{}", faces_that_part, faces,
                                  100.0 * static_cast<double>(faces_that_part) / static_cast<double>(faces), agree)};
  answers.whole_fan = {as_reported && fans > 0 && fans_that_part == fans,
                       fmt::format("{} of {} fans{}", fans_that_part, fans, agree)};
  answers.ends = {as_written && closed > 0 && at_surface > 0,
                  fmt::format("{} at the first dart, {} at the surface: {} by the letter", closed, at_surface,
                              as_written ? "the faces found" : "NOT the faces found")};
  return answers;
}

}  // namespace dartboard
