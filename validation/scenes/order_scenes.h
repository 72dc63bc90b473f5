#pragma once
// The scenes in which orders of convergence are observed.

#include <string_view>
#include <vector>

#include "validation/scenes/table_scene.h"

namespace dartboard {

/// The variants of the scene of the study.
enum class OrderCase { undamped, damped, aligned_cut, unaligned_cut };
inline constexpr OrderCase order_cases[]{OrderCase::undamped, OrderCase::damped, OrderCase::aligned_cut,
                                         OrderCase::unaligned_cut};
/// "undamped", "damped", "aligned cut", "unaligned cut".
std::string_view name(OrderCase which);

/// Set a body off equilibrium, in positions and in velocities: a linear field that stretches, shears and turns it, and
/// a random part of a tenth of that. `strain` is the size of the field; velocities are those of one such strain per
/// 1/rate. Fixed points stay.
///
/// From rest, or from the rest shape, some methods of order 1 look like order 2.
void set_off(TableScene& scene, double strain, double rate);

/// A jittered box of 3 x 3 x 3 cubes under gravity, one edge of it held, for 16.5 / omega_max. Undamped, or with a
/// damping ratio of 0.1 at omega_max. The aligned cut is a plane cut, then a fan torn at an interior vertex, both at
/// 3/8 of the duration, where steps end; the unaligned one is the plane cut at 7/18, where no step ends for 24 * 2^k
/// steps.
TableScene order_scene(OrderCase which);

/// A body moving softly and smoothly, free and undamped, for `phase` / omega_max: the starting point of work-precision
/// diagrams.
TableScene smooth_scene(Mesh mesh, const Material& material, double phase);

}  // namespace dartboard
