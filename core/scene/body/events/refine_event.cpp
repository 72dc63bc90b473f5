#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "core/scene/body/events/cell_chooser.h"
#include "core/scene/body/events/ready.h"

namespace dartboard {
namespace {

// Only the tetrahedra of a solid are subdivided; other cells stay as they are.

template <class Map>
bool is_tetrahedron(const Map& map, Dart d) {
  if constexpr (Map::tetrahedral) return true;
  std::size_t darts = 0;
  for_each_dart_of(map, Volume{d}, [&darts](Dart) { ++darts; });
  return darts == 24;  // other cells of a solid have 32 and more
}

template <class Map>
bool has_tetrahedra(const ChangingBody<Map>& on) {
  const auto& body = on.body();
  return std::ranges::any_of(body.cell_dart, [&](Dart d) { return is_tetrahedron(body.map, d); });
}

template <class Map>
class ReadyRefinement : public OnDarts<Map> {
 public:
  ReadyRefinement(ChangingBody<Map>& on, const Refine& refine, const std::string& path)
      : OnDarts<Map>(on), refine_(refine), path_(path), chooser_(on, refine.cells, path + "/cells") {}

  std::size_t apply(EventTargets* taken) override {
    const auto& body = on_.body();
    std::vector<Dart> darts;
    for (const std::uint32_t k : chooser_.choose())
      if (is_tetrahedron(body.map, body.cell_dart[k])) darts.push_back(body.cell_dart[k]);
    return this->take(darts, taken);
  }
  void state(Archive& archive) override { chooser_.state(archive); }
  std::size_t bytes() const override { return chooser_.bytes(); }

 private:
  std::size_t operate(std::span<const Dart> darts) override {
    auto& body = on_.body();
    std::vector<DartId> chosen;
    for (const Dart d : darts) chosen.push_back(body.map.id(d));
    std::size_t count = 0;
    for (const DartId id : chosen) {
      if (!body.map.is_live(id.dart) || body.map.id(id.dart) != id) continue;  // subdivided with a neighbour
      const Subdivision subdivision =
          refine_.at_centre ? subdivide(body.map, Volume{id.dart}) : subdivide(body.map, own_edge(id.dart));
      on_.follow(subdivision, refine_.bracing);
      ++count;
    }
    return count;
  }

  /// The longest edge at rest; among those that are equal but for rounding, that of the lowest dart.
  Edge longest_edge(Dart cell) const {
    // a billionth, as at borders: so that a body that is turned is refined alike
    constexpr double rounding = 1e-9;
    const auto& body = on_.body();
    Edge best{cell};
    for (const Edge e : incident_cells<1>(body.map, Volume{cell})) {
      const std::uint32_t k = body.edge(body.map, e.dart), longest = body.edge(body.map, best.dart);
      const double length = body.springs[longest].rest_length, excess = body.springs[k].rest_length - length;
      if (excess > rounding * length || (excess >= -rounding * length && body.edge_dart[k] < body.edge_dart[longest]))
        best = e;
    }
    return best;
  }

  /// The longest edge, which only tetrahedra may share.
  /// throws  InputError if a cell of another kind has it, too
  Edge own_edge(Dart cell) const {
    const auto& body = on_.body();
    const Edge longest = longest_edge(cell);
    for (const Volume v : incident_cells<3>(body.map, longest))
      if (!is_tetrahedron(body.map, v.dart))
        refuse_event(
            path_ + "/at",
            fmt::format("is \"longest edge\", and that of cell {} belongs to a cell that is no tetrahedron, too",
                        on_.mesh_cell()[body.cell(body.map, cell)]),
            "\"centre\", or cells whose longest edge tetrahedra alone have");
    return longest;
  }

  using OnDarts<Map>::on_;
  Refine refine_;
  std::string path_;
  CellChooser<Map> chooser_;
};

}  // namespace

template <class Map>
std::unique_ptr<ReadyEvent> ready(ChangingBody<Map>& on, const Refine& refine, const std::string& path) {
  if constexpr (Map::dimension == 3)
    if (has_tetrahedra(on)) return std::make_unique<ReadyRefinement<Map>>(on, refine, path);
  refuse_event(path, "subdivides tetrahedra, and the body has other cells", "a solid that has tetrahedra");
}

template std::unique_ptr<ReadyEvent> ready(ChangingBody<Map2>&, const Refine&, const std::string&);
template std::unique_ptr<ReadyEvent> ready(ChangingBody<Map3>&, const Refine&, const std::string&);
template std::unique_ptr<ReadyEvent> ready(ChangingBody<TetMap>&, const Refine&, const std::string&);

}  // namespace dartboard
