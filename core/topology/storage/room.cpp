#include "core/topology/storage/room.h"

#include <fmt/format.h>

#include "core/plain/error.h"

namespace dartboard {

void throw_no_room(std::uint64_t used, std::uint64_t more, std::uint64_t most, const char* what) {
  throw TopologyError(
      fmt::format("cannot add {} to the {} {} of a map: it numbers at most {}", more, used, what, most));
}

}  // namespace dartboard
