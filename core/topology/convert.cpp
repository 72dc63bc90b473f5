#include "core/topology/convert.h"

#include "core/plain/error.h"
#include "core/topology/cells.h"
#include "core/topology/summary.h"

namespace dartboard {

Map3 to_general(const TetMap& map) {
  Map3 general;
  const auto end = static_cast<std::uint32_t>(map.capacity());
  for (std::uint32_t d = 0; d < end; ++d) general.add_dart();
  for (std::uint32_t d = 0; d < end; ++d)
    if (!map.is_live({d})) general.remove_dart({d});
  const auto copy = [&]<int i>(std::integral_constant<int, i>) {
    map.for_each_dart([&](Dart d) {
      const Dart e = map.alpha<i>(d);
      if (d < e) general.link<i>(d, e);
    });
  };
  copy(std::integral_constant<int, 0>{});
  copy(std::integral_constant<int, 1>{});
  copy(std::integral_constant<int, 2>{});
  copy(std::integral_constant<int, 3>{});
  return general;
}

template <class Map>
CombinatorialMap to_combinatorial_map(const Map& map) {
  const auto sign = orientation(map);
  if (!sign) throw InputError("the map is not orientable: it has no combinatorial map");
  CombinatorialMap out;
  out.dimension = Map::dimension;
  std::vector<std::uint32_t> number(map.capacity(), CombinatorialMap::none);
  std::uint32_t count = 0;
  map.for_each_dart([&](Dart d) {
    if (map.template is_free<0>(d) || map.template is_free<1>(d))
      throw InputError(to_string(d) + " is 0- or 1-free: it has no counterpart in a combinatorial map");
    if ((*sign)[d.index] > 0) number[d.index] = count++;
  });
  out.beta.resize(count, {CombinatorialMap::none, CombinatorialMap::none, CombinatorialMap::none});
  map.for_each_dart([&](Dart d) {
    if ((*sign)[d.index] < 0) return;
    const Dart across = map.template alpha<0>(d);
    for (int i = 1; i <= Map::dimension; ++i)
      if (!map.is_free(i, across))
        out.beta[number[d.index]][static_cast<std::size_t>(i - 1)] = number[map.alpha(i, across).index];
  });
  return out;
}

template <int n>
GeneralizedMap<n> to_generalized_map(const CombinatorialMap& in) {
  GeneralizedMap<n> map;
  const auto count = static_cast<std::uint32_t>(in.beta.size());
  for (std::uint32_t d = 0; d < 2 * count; ++d) map.add_dart();
  for (std::uint32_t d = 0; d < count; ++d) {
    map.template link<0>({2 * d}, {2 * d + 1});
    const auto& beta = in.beta[d];
    if (beta[0] != CombinatorialMap::none) map.template link<1>({2 * d + 1}, {2 * beta[0]});
  }
  // beta_i takes d to the dart that runs the other way along the same edge
  const auto link = [&]<int i>(std::integral_constant<int, i>) {
    for (std::uint32_t d = 0; d < count; ++d) {
      const std::uint32_t e = in.beta[d][i - 1];
      if (e == CombinatorialMap::none || e < d) continue;
      map.template link<i>({2 * d + 1}, {2 * e});
      if (e != d) map.template link<i>({2 * d}, {2 * e + 1});
    }
  };
  link(std::integral_constant<int, 2>{});
  if constexpr (n == 3) link(std::integral_constant<int, 3>{});
  return map;
}

namespace {

// Extend "a goes to b" along all alphas; true if it never contradicts itself. `image` and `taken` are put back on
// failure.
template <class A, class B>
bool extend(const A& a, const B& b, Dart from, Dart to, std::vector<Dart>& image, std::vector<bool>& taken) {
  std::vector<Dart> done{from};
  image[from.index] = to;
  taken[to.index] = true;
  bool fits = true;
  for (std::size_t k = 0; k < done.size() && fits; ++k)
    for (int i = 0; i <= A::dimension && fits; ++i) {
      const Dart x = a.alpha(i, done[k]), y = b.alpha(i, image[done[k].index]);
      if (image[x.index] == no_dart && !taken[y.index]) {
        image[x.index] = y;
        taken[y.index] = true;
        done.push_back(x);
      } else {
        fits = image[x.index] == y;
      }
    }
  if (!fits)
    for (const Dart d : done) {
      taken[image[d.index].index] = false;
      image[d.index] = no_dart;
    }
  return fits;
}

}  // namespace

template <class A, class B>
bool are_isomorphic(const A& a, const B& b) {
  static_assert(A::dimension == B::dimension);
  if (a.dart_count() != b.dart_count()) return false;
  // Components can be matched greedily: isomorphism is an equivalence, so any free component that fits will do.
  std::vector<Dart> image(a.capacity(), no_dart);
  std::vector<bool> taken(b.capacity(), false);
  bool all = true;
  for_each_orbit(a, all_involutions(A::dimension), [&](Dart seed) {
    if (!all) return;
    bool found = false;
    const auto end = static_cast<std::uint32_t>(b.capacity());
    for (std::uint32_t d = 0; d < end && !found; ++d)
      found = b.is_live({d}) && !taken[d] && extend(a, b, seed, Dart{d}, image, taken);
    all = found;
  });
  return all;
}

DARTBOARD_CONVERT()

}  // namespace dartboard
