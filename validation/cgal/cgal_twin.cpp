#include "validation/cgal/cgal_twin.h"

#include <CGAL/Combinatorial_map.h>
#include <CGAL/Generalized_map.h>
#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <type_traits>
#include <utility>

#include "core/plain/error.h"

namespace dartboard {

namespace {

struct Items {
  template <class Refs>
  struct Dart_wrapper {
    using Dart_info = std::uint32_t;  // the dart's name
    using Attributes = std::tuple<>;
  };
};

// One walk per set of involutions: CGAL takes the set as template arguments. The iterators are named because
// darts_of_orbit_basic does not compile for generalized maps in 5.5; the ones that are not basic walk twice, to unmark.
template <unsigned... i, unsigned N>
auto orbit_iterator(CGAL::Generalized_map<N, Items>& map, auto d, auto mark) {
  using Map = CGAL::Generalized_map<N, Items>;
  if constexpr (sizeof...(i) == 4)  // <0, 1, 2, 3> does not compile either: the component is an "(N+1)-cell"
    return CGAL::GMap_dart_iterator_basic_of_cell<Map, N + 1>(map, d, mark);
  else
    return CGAL::GMap_dart_iterator_basic_of_orbit_generic<Map, false, static_cast<int>(i)...>(map, d, mark);
}
template <unsigned... i, unsigned N>
auto orbit_iterator(CGAL::Combinatorial_map<N, Items>& map, auto d, auto mark) {
  using Map = CGAL::Combinatorial_map<N, Items>;
  return CGAL::CMap_dart_iterator_basic_of_orbit_generic<Map, false, static_cast<int>(i)...>(map, d, mark);
}

template <class Map>
using Walk = void (*)(Map&, typename Map::Dart_handle, typename Map::size_type,
                      std::vector<typename Map::Dart_handle>&);

template <class Map, unsigned bits, unsigned i, unsigned... chosen>
void walk_orbit(Map& map, typename Map::Dart_handle d, typename Map::size_type mark,
                std::vector<typename Map::Dart_handle>& out) {
  if constexpr (i > Map::dimension) {
    for (auto it = orbit_iterator<chosen...>(map, d, mark); it.cont(); ++it) out.push_back(it);
  } else if constexpr ((bits >> i & 1u) != 0) {
    walk_orbit<Map, bits, i + 1, chosen..., i>(map, d, mark, out);
  } else {
    walk_orbit<Map, bits, i + 1, chosen...>(map, d, mark, out);
  }
}

// By the bits of the set. `first` is 0 for alphas, and 1 for betas, where beta_0 is only the inverse of beta_1.
template <class Map, unsigned first, std::size_t... k>
constexpr std::array<Walk<Map>, sizeof...(k)> all_walks(std::index_sequence<k...>) {
  return {&walk_orbit<Map, static_cast<unsigned>(k) & ~((1u << first) - 1u), first>...};
}
template <class Map, unsigned first>
constexpr auto walks = all_walks<Map, first>(std::make_index_sequence<(2u << Map::dimension)>());

/// Code shared by both kinds: darts by name, walks that clean up their mark, counting, validity.
template <class MapType>
class CgalTwin : public MapTwin {
 public:
  using Map = MapType;
  using Handle = typename Map::Dart_handle;
  static constexpr int n = static_cast<int>(Map::dimension);

  int dimension() const override { return n; }
  std::vector<std::size_t> count_cells() const override {
    std::vector<unsigned> which;
    for (unsigned i = 0; i <= static_cast<unsigned>(n) + 1; ++i) which.push_back(i);  // n + 1: components
    const auto counted = map_.count_cells(which);
    return {counted.begin(), counted.begin() + n + 2};
  }
  std::string violation() const override { return map_.is_valid() ? "" : "is_valid() is false"; }

  Map& map() const { return map_; }
  Handle handle(Dart d) const { return handle_[d.index]; }

 protected:
  Handle create(Dart name) {
    if (handle_.size() <= name.index) handle_.resize(name.index + 1u + name.index / 2, nullptr);
    const Handle h = map_.create_dart();
    map_.info(h) = name.index;
    return handle_[name.index] = h;
  }
  void erase(Dart name) {
    map_.erase_dart(handle_[name.index]);
    handle_[name.index] = nullptr;
  }
  bool has(Dart name) const { return name.index < handle_.size() && handle_[name.index] != nullptr; }
  Dart name(Handle h) const { return {map_.info(h)}; }

