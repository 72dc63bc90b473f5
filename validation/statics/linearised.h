#pragma once
// The linearised motion of springs and elements, as two matrices.

#include <Eigen/Core>
#include <span>

#include "core/time/system/spring_system.h"
#include "reference/elements/held_solid.h"

namespace dartboard {

/// The stiffness of a system's springs and force terms at x, and its masses; its fixed vertices are held.
reference::HeldSolid linearised(const SpringSystem& system, std::span<const Eigen::Vector3d> x,
                                Compression compression = Compression::exact);

}  // namespace dartboard
