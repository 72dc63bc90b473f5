#pragma once
// Operations on a moving body, and what they must not change: masses, stiffnesses, momenta, energies.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/mechanics/adapt.h"
#include "core/plain/problem.h"
#include "core/views/views.h"

namespace dartboard {

/// A body that operations can follow.
template <class Map>
using LiveBody = MassSpringBody<Map, Held::by_every_dart>;

/// The changes that a body and its views reported for a change of the map.
struct Followed {
  ChangedEmbeddings embeddings;
  ComponentChange components;
};
/// The functions that make them follow: core's, or a faulty stand-in.
template <class Map>
using Follow = std::function<Followed(LiveBody<Map>&, Views&, const TopologyChange&)>;
/// `adapt`, then `apply`.
template <class Map>
Followed follow(LiveBody<Map>& body, Views& views, const TopologyChange& change) {
  Followed followed{adapt(body, change), {}};
  followed.components = views.apply(body, change, followed.embeddings);
  return followed;
}

struct ConservationPlan {
  std::uint64_t seed = 1;
  std::size_t operations = 1000;
  std::size_t everything_every = 100;  // operations between two comparisons of everything; one at start and end too
  std::size_t oracle_every = 1000;  // operations between two comparisons with a body built from scratch; one at the end
  int oracle_steps = 10;
  int reference_steps = 100;                       // steps of the reference alone at each of these
  std::function<void(std::size_t done)> progress;  // called every 1000 operations or so
};

/// A quantity compared, how often, and how close it came to its bound.
struct ConservedRow {
  std::string what;
  std::size_t checks = 0;
  std::optional<double> bound;  // of the check that came closest to it; none if the bits must agree
  double deviation = 0.0;       // of that check
  double largest = 0.0;         // deviation of any check
  bool holds = true;
};

/// The first comparison that failed.
struct Violation {
  std::string what;
  std::size_t operation = 0;  // number of operations before
  std::uint64_t seed = 0;
  std::string actual, expected, bound;
};
std::string to_string(const Violation& violation);

struct ConservationResult {
  std::size_t dissociations = 0, tears = 0, removals = 0, refinements = 0;  // these are the operations
  std::size_t parts_split_off = 0, series = 0, steps = 0, refills = 0;
  std::size_t whole_comparisons = 0;                              // of everything, views against rebuilt ones included
  std::size_t bodies_from_scratch = 0, bodies_without_bound = 0;  // the latter where a spring is too short for one
  std::vector<ConservedRow> rows;
  std::optional<Violation> violation;

  std::size_t operations() const { return dissociations + tears + removals + refinements; }
};

/// Take a moving body apart at random, in series of one to four operations, until nothing is left; then again with a
/// fresh one. A solid loses faces, fans of faces and volumes, a surface edges and faces.
///
/// After each series: numbers of cells as the change predicts; masses, springs, their ends in the views and states of
/// all that changed against the cells that remain (RemainingCells, which knows no dart); the conserved sums of the
/// whole body, against those before and the share of what was removed. Now and then everything, against
/// reference/rebuild, and all views against rebuilt ones; after every series once the body is small. Of the components
/// that come loose some are split off as bodies of their own (split_comparison.h); the others stay. Now and then the
/// motion against that of a body built from scratch (rebuild_oracle.h), and of the cells that remain, moved by the
/// reference alone (reference_motion.h). It stops at the first violation.
///
/// Relative sums are in units of the sum of the absolute values.
/// throws  InputError if the mesh is not of the dimension of the map, or is one that build_body refuses
template <class Map>
ConservationResult validate_conservation(const Problem& start, const ConservationPlan& plan,
                                         const Follow<Map>& followed = follow<Map>);

/// A problem to take apart: gravity, a sixteenth of the points held still, a random linear field of velocities that
/// stretches the springs by some per cent, and a step far below the stability limit of RK4, also for each cell alone.
Problem moving_problem(Mesh mesh, const Material& material, std::uint64_t seed);

extern template ConservationResult validate_conservation(const Problem&, const ConservationPlan&, const Follow<Map2>&);
extern template ConservationResult validate_conservation(const Problem&, const ConservationPlan&, const Follow<Map3>&);
extern template ConservationResult validate_conservation(const Problem&, const ConservationPlan&,
                                                         const Follow<TetMap>&);

}  // namespace dartboard
