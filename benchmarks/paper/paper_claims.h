#pragma once
// The checkable sentences of the paper; `reproduce` answers them.

#include <array>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "benchmarks/harness/claim.h"

namespace dartboard {

/// The subject of a sentence of the paper: maps and bodies, which are the same here; times, which belong to its machine
/// and programs; or what its authors thought that programs could not do.
enum class About { bodies, times, programs };

struct PaperClaim {
  std::string_view id, text, section, paper_value;
  About about = About::bodies;
  std::string_view does_not_carry_over{};  // why it does not, if that is known; else it is expected to hold
};

/// In the order of the paper.
inline constexpr std::array<PaperClaim, 37> paper_claims{{
    {"real-time", "efficiently implemented, a map leaves simulation and interaction in real time: frames at 60 Hz",
     "abstract", ">= 1856 tetrahedra", About::times},
    {"graphs-ambiguous", "two bodies that are topologically different can have the same adjacency graph", "1",
     "possible"},
    {"non-manifold-refused", "the non-manifold objects of Fig. 2 cannot be represented", "1", "impossible"},
    {"quasi-manifold", "an object that is no manifold, Fig. 3, is a quasi-manifold that can be computed", "1", "valid"},
    {"class-closed", "operations cannot leave the class of objects in which a face joins at most two volumes", "1, 2",
     "never"},
    {"combinatorial-export", "a generalized map can be exported to a combinatorial map of half the size", "2",
     "known method"},
    {"map-valid", "the body's map satisfies the three conditions of a 3-g-map", "2.1", "valid"},
    {"dart-table", "the map of Fig. 5 has the links of its table and the cells that the text names", "2.1",
     "30 links, 3 cells"},
    {"free-boundary", "closed objects have no fixed points; those of alpha_n are the boundary of an open one", "2.1",
     "6 per face"},
    {"cells-partition", "the i-cells partition the darts, for each i", "2.1", "each dart in 1 cell per i"},
    {"held-either-way", "an embedding may be held by one dart of its orbit or by all: the results are the same", "2.2",
     "the same"},
    {"orbits-separate", "a vertex or an edge comes apart exactly when two unsewn darts no longer share its orbit",
     "3.2", "exactly then"},
    {"removal-shares", "isolating a volume before it is deleted guarantees that mass and stiffness are shared", "3.2",
     "shared"},
    {"removal-frees", "the faces around a removed volume become 3-free", "3.2", "all, no other"},
    {"other-cells", "the model can easily be extended to other volume elements", "4.1", "any shape"},
    {"mass-sum", "the masses of the vertices, eq. (1), sum up to the masses of the tetrahedra", "4.3", "equal"},
    {"stiffness-sum", "the stiffness of the edges is what their tetrahedra contribute, 6 k each", "4.3", "equal"},
    {"mass-split", "a vertex that comes apart shares its mass: m = m1 + m2 (Fig. 8)", "4.3", "m1 + m2"},
    {"stiffness-split", "an edge that comes apart shares its stiffness: k = k1 + k2 (Fig. 8)", "4.3", "k1 + k2"},
    {"viscosity-split", "ambient viscosity is proportional to the mass, after a dissociation too", "4.3",
     "proportional"},
    {"rest-shape", "masses are computed on the rest shape and not after deformation", "4.3", "rest shape"},
    {"state-duplicated", "the parts of a vertex have its position and velocity, and embeddings of their own", "4.3",
     "duplicated"},
    {"body-size", "the body has 564 nodes, 2850 springs and 1856 tetrahedra", "5.1", "564 / 2850 / 1856"},
    {"dart-count", "its map has 44544 darts, 24 per tetrahedron", "5.1", "44544"},
    {"one-face-seldom", "the dissociation of one face seldom takes a vertex apart", "5.1", "seldom"},
    {"fan-separates", "dissociating all the faces of a fan takes its vertex apart (Fig. 10)", "5.1", "always"},
    {"fan-ends", "a fan ends where its first dart is reached or the surface is met", "5.1", "either"},
    {"collisions", "penalty methods between tetrahedra handle collisions", "5.1", "handled"},
    {"coverage-darts", "a coverage checks every dart, whatever cells it is after", "5.1", "proportional to darts"},
    {"coverage-slower", "full dart coverage costs more than the adjacency graph", "5.1", "6 (12 ms / 2 ms)",
     About::times},
    {"lists-faster", "lists of embeddings cost less than full dart coverage", "5.2", "0.67 (8 ms / 12 ms)",
     About::times},
    {"sews-translated", "sewing and unsewing cannot be translated into changes of an indexed structure", "5.2",
     "not possible", About::programs,
     "an operation reports which cells it split or removed, and arrays that follow these need no more"},
    {"arrays-overhead", "cell arrays cost at most 10 % more than the adjacency graph", "5.2", "<= 1.10", About::times},
    {"paper-ladder", "coverage : lists : arrays : graph cost 6 : 4 : 1 : 1", "5", "6 : 4 : 1 : 1", About::times,
     "contiguous arrays have gained more from processors since 2010 than walks through links, each of "
     "which waits for the one before"},
    {"rebuild-negligible", "rebuilding the arrays is negligible compared with the topological changes", "5.2",
     "negligible", About::times, "rebuilding covers every dart, while a removal has come down to microseconds"},
    {"connectivity-marks", "connectivity is lost when a walk along all alphas leaves darts without a mark",
     "conclusion", "exactly then"},
    {"parts-collide", "collisions can be computed between the components of a body that was split", "conclusion",
     "handled"},
}};

/// A row of the table, named by its id: another name does not compile.
class PaperClaimId {
 public:
  consteval PaperClaimId(const char* id) : row_(row_of(id)) {}
  constexpr PaperClaimId(const PaperClaim& row) : row_(&row) {}

  constexpr const PaperClaim& row() const { return *row_; }

 private:
  static consteval const PaperClaim* row_of(std::string_view id) {
    for (const PaperClaim& row : paper_claims)
      if (row.id == id) return &row;
    throw std::logic_error("no claim has this id");
  }
  const PaperClaim* row_;
};

/// A claim to be filled in, not tested yet.
Claim claim_of(PaperClaimId id);

/// Says whether the claim states that something is impossible, so that doing it contradicts the claim.
bool is_impossibility(PaperClaimId id);

/// A claim that was tested. A statement of the paper on bodies falls short where it is not met, one on times or
/// programs does not carry over, with the known reason if there is one; an open one is undecided.
Claim answered(PaperClaimId id, Met met, std::string measured, std::string bound_or_interval);

}  // namespace dartboard
