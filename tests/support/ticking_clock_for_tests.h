#pragma once

#include <cstdint>

#include "validation/scenes/scene_stage.h"

namespace dartboard {

/// A clock that advances by a microsecond at each reading: the same choices on every machine.
inline CpuClock ticking() {
  return [t = std::int64_t{0}]() mutable { return t += 1000; };
}

}  // namespace dartboard
