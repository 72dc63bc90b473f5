#pragma once
// Section 5.1 and Fig. 10: one dissociated face seldom takes a vertex apart, a whole fan always does.

#include <functional>
#include <vector>

#include "core/plain/mesh.h"
#include "core/topology/generalized_map.h"
#include "validation/topology/claim_answer.h"

namespace dartboard {

/// The faces of the fan of a dart: core's, or a faulty stand-in.
using FanOf = std::function<std::vector<Dart>(const TetMap&, Dart)>;
FanOf core_fan();

struct FanAnswers {
  ClaimAnswer one_face;   // seldom: one inner face in ten, or fewer, takes a vertex apart
  ClaimAnswer whole_fan;  // always
  ClaimAnswer ends;       // each fan ends where its first dart is reached again or at the surface
};

/// Every inner face of a mesh of tetrahedra, and the fan that starts with it at each of its corners. Whether a vertex
/// stays connected is decided on the cells around its mesh point without the dissociated sides, by a witness that knows
/// no dart, and must agree with the report of core's operation; the end of a fan is found by the letter of section 5.1
/// on plain numbers.
FanAnswers try_fans(const Mesh& mesh, const FanOf& fan = core_fan());

}  // namespace dartboard
