#pragma once
// The treatment of directions in which a tangent is negative.

#include <cstdint>

namespace dartboard {

/// The treatment of the negative eigenvalues of compressed springs and elements.
enum class Compression : std::uint8_t {
  exact,     // nothing: the tangent may be indefinite
  projected  // they are set to zero: the nearest positive semidefinite matrix of each spring or element
};

}  // namespace dartboard
