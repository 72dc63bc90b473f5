#pragma once
// The messages of topology, kept out of the templates that need them. All throw TopologyError.

#include <cstdint>
#include <string>

#include "core/topology/storage/dart.h"

namespace dartboard {

/// `expected` 0: a plain dart was used; else the generation that a DartId asked for.
[[noreturn]] void throw_dead(Dart d, std::uint32_t expected, std::uint32_t found);
[[noreturn]] void throw_link_to_itself(int i, Dart d);
[[noreturn]] void throw_turned_face(Dart a, Dart b);
[[noreturn]] void throw_not_free(int i, Dart a, Dart b, Dart which, Dart alpha);
[[noreturn]] void throw_cannot_remove(int i, Dart d, Dart alpha);
[[noreturn]] void throw_not_sewable(int i, Dart a, Dart b, const std::string& why);
/// An operation left the map in violation of a condition: a bug of ours, detected before it spreads.
[[noreturn]] void throw_invalid(const char* after, const std::string& violation);

}  // namespace dartboard
