#include "reference/elements/held_solid.h"

#include "reference/elements/held_factor.h"

namespace dartboard::reference {

Eigen::VectorXd HeldSolid::displacements(const Eigen::VectorXd& force) const {
  return HeldFactor(*this).displacements(force);
}

std::vector<double> HeldSolid::frequencies(std::size_t count) const { return HeldFactor(*this).frequencies(count); }

}  // namespace dartboard::reference
