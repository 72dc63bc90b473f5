#pragma once
// The energy of one linear tetrahedron by three elastic laws, in long double: a witness of elements, term by term.

#include <Eigen/Core>
#include <array>

#include "core/plain/material.h"

namespace dartboard::reference {

/// Energy [J] of a tetrahedron of this material that is at `rest` when it is stress-free and is at `now`.
///
/// Sums are plain and no roots are searched: rotations are those of a singular value decomposition. Written from the
/// definitions (core/elements/elastic_laws.h gives the same ones), using only the material from core.
/// pre     the material is one of elements; the tetrahedron at rest has a volume, of either sign
/// source  Smith, de Goes, Kim 2018; Mueller, Gross 2004
long double tetrahedron_energy(const Material& material, const std::array<Eigen::Vector3d, 4>& rest,
                               const std::array<Eigen::Vector3d, 4>& now);

}  // namespace dartboard::reference
