#pragma once
// The message of a refused change of a map.

#include <functional>
#include <string>

#include "core/plain/error.h"

namespace dartboard {

/// The message of the TopologyError that `action` throws; "no throw" if it does not.
inline std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const TopologyError& error) {
    return error.what();
  }
  return "no throw";
}

}  // namespace dartboard
