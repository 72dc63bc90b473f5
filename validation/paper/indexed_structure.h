#pragma once
// Section 5.2: "it is not possible to translate the atomic topological operations into modifications in the adjacency
// graph". Here views are such translations.

#include "core/views/views.h"
#include "validation/paper/cut_subject.h"
#include "validation/topology/claim_answer.h"

namespace dartboard {

/// Dissociate random faces, every eighth time remove a volume, and translate each into changes of an indexed structure
/// alone: arrays of springs with the numbers of their ends, masses and stiffnesses, never built again. After each
/// operation it must agree with the remaining cells, found without a dart: as many springs as the cells have edges,
/// each with the stiffness that its cells give and between the two numbers of its ends. Success shows that it is
/// possible: the paper says it is not.
ClaimAnswer translate_operations(const Problem& problem, int operations, std::uint64_t seed,
                                 const Follow<Map3>& translate = follow<Map3>);

}  // namespace dartboard
