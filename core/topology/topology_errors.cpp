#include "core/topology/topology_errors.h"

#include <fmt/format.h>

#include "core/plain/error.h"

namespace dartboard {

void throw_dead(Dart d, std::uint32_t expected, std::uint32_t found) {
  if (d == no_dart) throw TopologyError("no dart given, expected a live one");
  if (found != 0)
    throw TopologyError(fmt::format("{} has died and its slot holds another dart (generation {}, expected {})",
                                    to_string(d), found, expected));
  throw TopologyError(fmt::format("{} is dead, expected a live dart", to_string(d)));
}

void throw_link_to_itself(int i, Dart d) {
  throw TopologyError(
      fmt::format("cannot {0}-link {1} to itself: alpha{0}({1}) = {1} is what {0}-free means", i, to_string(d)));
}

void throw_turned_face(Dart a, Dart b) {
  throw TopologyError(fmt::format("cannot 3-link {} to {}: a turn of a triangle onto itself is not an involution",
                                  to_string(a), to_string(b)));
}

void throw_not_free(int i, Dart a, Dart b, Dart which, Dart alpha) {
  throw TopologyError(fmt::format("cannot {}-link {} to {}: alpha{}({}) = {}, expected free", i, to_string(a),
                                  to_string(b), i, to_string(which), to_string(alpha)));
}

void throw_cannot_remove(int i, Dart d, Dart alpha) {
  throw TopologyError(fmt::format("cannot remove {}: alpha{}({}) = {}, expected free", to_string(d), i, to_string(d),
                                  to_string(alpha)));
}

void throw_not_sewable(int i, Dart a, Dart b, const std::string& why) {
  throw TopologyError(fmt::format("cannot {}-sew {} and {}: {}", i, to_string(a), to_string(b), why));
}

void throw_invalid(const char* after, const std::string& violation) {
  throw TopologyError(fmt::format("the map is invalid after {}: {}", after, violation));
}

}  // namespace dartboard
