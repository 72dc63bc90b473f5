#include "core/topology/build.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <string_view>
#include <type_traits>

#include "core/base/cell_limits.h"
#include "core/base/point_sets.h"
#include "core/plain/error.h"
#include "core/topology/cells.h"
#include "core/topology/sew.h"
#include "core/topology/storage/room.h"

namespace dartboard {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

// The node of each of a cell's darts, by the dart's number in the cell, and where its facets begin. Two cells can share
// a facet: a face of a volume, an edge of a polygon.
struct Template {
  std::vector<std::uint8_t> node;         // local node per dart
  std::vector<std::uint8_t> facet_first;  // first dart of each facet, then the number of darts
};

const Template& template_of(CellKind kind) {
  static const auto all = [] {
    std::array<Template, 6> templates;
    for (std::size_t k = 0; k < templates.size(); ++k) {
      const auto kind_k = static_cast<CellKind>(k);
      Template& t = templates[k];
      for (const auto& face : faces_of(kind_k)) {
        if (dimension(kind_k) == 3) t.facet_first.push_back(static_cast<std::uint8_t>(t.node.size()));
        for (std::size_t e = 0; e < face.size(); ++e) {
          if (dimension(kind_k) == 2) t.facet_first.push_back(static_cast<std::uint8_t>(t.node.size()));
          t.node.push_back(static_cast<std::uint8_t>(face[e]));
          t.node.push_back(static_cast<std::uint8_t>(face[(e + 1) % face.size()]));
        }
      }
      t.facet_first.push_back(static_cast<std::uint8_t>(t.node.size()));
    }
    return templates;
  }();
  return all[static_cast<std::size_t>(kind)];
}

/// The facets met so far of cells of any kind, found again by their nodes: a chain per smallest node, no sorting and no
/// hashing.
class FacetMatcher {
 public:
  // The cycle of a facet's nodes from the smallest one, towards its smaller neighbour: equal for equal facets.
  using Key = std::array<std::uint32_t, 4>;
  struct Met {
    Key key;
    std::uint32_t cell, dart;
    std::uint32_t next;
    std::uint32_t second_cell;  // `none` until it is shared
  };

  FacetMatcher(std::size_t points, std::size_t facets) : head_(points, none) { met_.reserve(facets); }

  static Key key(const std::uint32_t* nodes, std::size_t n) {
    if (n == 2) return {std::min(nodes[0], nodes[1]), std::max(nodes[0], nodes[1]), none, none};
    const auto k = static_cast<std::size_t>(std::min_element(nodes, nodes + n) - nodes);
    const std::uint32_t ahead = nodes[(k + 1) % n], behind = nodes[(k + n - 1) % n];
    return {nodes[k], std::min(ahead, behind), std::max(ahead, behind), n == 4 ? nodes[(k + 2) % n] : none};
  }

  /// The facet with this key that was met before; or null, and then it is stored.
  Met* meet(const Key& key, std::uint32_t cell, std::uint32_t dart) {
    for (std::uint32_t m = head_[key[0]]; m != none; m = met_[m].next)
      if (met_[m].key == key) return &met_[m];
    met_.push_back({key, cell, dart, head_[key[0]], none});
    head_[key[0]] = static_cast<std::uint32_t>(met_.size() - 1);
    return nullptr;
  }

 private:
  std::vector<std::uint32_t> head_;  // per point
  std::vector<Met> met_;
};

template <class Map>
void require_kind(CellKind kind) {
  if (dimension(kind) != Map::dimension)
    throw TopologyError(fmt::format("a {}-g-map cannot hold a {}", Map::dimension, name(kind)));
  if (Map::tetrahedral && kind != CellKind::tetrahedron)
    throw TopologyError(fmt::format("a tetrahedral map cannot hold a {}", name(kind)));
}

void require_cell(const Mesh& mesh, std::size_t c) {
  const auto cell = mesh.cell(c);
  for (std::size_t k = 0; k < cell.size(); ++k) {
    if (cell[k] >= mesh.points.size())
      throw InputError(fmt::format("cell {} names point {}, expected less than {}", c, cell[k], mesh.points.size()));
    for (std::size_t l = 0; l < k; ++l)
      if (cell[l] == cell[k]) throw InputError(fmt::format("cell {} names point {} twice", c, cell[k]));
  }
}

[[noreturn]] void throw_third_cell(std::size_t first, std::size_t second, std::size_t third, std::string_view part,
                                   std::span<const std::uint32_t> points) {
  throw InputError(fmt::format("cells {}, {} and {} share the {} of points {}: at most two may", first, second, third,
                               part, fmt::join(points, ", ")));
}

}  // namespace

template <class Map>
Dart add_cell(Map& map, CellKind kind) {
  require_kind<Map>(kind);
  if constexpr (Map::tetrahedral) {
    return map.add_tetrahedron();
  } else {
    const Template& t = template_of(kind);
    require_room(map.dart_count(), t.node.size(), most_darts(Map::dimension), "darts");  // for all at once
    std::vector<Dart> darts(t.node.size());
    for (Dart& d : darts) d = map.add_dart();
    std::size_t begin = 0;
    for (const auto& face : faces_of(kind)) {
      const std::size_t n = 2 * face.size();
      for (std::size_t k = 0; k < n; k += 2) {
        map.template link<0>(darts[begin + k], darts[begin + k + 1]);
        map.template link<1>(darts[begin + k + 1], darts[begin + (k + 2) % n]);
      }
      begin += n;
    }
    if constexpr (Map::dimension == 3) {
      // two darts of one node, each towards the same other node, on two faces
      for (std::size_t a = 0; a < darts.size(); ++a)
        for (std::size_t b = a + 1; b < darts.size(); ++b)
          if (t.node[a] == t.node[b] && t.node[a ^ 1u] == t.node[b ^ 1u]) map.template link<2>(darts[a], darts[b]);
    }
    return darts.front();
  }
}

