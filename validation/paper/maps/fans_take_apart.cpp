#include "validation/paper/maps/fans_take_apart.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/operations/dissociate_all.h"
#include "core/operations/tear_fan.h"
#include "reference/dart_table.h"
#include "validation/conservation/subjects.h"
#include "validation/paper/maps/dart_table_of.h"

namespace dartboard {

FanOf core_fan() {
  return [](const TetMap& map, Dart d) { return fan(map, d); };
}

FanAnswers try_fans(const Mesh& mesh, const FanOf& fan) {
  Problem problem;
  problem.mesh = mesh;
  const Subject<TetMap> s(problem);
  const TetMap& map = s.body.map;
  const auto table = dart_table_of(map);
  const auto face = orbits(table, {0, 1, 3});

  // Whether the corner of d parts from that across alpha_3 when the faces of some darts are dissociated: according to
  // the witness, and to the report of the operation.
  struct Parted {
    bool witnessed, reported;
  };
  const auto part = [&](Dart d, const std::vector<Dart>& darts) {
    const Dart across = map.alpha<3>(d);
    RemainingCells left = s.cells;
    for (const Dart e : darts) left.dissociate(s.side(e));
    const auto whole = left.vertex(s.places.corner_of[d.index]);
    const bool together = std::ranges::find(whole, s.places.corner_of[across.index]) != whole.end();
    TetMap cut = map;
    dissociate_all(cut, std::span<const Dart>(darts));
    return Parted{!together, !same_cell<0>(cut, d, across)};
  };

  std::size_t faces = 0, faces_that_part = 0, fans = 0, fans_that_part = 0, closed = 0, at_surface = 0;
  bool as_reported = true, as_written = true;
  for (std::uint32_t side = 0; side < s.places.side.size(); ++side) {
    if (!s.cells.is_joined(side) || s.cells.opposite(side) < side) continue;
    ++faces;
    bool any = false;
    Dart d = s.places.side[side];
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
