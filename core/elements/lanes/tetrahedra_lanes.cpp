#include "core/elements/lanes/tetrahedra_lanes.h"

#include "core/elements/lanes/four_laws.h"

namespace dartboard {

#ifdef DARTBOARD_HAS_AVX2
namespace {

DARTBOARD_AVX2_INLINE FourVectors corners_at(const double* x, const std::array<std::uint32_t, 4>* n,
                                             std::size_t corner) {
  return vectors_at(x + std::size_t{3} * n[0][corner], x + std::size_t{3} * n[1][corner],
                    x + std::size_t{3} * n[2][corner], x + std::size_t{3} * n[3][corner]);
}

template <class Constants>
DARTBOARD_AVX2 std::size_t add_in_lanes(const TetrahedraAt& at, const Constants& law, std::size_t first,
                                        std::size_t last) {
  const std::array<std::uint32_t, 4>* const nodes = at.nodes;
  const double *const x = at.x->data(), *const shapes = at.shape->data(), *const mass = at.mass;
  double* const force = at.force->data();
  const Four minus_per_mass = four(-at.per_mass);
  std::size_t c = first;
  for (; c + 4 <= last; c += 4) {
    const std::array<std::uint32_t, 4>* const n = nodes + c;
    const FourMatrices shape = matrices_at(shapes + 9 * c);
    const FourVectors origin = corners_at(x, n, 0);
    const FourMatrices edges{corners_at(x, n, 1) - origin, corners_at(x, n, 2) - origin, corners_at(x, n, 3) - origin};
    FourMatrices stress;
    if (!stress_of(law, edges * shape, stress)) break;
    const FourMatrices weighted = (minus_per_mass * _mm256_loadu_pd(mass + c)) * stress;
    // by the rows of the shape
    const FourVectors one = weighted * FourVectors{shape.a.x, shape.b.x, shape.c.x};
    const FourVectors two = weighted * FourVectors{shape.a.y, shape.b.y, shape.c.y};
    const FourVectors three = weighted * FourVectors{shape.a.z, shape.b.z, shape.c.z};
    const FourRows sums = rows_of(one + two + three);
    const FourRows ones = rows_of(one), twos = rows_of(two), threes = rows_of(three);
    for (std::size_t lane = 0; lane < 4; ++lane) {
      subtract_from(force + std::size_t{3} * n[lane][0], sums.xy[lane], sums.z[lane]);
      add_to(force + std::size_t{3} * n[lane][1], ones.xy[lane], ones.z[lane]);
      add_to(force + std::size_t{3} * n[lane][2], twos.xy[lane], twos.z[lane]);
      add_to(force + std::size_t{3} * n[lane][3], threes.xy[lane], threes.z[lane]);
    }
  }
  return c;
}

// Products of edges and the gradients of their corners. One by one they are added to zero, which only changes the sign
// of a zero, and that gets lost below where forces are added to zero.
DARTBOARD_AVX2_INLINE FourVectors sum_of(const FourMatrices& edges, const FourVectors& gradient) {
  return gradient.x * edges.a + gradient.y * edges.b + gradient.z * edges.c;
}
DARTBOARD_AVX2_INLINE FourMatrices gradients_of(const double* x, const std::array<std::uint32_t, 4>* n,
                                                const FourMatrices& shape) {
  const FourVectors origin = corners_at(x, n, 0);
  const FourMatrices edges{corners_at(x, n, 1) - origin, corners_at(x, n, 2) - origin, corners_at(x, n, 3) - origin};
  return {sum_of(edges, shape.a), sum_of(edges, shape.b), sum_of(edges, shape.c)};
}

DARTBOARD_AVX2 std::size_t add_damping(const TetrahedraAt& at, const Eigen::Vector3d* velocities,
                                       const DampingConstants& material, std::size_t first, std::size_t last) {
  const std::array<std::uint32_t, 4>* const nodes = at.nodes;
  const double *const x = at.x->data(), *const v = velocities->data(), *const shapes = at.shape->data(),
                      *const mass = at.mass;
  double* const force = at.force->data();
  const Four per_mass = four(at.per_mass);
  std::size_t c = first;
  for (; c + 4 <= last; c += 4) {
    const std::array<std::uint32_t, 4>* const n = nodes + c;
    const FourMatrices shape = matrices_at(shapes + 9 * c);
    const FourMatrices f = gradients_of(x, n, shape), rate = gradients_of(v, n, shape);
    const FourMatrices weighted = damping_of(material, per_mass * _mm256_loadu_pd(mass + c), f, rate);
    const FourVectors none{four(0.0), four(0.0), four(0.0)};
    const FourVectors one = none + weighted * FourVectors{shape.a.x, shape.b.x, shape.c.x};
    const FourVectors two = none + weighted * FourVectors{shape.a.y, shape.b.y, shape.c.y};
    const FourVectors three = none + weighted * FourVectors{shape.a.z, shape.b.z, shape.c.z};
    const FourRows sums = rows_of(none + one + two + three);
    const FourRows ones = rows_of(one), twos = rows_of(two), threes = rows_of(three);
    for (std::size_t lane = 0; lane < 4; ++lane) {
      subtract_from(force + std::size_t{3} * n[lane][1], ones.xy[lane], ones.z[lane]);
      subtract_from(force + std::size_t{3} * n[lane][2], twos.xy[lane], twos.z[lane]);
      subtract_from(force + std::size_t{3} * n[lane][3], threes.xy[lane], threes.z[lane]);
      add_to(force + std::size_t{3} * n[lane][0], sums.xy[lane], sums.z[lane]);
    }
  }
  return c;
}

}  // namespace

template <class Constants>
std::size_t add_forces_in_lanes(const TetrahedraAt& at, const Constants& law, std::size_t first, std::size_t last) {
  return add_in_lanes(at, law, first, last);
}
std::size_t add_damping_in_lanes(const TetrahedraAt& at, const Eigen::Vector3d* v, const DampingConstants& material,
                                 std::size_t first, std::size_t last) {
  return add_damping(at, v, material, first, last);
}
#else
template <class Constants>
std::size_t add_forces_in_lanes(const TetrahedraAt&, const Constants&, std::size_t first, std::size_t) {
  return first;
}
std::size_t add_damping_in_lanes(const TetrahedraAt&, const Eigen::Vector3d*, const DampingConstants&,
                                 std::size_t first, std::size_t) {
  return first;
}
#endif

template std::size_t add_forces_in_lanes(const TetrahedraAt&, const NeoHookeanConstants&, std::size_t, std::size_t);
template std::size_t add_forces_in_lanes(const TetrahedraAt&, const StVenantKirchhoffConstants&, std::size_t,
                                         std::size_t);
template std::size_t add_forces_in_lanes(const TetrahedraAt&, const CorotationalConstants&, std::size_t, std::size_t);

}  // namespace dartboard