template <class Map>
void remove_cell(Map& map, Dart d) {
  constexpr int n = Map::dimension;
  map.require_live(d);
  if constexpr (Map::tetrahedral) {
    map.remove_tetrahedron(d);
  } else {
    const auto darts = orbit(map, cell_orbit<n, Map>(), d);
    for (const Dart e : darts)
      if (!map.template is_free<n>(e)) throw_cannot_remove(n, e, map.template alpha<n>(e));
    for (const Dart e : darts) {
      map.template unlink<0>(e);
      map.template unlink<1>(e);
      if constexpr (n == 3) map.template unlink<2>(e);
      map.remove_dart(e);
    }
  }
}

namespace {

/// Sew the faces of the tetrahedron that was added last, with the darts from `first` on, to those met before.
/// `faces` holds the first dart of each.
void sew_faces(BuiltMap<TetMap>& built, PointSets<3>& faces, std::size_t c, std::uint32_t first) {
  const auto point = [&built](std::uint32_t d) { return built.point[TetMap::slot<0>({d})]; };
  for (std::uint32_t dart = first; dart < first + 24; dart += 6) {
    const std::array<std::uint32_t, 3> nodes{point(dart), point(dart + 2), point(dart + 4)};
    std::uint32_t& met = faces.number_of(PointSets<3>::set_of(nodes));
    if (met == PointSets<3>::none) {
      met = dart;
      continue;
    }
    if (const Dart second = built.map.alpha<3>({met}); second.index != met)
      throw_third_cell(met / 24, second.index / 24, c, "face", nodes);
    // the dart here that lies on the node and edge of the other face's first dart
    const std::uint32_t from = point(met), to = point(met + 1);
    std::uint32_t match = dart;
    while (!(point(match) == from && point(match ^ 1u) == to)) ++match;
    built.map.link<3>(Dart{met}, Dart{match});  // the whole face follows
  }
}

}  // namespace

template <class Map>
BuiltMap<Map> build_map(const Mesh& mesh) {
  constexpr int n = Map::dimension;
  BuiltMap<Map> built;
  const std::size_t cells = mesh.cell_count();
  built.first_dart.reserve(cells);
  using Facets = std::conditional_t<Map::tetrahedral, PointSets<3>, FacetMatcher>;
  Facets facets(mesh.points.size(), (Map::tetrahedral ? 3 : 4) * cells);
  for (std::size_t c = 0; c < cells; ++c) {
    const CellKind kind = mesh.kinds[c];
    if (dimension(kind) != n || (Map::tetrahedral && kind != CellKind::tetrahedron))
      throw InputError(fmt::format("cell {} is a {}: this map holds {} only", c, name(kind),
                                   Map::tetrahedral ? "tetrahedra"
                                   : n == 2         ? "polygons"
                                                    : "volumes"));
    require_cell(mesh, c);
    const auto cell = mesh.cell(c);
    const Template& t = template_of(kind);
    const std::uint32_t first = add_cell(built.map, kind).index;
    built.first_dart.push_back(first);
    built.point.resize(built.map.template slot_count<0>());
    for (std::uint32_t p = 0; p < t.node.size(); ++p) built.point[Map::template slot<0>({first + p})] = cell[t.node[p]];

    if constexpr (Map::tetrahedral) {
      sew_faces(built, facets, c, first);
      continue;
    } else {
      for (std::size_t f = 0; f + 1 < t.facet_first.size(); ++f) {
        const std::uint32_t begin = t.facet_first[f], size = t.facet_first[f + 1] - begin;
        std::array<std::uint32_t, 4> nodes{};
        const std::size_t corners = n == 2 ? 2 : size / 2;
        for (std::size_t k = 0; k < corners; ++k) nodes[k] = cell[t.node[begin + (n == 2 ? k : 2 * k)]];
        auto* met = facets.meet(FacetMatcher::key(nodes.data(), corners), static_cast<std::uint32_t>(c), first + begin);
        if (met == nullptr) continue;
        if (met->second_cell != none)
          throw_third_cell(met->cell, met->second_cell, c, n == 2 ? "edge" : "face", std::span(nodes).first(corners));
        met->second_cell = static_cast<std::uint32_t>(c);
        // the dart here that lies on the node and edge of the other facet's first dart
        const auto point = [&](std::uint32_t d) { return built.point[Map::template slot<0>({d})]; };
        const std::uint32_t from = point(met->dart), to = point(met->dart + 1);
        std::uint32_t match = first + begin;
        while (!(point(match) == from && point(match ^ 1u) == to)) ++match;
        sew<n>(built.map, Dart{met->dart}, Dart{match});
      }
    }
  }
  return built;
}

template BuiltMap<Map2> build_map(const Mesh&);
template BuiltMap<Map3> build_map(const Mesh&);
template BuiltMap<TetMap> build_map(const Mesh&);
template Dart add_cell(Map2&, CellKind);
template Dart add_cell(Map3&, CellKind);
template Dart add_cell(TetMap&, CellKind);
template void remove_cell(Map2&, Dart);
template void remove_cell(Map3&, Dart);
template void remove_cell(TetMap&, Dart);

}  // namespace dartboard