  template <class F>
  const std::vector<Handle>& walked(F&& walk) const {
    met_.clear();
    const auto mark = map_.get_new_mark();
    walk(mark, met_);
    for (const Handle h : met_)
      if (map_.is_marked(h, mark)) map_.unmark(h, mark);  // walks of one or two involutions leave it unset
    map_.free_mark(mark);
    return met_;
  }

  mutable Map map_;             // marks are in the map
  std::vector<Handle> handle_;  // by name; null for no dart

 private:
  mutable std::vector<Handle> met_;
};

/// Calls f(integral constant i) for the i in 0 .. N that equals `i`.
template <int N, class F>
auto with_dimension(int i, F&& f) {
  if constexpr (N > 0)
    if (i != N) return with_dimension<N - 1>(i, f);
  return f(std::integral_constant<int, N>());
}

template <int N>
class CgalGmapTwin final : public CgalTwin<CGAL::Generalized_map<N, Items>> {
  using Base = CgalTwin<CGAL::Generalized_map<N, Items>>;
  using Map = typename Base::Map;
  using Handle = typename Base::Handle;
  using Base::handle_, Base::map_, Base::name, Base::create;

 public:
  explicit CgalGmapTwin(const AlphaList& list) {
    for (const Dart d : list.darts) create(d);
    for (std::size_t k = 0; k < list.darts.size(); ++k)
      for (unsigned i = 0; i <= N; ++i)
        if (list.darts[k] < list.alphas[k][i])
          map_.basic_link_alpha(handle_[list.darts[k].index], handle_[list.alphas[k][i].index], i);
  }

  std::string library() const override { return "CGAL g-map"; }
  std::size_t dart_count() const override { return map_.number_of_darts(); }
  bool is_live(Dart d) const override { return Base::has(d); }
  std::vector<Dart> darts() const override {
    std::vector<Dart> all;
    for (std::uint32_t k = 0; k < handle_.size(); ++k)
      if (handle_[k] != nullptr) all.push_back({k});
    return all;
  }
  Dart alpha(int i, Dart d) const override { return name(map_.alpha(handle_[d.index], i)); }
  void orbit(Involutions set, Dart d, std::vector<Dart>& darts) const override {
    darts.clear();
    for (const Handle h :
         Base::walked([&](auto mark, auto&out) { walks<Map, 0>[set.bits](map_, handle_[d.index], mark, out); }))
      darts.push_back(name(h));
    // CGAL walks two commuting involutions without marks, and reports a dart twice where both lead to the same one (a
    // fold)
    if (set.size() == 2 && darts.size() <= 4) {
      std::sort(darts.begin(), darts.end());
      darts.erase(std::unique(darts.begin(), darts.end()), darts.end());
    }
  }
  std::optional<bool> is_orientable() const override { return map_.is_orientable(); }

  bool can_carry_sew(int, Dart, Dart) const override { return true; }
  bool can_carry_unsew(int) const override { return true; }
  bool can_carry(CellKind kind) const override { return dartboard::dimension(kind) == N; }
  bool refuses_folds() const override { return true; }
  bool can_sew(int i, Dart a, Dart b) const override {
    return with_dimension<N>(
        i, [&](auto k) { return map_.template is_sewable<decltype(k)::value>(handle_[a.index], handle_[b.index]); });
  }
  void sew(int i, Dart a, Dart b) override {
    with_dimension<N>(i, [&](auto k) {
      constexpr unsigned dim = decltype(k)::value;
      if (map_.template is_sewable<dim>(handle_[a.index], handle_[b.index]))
        return map_.template topo_sew<dim>(handle_[a.index], handle_[b.index]);
      // a fold: the same pairs, met from both ends
      const auto from = line<dim>(a), to = line<dim>(b);
      for (std::size_t p = 0; p < from.size() && p < to.size(); ++p)
        map_.template basic_link_alpha<dim>(from[p], to[p]);
    });
  }
  // topo_unsew does not compile in 5.5
  void unsew(int i, Dart d) override {
    with_dimension<N>(i, [&](auto k) {
      constexpr unsigned dim = decltype(k)::value;
      for (const Handle h : line<dim>(d))
        if (!map_.template is_free<dim>(h)) map_.template unlink_alpha<dim>(h);
    });
  }
  void add(CellKind kind, Dart first) override {
    const CellShape& s = shape_of(kind);
    for (std::uint32_t p = 0; p < s.node.size(); ++p) create({first.index + p});
    for (std::uint32_t p = 0; p < s.node.size(); ++p)
      for (unsigned i = 0; i < N; ++i)
        if (p < s.alpha[p][i]) map_.basic_link_alpha(handle_[first.index + p], handle_[first.index + s.alpha[p][i]], i);
  }
  // remove_cell would leave the neighbours' attributes wrong: unsew first, as the paper does
  void remove(Dart d) override {
    std::vector<Dart> cell;
    orbit(cell_involutions(N, N), d, cell);
    for (const Dart e : cell)
      if (!map_.template is_free<N>(handle_[e.index])) map_.template unlink_alpha<N>(handle_[e.index]);
    for (const Dart e : cell) Base::erase(e);
  }

