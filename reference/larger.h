#pragma once
// The maximum that does not hide what is not a number: std::max(a, NaN) is a.

#include <cmath>

namespace dartboard::reference {

/// The larger of two; NaN if one of them is.
template <class Real>
Real larger(Real a, Real b) {
  return std::isnan(a) || a >= b ? a : b;
}

}  // namespace dartboard::reference
