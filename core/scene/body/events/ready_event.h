#pragma once
// The interface of an event on a body: looked up once at the start, applied when it is due.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/archive.h"

namespace dartboard {

/// The darts of the cells that an event has operated on. Operations are deterministic: after the same ones, the darts
/// of all bodies made of one scene have the same numbers, wherever their vertices are.
using EventTargets = std::vector<std::uint32_t>;

/// An event made ready for one body: all that it refers to has been looked up once, at the start.
class ReadyEvent {
 public:
  virtual ~ReadyEvent() = default;
  /// Apply it to the body it was made for, and add what it operates on to `taken` unless that is null.
  ///
  /// returns  operations made: faces dissociated (of a surface, edges), cells removed, vertices put in by refinement
  /// throws   StressError if a stress is not finite
  virtual std::size_t apply(EventTargets* taken) = 0;
  std::size_t apply() { return apply(nullptr); }
  /// Operate on what `apply` has taken from another body of the same scene, whatever this event would choose here.
  ///
  /// pre      the same operations have been applied to both bodies so far
  /// returns  as `apply`
  virtual std::size_t repeat(const EventTargets& taken) = 0;
  /// For a cut: how many faces between cells (of a surface, edges between faces) it would dissociate now.
  virtual std::optional<std::size_t> facets() const { return std::nullopt; }
  /// Writes or reads its own state, which applying it changes: a stream of random numbers.
  virtual void state(Archive&) {}
  /// Memory that it keeps (core/scene/body/memory.h).
  virtual std::size_t bytes() const { return 0; }
};

}  // namespace dartboard
