#include "core/elements/lanes/solids_lanes.h"

#include "core/elements/lanes/four_laws.h"

namespace dartboard {

#ifdef DARTBOARD_HAS_AVX2
namespace {

constexpr std::size_t most_corners = 8;

/// The gradients of the shape functions but the first, at four Gauss points.
struct FourPoints {
  FourVectors gradient[most_corners];
};

DARTBOARD_AVX2_INLINE FourPoints points_from(const GaussPointsAt& at, std::size_t first) {
  const FourMatrices inverse = matrices_at(at.inverse[first].data());
  FourPoints points;
  for (std::size_t a = 1; a < at.corners; ++a) {
    const auto* const own = at.gradients + first;
    const FourVectors g = vectors_at(own[0][a].data(), own[1][a].data(), own[2][a].data(), own[3][a].data());
    points.gradient[a] = {dot(inverse.a, g), dot(inverse.b, g), dot(inverse.c, g)};
  }
  return points;
}

/// sum line_a g_a'.
DARTBOARD_AVX2_INLINE FourMatrices deformation_of(const FourPoints& points, const Eigen::Vector3d* lines,
                                                  std::size_t corners) {
  const FourVectors none{four(0.0), four(0.0), four(0.0)};
  FourMatrices f{none, none, none};
  for (std::size_t a = 1; a < corners; ++a) {
    const FourVectors line{four(lines[a].x()), four(lines[a].y()), four(lines[a].z())};
    const FourVectors& g = points.gradient[a];
    f = f + FourMatrices{g.x * line, g.y * line, g.z * line};
  }
  return f;
}

DARTBOARD_AVX2_INLINE void add_to_sums(const FourMatrices& weighted, const FourPoints& points, std::size_t corners,
                                       Eigen::Vector3d* sum) {
  for (std::size_t a = 1; a < corners; ++a) {
    const FourRows rows = rows_of(weighted * points.gradient[a]);
    double* const row = sum[a].data();
    __m128d xy = _mm_loadu_pd(row), z = _mm_load_sd(row + 2);
    for (std::size_t lane = 0; lane < 4; ++lane) {
      xy = _mm_add_pd(xy, rows.xy[lane]);
      z = _mm_add_sd(z, rows.z[lane]);
    }
    _mm_storeu_pd(row, xy);
    _mm_store_sd(row + 2, z);
  }
}

template <class Constants>
DARTBOARD_AVX2 std::size_t add_stresses(const GaussPointsAt& at, const Constants& law, const Eigen::Vector3d* lines,
                                        Eigen::Vector3d* sum) {
  std::size_t q = 0;
  for (; q + 4 <= at.count; q += 4) {
    const FourPoints points = points_from(at, q);
    FourMatrices stress;
    if (!stress_of(law, deformation_of(points, lines, at.corners), stress)) break;
    add_to_sums(_mm256_loadu_pd(at.volume + q) * stress, points, at.corners, sum);
  }
  return q;
}

DARTBOARD_AVX2 std::size_t add_damping(const GaussPointsAt& at, const DampingConstants& material,
                                       const Eigen::Vector3d* lines, const Eigen::Vector3d* speeds,
                                       Eigen::Vector3d* sum) {
  std::size_t q = 0;
  for (; q + 4 <= at.count; q += 4) {
    const FourPoints points = points_from(at, q);
    const FourMatrices f = deformation_of(points, lines, at.corners), rate = deformation_of(points, speeds, at.corners);
    add_to_sums(damping_of(material, _mm256_loadu_pd(at.volume + q), f, rate), points, at.corners, sum);
  }
  return q;
}

}  // namespace

template <class Constants>
std::size_t add_stresses_in_lanes(const GaussPointsAt& at, const Constants& law, const Eigen::Vector3d* lines,
                                  Eigen::Vector3d* sum) {
  return at.count < 4 ? 0 : add_stresses(at, law, lines, sum);
}
std::size_t add_damping_in_lanes(const GaussPointsAt& at, const DampingConstants& material,
                                 const Eigen::Vector3d* lines, const Eigen::Vector3d* speeds, Eigen::Vector3d* sum) {
  return at.count < 4 ? 0 : add_damping(at, material, lines, speeds, sum);
}
#else
template <class Constants>
std::size_t add_stresses_in_lanes(const GaussPointsAt&, const Constants&, const Eigen::Vector3d*, Eigen::Vector3d*) {
  return 0;
}
std::size_t add_damping_in_lanes(const GaussPointsAt&, const DampingConstants&, const Eigen::Vector3d*,
                                 const Eigen::Vector3d*, Eigen::Vector3d*) {
  return 0;
}
#endif

template std::size_t add_stresses_in_lanes(const GaussPointsAt&, const NeoHookeanConstants&, const Eigen::Vector3d*,
                                           Eigen::Vector3d*);
template std::size_t add_stresses_in_lanes(const GaussPointsAt&, const StVenantKirchhoffConstants&,
                                           const Eigen::Vector3d*, Eigen::Vector3d*);
template std::size_t add_stresses_in_lanes(const GaussPointsAt&, const CorotationalConstants&, const Eigen::Vector3d*,
                                           Eigen::Vector3d*);

}  // namespace dartboard
