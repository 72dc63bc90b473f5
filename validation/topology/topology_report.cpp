#include "validation/topology/topology_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <type_traits>

#include "core/operations/dissociate_face.h"
#include "core/plain/error.h"
#include "core/topology/build.h"
#include "core/topology/cells.h"
#include "core/topology/check.h"
#include "core/topology/sew.h"
#include "core/topology/summary.h"

namespace dartboard {
namespace {

constexpr std::uint32_t unnamed = no_dart.index;

/// Call f(std::integral_constant<int, i>) for the i that the map can sew: 3 alone in a map of tetrahedra.
template <class Map, int k = 0, class F>
auto with_sewable(int i, F&& f) {
  constexpr int n = Map::dimension;
  if constexpr (k < n) {
    if constexpr (!Map::tetrahedral)
      if (i == k) return f(std::integral_constant<int, k>());
    return with_sewable<Map, k + 1>(i, f);
  } else {
    return f(std::integral_constant<int, n>());
  }
}

/// The number of cells added, by the report of an operation: the number of reported pairs, less those that close a
/// cycle. (A cell that a face meets at several corners may come apart into three, and its parts are reported in pairs.)
/// A pair within one cell is a false report, and then the number of pairs is the answer.
template <int i, class Map>
long cells_added(const Map& map, const std::vector<DissociatedCell>& pairs) {
  std::vector<Dart> cells;  // one dart per cell; `joined`: the cell that it is joined to
  std::vector<std::size_t> joined;
  const auto find = [&](Dart d) {
    std::size_t k = 0;
    while (k < cells.size() && !same_cell<i>(map, cells[k], d)) ++k;
    if (k == cells.size()) {
      cells.push_back(d);
      joined.push_back(k);
    }
    return k;
  };
  const auto root = [&](std::size_t k) {
    while (joined[k] != k) k = joined[k];
    return k;
  };
  long added = 0;
  for (const auto& [kept, split] : pairs) {
    const std::size_t a = find(kept), b = find(split);
    if (a == b) return static_cast<long>(pairs.size());
    if (root(a) == root(b)) continue;
    joined[root(a)] = root(b);
    ++added;
  }
  return added;
}

template <class Map>
class CoreTwin final : public MapTwin {
  static constexpr int n = Map::dimension;

 public:
  CoreTwin(const Mesh& mesh, MapOperations<Map> operations)
      : map_(std::move(build_map<Map>(mesh).map)), operations_(std::move(operations)) {
    // in a fresh map darts are numbered in the order of their names
    for (std::uint32_t k = 0; k < map_.capacity(); ++k) name_dart({k}, {k});
  }

  std::string library() const override {
    return fmt::format("{}{}", Map::tetrahedral ? "TetMap" : "Map", Map::tetrahedral ? "" : std::to_string(n));
  }
  int dimension() const override { return n; }

  std::size_t dart_count() const override { return map_.dart_count(); }
  bool is_live(Dart d) const override { return d.index < dart_of_.size() && dart_of_[d.index] != no_dart; }
  std::vector<Dart> darts() const override {
    std::vector<Dart> all;
    map_.for_each_dart([&](Dart d) { all.push_back(name_of(d)); });
    std::sort(all.begin(), all.end());
    return all;
  }
  Dart alpha(int i, Dart d) const override { return name_of(map_.alpha(i, dart_of_[d.index])); }
  void orbit(Involutions set, Dart d, std::vector<Dart>& darts) const override {
    darts.clear();
    for_each_dart_of(map_, set, dart_of_[d.index], [&](Dart e) { darts.push_back(name_of(e)); });
  }

  std::vector<std::size_t> count_cells() const override {
    std::vector<std::size_t> counts;
    for (int i = 0; i <= n; ++i) counts.push_back(count_orbits(map_, cell_involutions(n, i)));
    counts.push_back(components(map_).count);
    return counts;
  }
  std::optional<bool> is_orientable() const override { return orientation(map_).has_value(); }
  std::string violation() const override { return check(map_); }
  std::string violation_near(std::span<const Dart> darts) const override {
    std::string violation;
    for (const Dart d : darts)
      if (violation.empty()) violation = check_dart(map_, dart_of_[d.index]);
    return violation;
  }

