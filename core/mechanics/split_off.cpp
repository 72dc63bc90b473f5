#include "core/mechanics/split_off.h"

#include <algorithm>
#include <unordered_map>

#include "core/operations/remove_component.h"

namespace dartboard {
namespace {

template <class Map>
using Body = MassSpringBody<Map, Held::by_every_dart>;
using Numbers = std::vector<std::uint32_t>;

/// Copies one component, darts and numbers in the order they had.
template <class Map>
class Copy {
 public:
  Copy(const Body<Map>& from, Dart d) : from_(from), darts_(orbit(from.map, all_involutions(Map::dimension), d)) {
    std::sort(darts_.begin(), darts_.end());
    copy_map();
    part_.material = from.material;
    part_.materials = from.materials;
    part_.surroundings = from.surroundings;
  }

  Body<Map> run() {
    constexpr int n = Map::dimension;
    const Numbers vertices = copy_numbers<0>(from_.vertex, part_.vertex, from_.vertices.dart, part_.vertices.dart);
    copy_elements(from_.vertices, part_.vertices, VertexColumns::embedded(), vertices);
    for (const std::uint32_t k : copy_numbers<1>(from_.edge, part_.edge, from_.edge_dart, part_.edge_dart))
      part_.springs.push_back(from_.springs[k]);
    if constexpr (n == 3) copy_numbers<2>(from_.face, part_.face, from_.face_dart, part_.face_dart);
    const Numbers cells = copy_numbers<n>(from_.cell, part_.cell, from_.cell_dart, part_.cell_dart);
    copy_elements(from_, part_, Body<Map>::embedded_in_cells(), cells);
    if (!from_.edge_share.empty()) {
      part_.edge_share.resize(part_.map.template slot_count<1>());
      for (const Dart d : darts_)
        part_.edge_share[Map::template slot<1>(copy_of(d))] = from_.edge_share[Map::template slot<1>(d)];
    }
    return std::move(part_);
  }

 private:
  Dart copy_of(Dart d) const {
    if constexpr (Map::tetrahedral) return {24 * tetrahedron_.at(d.index / 24) + d.index % 24};
    return Dart{static_cast<std::uint32_t>(std::lower_bound(darts_.begin(), darts_.end(), d) - darts_.begin())};
  }

  // New darts are numbered in the order of the old ones, so that sums in their order keep their bits.
  void copy_map() {
    const Map& map = from_.map;
    if constexpr (Map::tetrahedral) {
      for (const Dart d : darts_)
        if (d.index % 24 == 0) tetrahedron_.emplace(d.index / 24, part_.map.add_tetrahedron().index / 24);
      for (const Dart d : darts_)
        if (d.index % 6 == 0 && d < map.template alpha<3>(d) && part_.map.template is_free<3>(copy_of(d)))
          part_.map.template link<3>(copy_of(d), copy_of(map.template alpha<3>(d)));
    } else {
      for (std::size_t k = 0; k < darts_.size(); ++k) part_.map.add_dart();
      const auto link = [this, &map]<int i>() {
        for (const Dart d : darts_)
          if (const Dart e = map.template alpha<i>(d); d < e) part_.map.template link<i>(copy_of(d), copy_of(e));
      };
      link.template operator()<0>();
      link.template operator()<1>();
      link.template operator()<2>();
      if constexpr (Map::dimension == 3) link.template operator()<3>();
    }
  }

  /// Number the i-cells of the part densely; returns the old numbers, ascending.
  template <int i, class Index>
  Numbers copy_numbers(const Index& from, Index& to, const std::vector<Dart>& dart_of, std::vector<Dart>& new_dart_of) {
    Numbers old;
    for (const Dart d : darts_) old.push_back(from(from_.map, d));
    std::sort(old.begin(), old.end());
    old.erase(std::unique(old.begin(), old.end()), old.end());
    for (std::uint32_t k = 0; k < old.size(); ++k) {
      new_dart_of.push_back(copy_of(dart_of[old[k]]));
      to.attach(part_.map, Cell<i>{new_dart_of.back()}, k);
    }
    return old;
  }

  const Body<Map>& from_;
  std::vector<Dart> darts_;  // ascending
  std::unordered_map<std::uint32_t, std::uint32_t> tetrahedron_;
  Body<Map> part_;
};

}  // namespace

template <class Map>
SplitOff<Map> split_off(Body<Map>& body, Dart d) {
  body.map.require_live(d);
  SplitOff<Map> split{Copy<Map>(body, d).run(), {}, {}};
  split.change = remove_component(body.map, d);
  split.changed = adapt(body, split.change);
  return split;
}

template SplitOff<Map2> split_off(Body<Map2>&, Dart);
template SplitOff<Map3> split_off(Body<Map3>&, Dart);
template SplitOff<TetMap> split_off(Body<TetMap>&, Dart);

}  // namespace dartboard
