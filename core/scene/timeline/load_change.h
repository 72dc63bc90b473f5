#pragma once
// What the loads of a scene report at a step boundary.

namespace dartboard {

/// The change of a load at a step boundary, the largest last: of a path, a turn or a force over time in its value; or a
/// force, or a motion, begins, turns back or ends.
enum class LoadChange { none, in_value, begins_or_ends };

}  // namespace dartboard