  bool can_carry_sew(int i, Dart, Dart) const override { return can_carry_unsew(i); }
  bool can_carry_unsew(int i) const override { return i <= n && (!Map::tetrahedral || i == 3); }
  bool can_carry(CellKind kind) const override {
    return dartboard::dimension(kind) == n && (!Map::tetrahedral || kind == CellKind::tetrahedron);
  }
  bool refuses_folds() const override { return false; }
  bool can_sew(int i, Dart a, Dart b) const override {
    return with_sewable<Map>(i, [&](auto k) {
      return !why_not_sewable<decltype(k)::value>(map_, dart_of_[a.index], dart_of_[b.index]).has_value();
    });
  }
  void sew(int i, Dart a, Dart b) override {
    if (operations_.sew) return operations_.sew(map_, i, dart_of_[a.index], dart_of_[b.index]);
    with_sewable<Map>(i,
                      [&](auto k) { dartboard::sew<decltype(k)::value>(map_, dart_of_[a.index], dart_of_[b.index]); });
  }
  void unsew(int i, Dart d) override { unsew_own(i, dart_of_[d.index]); }
  SplitCounts dissociate(Dart d) override {
    const Dart own = dart_of_[d.index];
    if (operations_.dissociate) return operations_.dissociate(map_, own);
    TopologyChange change;
    if constexpr (n == 3)
      change = dissociate_face(map_, own);
    else
      change = dissociate_edge(map_, own);
    return {cells_added<0>(map_, change.vertices), cells_added<1>(map_, change.edges),
            cells_added<2>(map_, change.faces)};
  }
  void add(CellKind kind, Dart first) override {
    // the dart at each position of the cell: slots are used again in any order, so follow the alphas from the
    // first
    const CellShape& shape = shape_of(kind);
    std::vector<Dart> at(shape.node.size(), no_dart);
    at[0] = add_cell(map_, kind);
    std::vector<std::size_t> reached{0};
    for (std::size_t k = 0; k < reached.size(); ++k)
      for (int i = 0; i < n; ++i) {
        const std::size_t next = shape.alpha[reached[k]][static_cast<std::size_t>(i)];
        if (at[next] != no_dart) continue;
        at[next] = map_.alpha(i, at[reached[k]]);
        reached.push_back(next);
      }
    for (std::uint32_t p = 0; p < at.size(); ++p) name_dart(at[p], {first.index + p});
  }
  void remove(Dart d) override {
    const auto cell = dartboard::orbit(map_, cell_involutions(n, n), dart_of_[d.index]);
    for (const Dart e : cell) unsew_own(n, e);
    remove_cell(map_, cell.front());
    for (const Dart e : cell) {
      dart_of_[name_of_[e.index]] = no_dart;
      name_of_[e.index] = unnamed;
    }
  }

 private:
  void unsew_own(int i, Dart own) {
    if (operations_.unsew) return operations_.unsew(map_, i, own);
    with_sewable<Map>(i, [&](auto k) { dartboard::unsew<decltype(k)::value>(map_, own); });
  }
  Dart name_of(Dart own) const { return {own.index < name_of_.size() ? name_of_[own.index] : unnamed}; }
  void name_dart(Dart own, Dart name) {
    if (name_of_.size() <= own.index) name_of_.resize(own.index + 1u + own.index / 2, unnamed);
    if (dart_of_.size() <= name.index) dart_of_.resize(name.index + 1u + name.index / 2);
    name_of_[own.index] = name.index;
    dart_of_[name.index] = own;
  }

  Map map_;
  MapOperations<Map> operations_;
  std::vector<Dart> dart_of_;           // by name; no_dart when there is none
  std::vector<std::uint32_t> name_of_;  // by slot
};

std::string set_name(Involutions set) {
  std::string text;
  for (int i = 0; i <= 3; ++i)
    if (set.contains(i)) text += (text.empty() ? "" : ",") + std::to_string(i);
  return "<" + text + ">";
}

std::size_t count_labels(const std::vector<Dart>& labels, const std::vector<Dart>& darts) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < darts.size(); ++k) count += labels[k] == darts[k] ? 1u : 0u;
  return count;
}

