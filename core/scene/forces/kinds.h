#pragma once
// The kinds of force, each in the source of its name.

#include "core/scene/file/force_kind.h"

namespace dartboard {

ForceKind bending_kind();
ForceKind attachments_kind();
ForceKind pressures_kind();
ForceKind air_kind();

/// In the order in which their forces are added.
inline constexpr ForceKind (*kinds_in_order[])() = {bending_kind, attachments_kind, pressures_kind, air_kind};

}  // namespace dartboard
