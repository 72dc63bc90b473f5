#pragma once
// The four exceptions of the project. A simulation that blows up is a result with a status, not an exception.

#include <stdexcept>
#include <string>

namespace dartboard {

/// A value supplied by the caller is not allowed; the message names it and what was expected.
struct InputError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// A file could not be read or written, or its contents are malformed; the message names file, line and expectation.
struct IoError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A topological operation was called against its conditions; the map is unchanged.
struct TopologyError : std::logic_error {
  using std::logic_error::logic_error;
};

/// A linear or nonlinear solve failed.
struct SolverError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace dartboard