/// One row per question; an answer consists of a value to compare and text to print.
class Rows {
 public:
  explicit Rows(std::span<const MapTwin* const> twins) : twins_(twins) {}

  /// f(twin) gives std::optional<Value>; show(value) its text.
  template <class F, class Show>
  void ask(std::string what, F&& f, Show&& show) {
    AgreementRow row{std::move(what), {}, true};
    const auto reference = f(*twins_[0]);
    for (const MapTwin* twin : twins_) {
      const auto answer = twin == twins_[0] ? reference : f(*twin);
      if (!answer) {
        row.answers.emplace_back();
        continue;
      }
      const bool same = answer == reference;
      row.answers.push_back(show(*answer));
      // equal text for unequal values: the same number of orbits, with other members
      if (!same && reference && row.answers.back() == row.answers.front()) row.answers.back() += " others";
      row.agrees = row.agrees && same;
    }
    rows_.push_back(std::move(row));
  }
  std::vector<AgreementRow> take() { return std::move(rows_); }

 private:
  std::span<const MapTwin* const> twins_;
  std::vector<AgreementRow> rows_;
};

/// vertices - edges + faces - volumes of each component, in the order of the components' smallest darts.
std::optional<std::vector<long>> euler_by_component(const MapTwin& twin, const std::vector<Dart>& darts) {
  const auto component = twin.labels(all_involutions(twin.dimension()));
  std::vector<long> by_name(darts.empty() ? 0 : darts.back().index + 1u, 0), result;
  for (int i = 0; i <= twin.dimension(); ++i) {
    const auto cells = twin.labels(cell_involutions(twin.dimension(), i));
    for (std::size_t k = 0; k < darts.size(); ++k)
      if (cells[k] == darts[k]) by_name[component[k].index] += i % 2 == 0 ? 1 : -1;
  }
  for (std::size_t k = 0; k < darts.size(); ++k)
    if (component[k] == darts[k]) result.push_back(by_name[darts[k].index]);
  return result;
}

std::string list_of(const std::vector<long>& values) {
  constexpr std::size_t most = 6;
  const std::size_t shown = std::min(values.size(), most);
  return fmt::format("{}{}", fmt::join(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(shown), " "),
                     values.size() > most ? fmt::format(" ... ({})", values.size()) : "");
}

}  // namespace

template <class Map>
std::unique_ptr<MapTwin> make_core_twin(const Mesh& mesh, MapOperations<Map> operations) {
  return std::make_unique<CoreTwin<Map>>(mesh, std::move(operations));
}
template std::unique_ptr<MapTwin> make_core_twin(const Mesh&, MapOperations<Map2>);
template std::unique_ptr<MapTwin> make_core_twin(const Mesh&, MapOperations<Map3>);
template std::unique_ptr<MapTwin> make_core_twin(const Mesh&, MapOperations<TetMap>);