 private:
  template <unsigned i>
  std::vector<Handle> line(Dart d) const {
    std::vector<Handle> darts;
    auto range = map_.template darts_of_involution<i>(handle_[d.index]);
    for (auto it = range.begin(); it.cont(); ++it) darts.push_back(it);
    return darts;
  }
};

template <int N>
class CgalCmapTwin final : public CgalTwin<CGAL::Combinatorial_map<N, Items>> {
  using Base = CgalTwin<CGAL::Combinatorial_map<N, Items>>;
  using Map = typename Base::Map;
  using Handle = typename Base::Handle;
  using Base::handle_, Base::map_, Base::name, Base::create;

 public:
  /// `positive` by name; the alpha_0 of every dart has the other colour.
  CgalCmapTwin(const AlphaList& list, const std::vector<bool>& positive) {
    for (std::size_t k = 0; k < list.darts.size(); ++k) pair(list.darts[k], list.alphas[k][0]);
    for (const Dart d : list.darts)
      if (positive[d.index]) create(d);
    // beta_i(d) = alpha_i(alpha_0(d))
    for (std::size_t k = 0; k < list.darts.size(); ++k) {
      const Dart d = list.darts[k];
      if (positive[d.index]) continue;
      const Handle h = handle_[across_[d.index].index];
      map_.basic_link_beta_1(h, handle_[list.alphas[k][1].index]);
      for (unsigned i = 2; i <= N; ++i)
        if (list.alphas[k][i] != d) map_.basic_link_beta(h, handle_[list.alphas[k][i].index], i);
    }
  }

  std::string library() const override { return "CGAL c-map"; }
  bool is_positive(Dart d) const { return Base::has(d); }
  std::size_t dart_count() const override { return 2 * map_.number_of_darts(); }
  bool is_live(Dart d) const override { return d.index < across_.size() && across_[d.index] != no_dart; }
  std::vector<Dart> darts() const override {
    std::vector<Dart> all;
    for (std::uint32_t k = 0; k < across_.size(); ++k)
      if (across_[k] != no_dart) all.push_back({k});
    return all;
  }
  // Back from betas: alpha_i of a negative dart is beta_i of its positive, and of a positive one the other way round.
  Dart alpha(int i, Dart d) const override {
    const Dart e = across_[d.index];
    if (i == 0) return e;
    if (!is_positive(d)) return map_.is_free(handle_[e.index], static_cast<unsigned>(i)) ? d : beta(i, e);
    const int inverse = i == 1 ? 0 : i;
    if (map_.is_free(handle_[d.index], static_cast<unsigned>(inverse))) return d;
    return across_[beta(inverse, d).index];
  }
  bool can_walk(Involutions set) const override { return set.contains(0) || set == cell_involutions(N, 0); }
  void orbit(Involutions set, Dart d, std::vector<Dart>& darts) const override {
    darts.clear();
    if (set.contains(0)) {
      const Handle h = handle_[positive_of(d).index];
      for (const Handle g : Base::walked([&](auto mark, auto&out) { walks<Map, 1>[set.bits](map_, h, mark, out); })) {
        darts.push_back(name(g));
        darts.push_back(across_[name(g).index]);
      }
    } else {  // the vertex, walked from a positive dart; alpha_1 brings the negative ones
      const Handle h = handle_[is_positive(d) ? d.index : alpha(1, d).index];
      for (const Handle g : Base::walked([&](auto mark, auto&out) {
             auto range = map_.template darts_of_cell_basic<0, N>(h, mark);
             for (auto it = range.begin(); it.cont(); ++it) out.push_back(it);
           })) {
        darts.push_back(name(g));
        darts.push_back(alpha(1, name(g)));
      }
    }
  }
  std::optional<bool> is_orientable() const override { return std::nullopt; }

