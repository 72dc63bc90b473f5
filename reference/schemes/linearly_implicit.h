#pragma once
// The linear system that baraff-witkin solves in a step.

#include <vector>

#include "reference/schemes/network_state.h"

namespace dartboard::reference {

/// The residual of v1 in A v1 = M (v0 + h a), A = M + h C + h^2 K, with forces and matrix at the next positions of held
/// points, over what a solver to 1e-12 and rounding in double leave. With exact tangents, or with projected ones if the
/// exact matrix is not positive definite.
/// source  Baraff, Witkin 1998
Extended linearly_implicit_excess(const SpringNetwork& network, const std::vector<Vector3<Extended>>& x0,
                                  const std::vector<Vector3<Extended>>& v0, const std::vector<Vector3<Extended>>& v1,
                                  Extended h);

}  // namespace dartboard::reference