std::vector<AgreementRow> compare_twins(std::span<const MapTwin* const> twins) {
  const int n = twins[0]->dimension();
  const auto number = [](auto value) { return fmt::format("{}", value); };
  const auto yes = [](bool value) -> std::string { return value ? "yes" : "no"; };
  Rows rows(twins);
  rows.ask(
      "darts", [](const MapTwin& t) { return std::optional(t.dart_count()); }, number);
  std::vector<std::vector<std::size_t>> counts;
  for (const MapTwin* twin : twins) counts.push_back(twin->count_cells());
  const auto index = [&](const MapTwin& t) {
    return static_cast<std::size_t>(std::find(twins.begin(), twins.end(), &t) - twins.begin());
  };
  constexpr const char* cell_names[] = {"vertices", "edges", "faces", "volumes"};
  for (std::size_t i = 0; i <= static_cast<std::size_t>(n) + 1; ++i)
    rows.ask(
        i <= static_cast<std::size_t>(n) ? cell_names[i] : "components",
        [&](const MapTwin& t) { return std::optional(counts[index(t)][i]); }, number);

  // the following questions make sense only if all have the same darts
  const auto darts = twins[0]->darts();
  rows.ask(
      "names of darts", [](const MapTwin& t) { return std::optional(t.darts()); },
      [&](const auto& names) -> std::string { return names == darts ? "same" : "different"; });
  for (const MapTwin* twin : twins)
    if (twin->darts() != darts) return rows.take();
  rows.ask(
      "valid", [](const MapTwin& t) { return std::optional(t.violation()); },
      [](const std::string& violation) { return violation.empty() ? "yes" : violation; });
  for (const MapTwin* twin : twins)
    if (!twin->violation().empty()) {
      auto result = rows.take();
      result.back().agrees = false;
      return result;
    }
  const auto alphas = twins[0]->alphas().alphas;
  rows.ask(
      "every alpha", [](const MapTwin& t) { return std::optional(t.alphas().alphas); },
      [&](const auto& list) -> std::string { return list == alphas ? "same" : "different"; });
  for (unsigned bits = 0; bits < (2u << n); ++bits) {
    const Involutions set = Involutions::from_bits(bits);
    rows.ask(
        "orbits " + set_name(set),
        [&](const MapTwin& t) { return t.can_walk(set) ? std::optional(t.labels(set)) : std::nullopt; },
        [&](const auto& labels) { return fmt::format("{}", count_labels(labels, darts)); });
  }
  rows.ask(
      "orientable", [](const MapTwin& t) { return t.is_orientable(); }, yes);
  rows.ask(
      n == 3 ? "boundary faces" : "boundary edges",
      [&](const MapTwin& t) {
        const auto facets = t.labels(cell_involutions(n, n - 1));
        std::size_t free = 0;
        for (std::size_t k = 0; k < darts.size(); ++k)
          free += facets[k] == darts[k] && t.alpha(n, darts[k]) == darts[k] ? 1u : 0u;
        return std::optional(free);
      },
      number);
  rows.ask(
      "Euler characteristics", [&](const MapTwin& t) { return euler_by_component(t, darts); }, list_of);
  return rows.take();
}

AgreementRow compare_isomorphism(std::span<const MapTwin* const> twins, std::size_t first, const AlphaList& alphas) {
  AgreementRow row{"isomorphic to ours", std::vector<std::string>(twins.size()), true};
  for (std::size_t k = first; k < twins.size(); ++k) {
    const bool same = are_isomorphic(*twins[k], alphas);
    row.answers[k] = same ? "yes" : "no";
    row.agrees = row.agrees && same;
  }
  return row;
}

bool TopologyComparison::agrees() const {
  return std::all_of(rows.begin(), rows.end(), [](const AgreementRow& row) { return row.agrees; });
}

TopologyComparison compare_topology(const Mesh& mesh) {
  const AlphaList expected = alphas_of(mesh);
  const bool all_tetrahedra =
      expected.dimension == 3 &&
      std::all_of(mesh.kinds.begin(), mesh.kinds.end(), [](CellKind k) { return k == CellKind::tetrahedron; });

  TopologyComparison result;
  std::vector<std::unique_ptr<MapTwin>> twins;
  twins.push_back(expected.dimension == 2 ? make_core_twin<Map2>(mesh) : make_core_twin<Map3>(mesh));
  if (all_tetrahedra) twins.push_back(make_core_twin<TetMap>(mesh));
  const std::size_t ours = twins.size();
  twins.push_back(make_cgal_gmap_twin(expected));
  if (auto cmap = make_cgal_cmap_twin(expected, &result.no_cmap)) twins.push_back(std::move(cmap));

  std::vector<const MapTwin*> pointers;
  for (const auto& twin : twins) {
    pointers.push_back(twin.get());
    result.carriers.push_back(twin->library());
  }
  result.rows = compare_twins(pointers);

  // the maps that CGAL made of the mesh against those it makes of our alphas
  result.rows.push_back(compare_isomorphism(pointers, ours, twins[0]->alphas()));
  return result;
}

}  // namespace dartboard