  bool can_carry_sew(int i, Dart a, Dart b) const override {
    return i >= 2 && is_positive(a) != is_positive(b) && a != across_[b.index] && !on_line(i, a, b);
  }
  bool can_carry_unsew(int i) const override { return i >= 2; }
  bool can_carry(CellKind kind) const override { return dartboard::dimension(kind) == N; }
  bool refuses_folds() const override { return true; }
  bool can_sew(int i, Dart a, Dart b) const override {
    return with_involution(i, [&](auto k) {
      return map_.template is_sewable<decltype(k)::value>(handle_[positive_of(a).index], handle_[positive_of(b).index]);
    });
  }
  // alpha_i(a) = b means that beta_i takes the positive one of edge a to the positive one of edge b
  void sew(int i, Dart a, Dart b) override {
    with_involution(i, [&](auto k) {
      map_.template topo_sew<decltype(k)::value>(handle_[positive_of(a).index], handle_[positive_of(b).index]);
      return true;
    });
  }
  void unsew(int i, Dart d) override {
    with_involution(i, [&](auto k) {
      map_.template topo_unsew<decltype(k)::value>(handle_[positive_of(d).index]);
      return true;
    });
  }
  void add(CellKind kind, Dart first) override {
    const CellShape& s = shape_of(kind);
    const auto at = [&](std::size_t p) { return Dart{first.index + static_cast<std::uint32_t>(p)}; };
    for (std::size_t p = 0; p < s.node.size(); ++p) pair(at(p), at(s.alpha[p][0]));
    for (std::size_t p = 0; p < s.node.size(); p += 2) create(at(p));  // even positions are the positive ones
    for (std::size_t p = 0; p < s.node.size(); p += 2) {
      const std::size_t q = s.alpha[p][0];
      map_.basic_link_beta_1(handle_[at(p).index], handle_[at(s.alpha[q][1]).index]);
      if (N == 3 && p < s.alpha[q][2]) map_.basic_link_beta(handle_[at(p).index], handle_[at(s.alpha[q][2]).index], 2);
    }
  }
  void remove(Dart d) override {
    std::vector<Dart> cell;
    orbit(cell_involutions(N, N), d, cell);
    for (const Dart e : cell)
      if (is_positive(e) && !map_.template is_free<N>(handle_[e.index])) map_.template unlink_beta<N>(handle_[e.index]);
    for (const Dart e : cell)
      if (is_positive(e)) Base::erase(e);
    for (const Dart e : cell) across_[e.index] = no_dart;
  }

 private:
  template <class F>
  static bool with_involution(int i, F&& f) {
    if constexpr (N == 3)
      if (i == 3) return f(std::integral_constant<unsigned, 3>());
    return f(std::integral_constant<unsigned, 2>());
  }
  void pair(Dart d, Dart e) {
    const std::uint32_t size = std::max(d.index, e.index) + 1u;
    if (across_.size() < size) across_.resize(size + size / 2);
    if (handle_.size() < across_.size()) handle_.resize(across_.size(), nullptr);
    across_[d.index] = e;
    across_[e.index] = d;
  }
  Dart positive_of(Dart d) const { return is_positive(d) ? d : across_[d.index]; }
  Dart beta(int i, Dart d) const { return name(map_.beta(handle_[d.index], static_cast<unsigned>(i))); }
  bool on_line(int i, Dart a, Dart b) const {
    std::vector<Dart> line;
    orbit(sew_involutions(N, i), a, line);
    return std::find(line.begin(), line.end(), b) != line.end();
  }

