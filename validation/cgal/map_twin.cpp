#include "validation/cgal/map_twin.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/plain/error.h"

namespace dartboard {

// ---- cells and meshes, written out

const CellShape& shape_of(CellKind kind) {
  static const auto all = [] {
    std::array<CellShape, 6> shapes;
    for (std::size_t k = 0; k < shapes.size(); ++k) {
      const auto of = static_cast<CellKind>(k);
      CellShape& s = shapes[k];
      s.dimension = dimension(of);
      for (const auto& face : faces_of(of)) {
        const std::size_t begin = s.node.size(), n = 2 * face.size();
        for (std::size_t r = 0; r < n; ++r) {
          s.node.push_back(static_cast<std::uint8_t>(face[(r + 1) / 2 % face.size()]));
          const std::size_t across = begin + (r ^ 1u), around = begin + (r % 2 == 1 ? r + 1 : r + n - 1) % n;
          s.alpha.push_back({static_cast<std::uint8_t>(across), static_cast<std::uint8_t>(around),
                             static_cast<std::uint8_t>(begin + r)});
        }
      }
      if (s.dimension == 2) continue;
      // alpha_2: the other dart on this node and this edge
      for (std::size_t p = 0; p < s.node.size(); ++p)
        for (std::size_t q = 0; q < s.node.size(); ++q)
          if (p != q && s.node[p] == s.node[q] && s.node[s.alpha[p][0]] == s.node[s.alpha[q][0]])
            s.alpha[p][2] = static_cast<std::uint8_t>(q);
    }
    return shapes;
  }();
  return all[static_cast<std::size_t>(kind)];
}

AlphaList alphas_of(const Mesh& mesh) {
  AlphaList list;
  list.dimension = mesh.cell_count() == 0 ? 3 : mesh.dimension();
  const auto n = static_cast<std::size_t>(list.dimension);
  // a dart by the nodes of its facet, ascending, then its own node and the other one of its edge: two alike are
  // n-linked
  struct Named {
    std::array<std::uint32_t, 6> key;
    std::uint32_t dart;
  };
  std::vector<Named> named;
  std::uint32_t first = 0;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    const CellShape& s = shape_of(mesh.kinds[c]);
    const auto cell = mesh.cell(c);
    for (std::size_t p = 0; p < s.node.size(); ++p) {
      const auto at = [&](std::size_t q) { return Dart{first + static_cast<std::uint32_t>(q)}; };
      list.darts.push_back(at(p));
      list.alphas.push_back({at(s.alpha[p][0]), at(s.alpha[p][1]), at(s.alpha[p][2]), at(p)});
      Named d{{}, at(p).index};
      d.key.fill(std::numeric_limits<std::uint32_t>::max());
      std::size_t corners = 0;
      for (std::size_t q = p;;) {  // around the facet: an edge has two corners, a face as many as it has edges
        d.key[corners++] = cell[s.node[q]];
        q = s.alpha[q][0];
        if (n == 3) q = s.alpha[q][1];
        if (q == p || (n == 2 && corners == 2)) break;
      }
      std::sort(d.key.begin(), d.key.begin() + 4);  // unused entries are larger than every node
      d.key[4] = cell[s.node[p]];
      d.key[5] = cell[s.node[s.alpha[p][0]]];
      named.push_back(d);
    }
    first += static_cast<std::uint32_t>(s.node.size());
  }
  std::stable_sort(named.begin(), named.end(), [](const Named& a, const Named& b) { return a.key < b.key; });
  for (std::size_t k = 0; k + 1 < named.size(); ++k) {
    if (named[k].key != named[k + 1].key) continue;
    if (k + 2 < named.size() && named[k + 2].key == named[k].key)
      throw InputError(fmt::format("three cells share the facet of d{}", named[k].dart));
    list.alphas[named[k].dart][n] = {named[k + 1].dart};
    list.alphas[named[k + 1].dart][n] = {named[k].dart};
    ++k;
  }
  return list;
}

// ---- functions common to all twins

std::vector<Dart> darts_touched(const MapTwin& map, int i, Dart d, Dart e) {
  const Involutions line = sew_involutions(map.dimension(), i);
  std::vector<Dart> touched, other;
  map.orbit(line, d, touched);
  if (e != d) {
    map.orbit(line, e, other);
    touched.insert(touched.end(), other.begin(), other.end());
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  }
  return touched;
}

std::vector<long> count_cells_around(const MapTwin& map, std::span<const Dart> darts) {
  std::vector<long> counts;
  std::vector<Dart> orbit, rest;
  for (int i = 0; i <= map.dimension(); ++i) {
    counts.push_back(0);
    rest.assign(darts.begin(), darts.end());
    while (!rest.empty()) {
      map.orbit(cell_involutions(map.dimension(), i), rest.back(), orbit);
      for (std::size_t k = 0; k < orbit.size() && !rest.empty(); ++k) std::erase(rest, orbit[k]);  // rest is short
      ++counts.back();
    }
  }
  return counts;
}

SplitCounts MapTwin::dissociate(Dart d) {
  const auto touched = darts_touched(*this, dimension(), d, alpha(dimension(), d));
  const auto before = count_cells_around(*this, touched);
  unsew(dimension(), d);
  const auto after = count_cells_around(*this, touched);
  SplitCounts split{};
  for (std::size_t i = 0; i < 3 && i < static_cast<std::size_t>(dimension()); ++i) split[i] = after[i] - before[i];
  return split;
}

AlphaList MapTwin::alphas() const {
  AlphaList list{dimension(), darts(), {}};
  list.alphas.reserve(list.darts.size());
  for (const Dart d : list.darts) {
    std::array<Dart, 4> a{d, d, d, d};
    for (int i = 0; i <= dimension(); ++i) a[static_cast<std::size_t>(i)] = alpha(i, d);
    list.alphas.push_back(a);
  }
  return list;
}

std::vector<Dart> MapTwin::labels(Involutions set) const {
  const auto all = darts();
  std::vector<Dart> label(all.empty() ? 0 : all.back().index + 1u), of_orbit;
  for (const Dart d : all) {
    if (label[d.index] != no_dart) continue;
    orbit(set, d, of_orbit);
    for (const Dart e : of_orbit) label[e.index] = d;
  }
  std::vector<Dart> result;
  result.reserve(all.size());
  for (const Dart d : all) result.push_back(label[d.index]);
  return result;
}

}  // namespace dartboard