  std::vector<Dart> across_;  // alpha_0 by name; no_dart where there is no dart
};

/// Colours the darts so that every alpha changes the colour; returns a reason if that, or betas, are impossible. The
/// first dart of a component is positive if `starts_positive` says so.
template <class F>
std::string colour(const AlphaList& list, std::vector<bool>& positive, F&& starts_positive) {
  const std::size_t names = list.darts.empty() ? 0 : list.darts.back().index + 1u;
  std::vector<std::size_t> row(names);
  std::vector<signed char> of(names, 0);
  for (std::size_t k = 0; k < list.darts.size(); ++k) row[list.darts[k].index] = k;
  std::vector<Dart> stack;
  for (std::size_t k = 0; k < list.darts.size(); ++k) {
    const Dart seed = list.darts[k];
    if (of[seed.index] != 0) continue;
    of[seed.index] = starts_positive(seed) ? 1 : -1;
    stack.assign(1, seed);
    while (!stack.empty()) {
      const Dart d = stack.back();
      stack.pop_back();
      const auto& alphas = list.alphas[row[d.index]];
      for (int i = 0; i <= list.dimension; ++i) {
        const Dart e = alphas[static_cast<std::size_t>(i)];
        if (e == d && i < 2) return fmt::format("{} is {}-free", to_string(d), i);
        if (e == d) continue;
        if (i >= 2 && e == alphas[0]) return fmt::format("alpha{0}({1}) = alpha0({1}), a fold", i, to_string(d));
        if (of[e.index] == 0) {
          of[e.index] = static_cast<signed char>(-of[d.index]);
          stack.push_back(e);
        } else if (of[e.index] == of[d.index]) {
          return fmt::format("not orientable (seen at alpha{}({}) = {})", i, to_string(d), to_string(e));
        }
      }
    }
  }
  positive.assign(names, false);
  for (std::size_t k = 0; k < names; ++k) positive[k] = of[k] == 1;
  return {};
}

template <class Twin>
bool isomorphic_from_each_component(const Twin& a, const Twin& b) {
  const auto darts = a.darts();
  if (darts != b.darts()) return false;
  const auto component = a.labels(all_involutions(a.dimension()));
  std::vector<bool> compared(darts.empty() ? 0 : darts.back().index + 1u, false);
  for (std::size_t k = 0; k < darts.size(); ++k) {
    const auto from = a.handle(darts[k]);  // null for the negative darts of a combinatorial map
    if (from == nullptr || compared[component[k].index]) continue;
    compared[component[k].index] = true;
    const auto to = b.handle(darts[k]);
    if (to == nullptr || !a.map().are_cc_isomorphic(from, b.map(), to, false, false, false)) return false;
  }
  return true;
}

template <int N>
std::optional<bool> isomorphic_in_dimension(const MapTwin& twin, const AlphaList& alphas) {
  if (const auto* gmap = dynamic_cast<const CgalGmapTwin<N>*>(&twin))
    return isomorphic_from_each_component(*gmap, CgalGmapTwin<N>(alphas));
  const auto* cmap = dynamic_cast<const CgalCmapTwin<N>*>(&twin);
  if (cmap == nullptr) return std::nullopt;
  // a component and its mirror image are two combinatorial maps: orient the fresh one like the old one
  std::vector<bool> positive;
  if (!colour(alphas, positive, [&](Dart d) { return cmap->is_positive(d); }).empty()) return false;
  return isomorphic_from_each_component(*cmap, CgalCmapTwin<N>(alphas, positive));
}

}  // namespace

std::unique_ptr<MapTwin> make_cgal_gmap_twin(const AlphaList& alphas) {
  if (alphas.dimension == 2) return std::make_unique<CgalGmapTwin<2>>(alphas);
  return std::make_unique<CgalGmapTwin<3>>(alphas);
}

std::unique_ptr<MapTwin> make_cgal_cmap_twin(const AlphaList& alphas, std::string* why_not) {
  std::vector<bool> positive;
  const std::string reason = colour(alphas, positive, [](Dart) { return true; });
  if (why_not) *why_not = reason;
  if (!reason.empty()) return nullptr;
  if (alphas.dimension == 2) return std::make_unique<CgalCmapTwin<2>>(alphas, positive);
  return std::make_unique<CgalCmapTwin<3>>(alphas, positive);
}

bool are_isomorphic(const MapTwin& cgal_twin, const AlphaList& alphas) {
  if (cgal_twin.dimension() != alphas.dimension) return false;
  if (const auto is = isomorphic_in_dimension<2>(cgal_twin, alphas)) return *is;
  if (const auto is = isomorphic_in_dimension<3>(cgal_twin, alphas)) return *is;
  throw InputError("a twin carried by CGAL is expected");
}

}  // namespace dartboard
