#pragma once
// The matrix of every implicit step, A = M + tau C + tau^2 K, applied spring by spring: entries are formed for force
// terms only.

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/time/system/node_matrix.h"
#include "core/time/system/tangent.h"
#include "core/time/system/term_tangents.h"

namespace dartboard {

/// A symmetric change of a matrix by weight w w', where w has `direction` at node `first` and its opposite at node
/// `second` (nothing there if it is NodePattern::none).
struct RankOneTerm {
  std::uint32_t first, second;
  Eigen::Vector3d direction;
  double weight;
};

/// A = M + tau C + tau^2 K, with identity rows and columns for fixed vertices, whose couplings are eliminated; along
/// held axes, with the inertia on the diagonal.
///
/// C holds the damping of the springs and of the force terms, and the ambient viscosity.
class StepMatrix {
 public:
  StepMatrix() { terms_.pattern.column_start = dampers_.pattern.column_start = {}; }  // takes no memory until needed

  /// Evaluate the matrix of the springs and, given the pattern of the system and `terms`, of its force terms.
  ///
  /// cost    O(vertices + springs); no memory is taken after the first call for a body
  void evaluate(const SpringSystem& system, std::span<const SpringTangent> tangents, double tau);
  void evaluate(const SpringSystem& system, std::span<const SpringTangent> tangents, double tau,
                const NodePattern& pattern, const TermTangents& terms);

  std::size_t node_count() const { return inertia_.size(); }
  std::size_t bytes() const {
    return bytes_of(inertia_, fixed_, held_axes_, blocks_, sources_, diagonal_, links_, anchors_) + terms_.bytes() +
           dampers_.bytes();
  }
  /// Without the damping of force terms: a matrix that has them is never followed, but made anew.
  template <class Archive>
  void state(Archive& archive) {
    archive(tau_, inertia_, fixed_, held_axes_, blocks_, sources_, diagonal_, links_, anchors_, terms_);
  }
  double tau() const { return tau_; }
  const Eigen::Matrix3d& diagonal_block(std::size_t i) const { return diagonal_[i]; }
  /// m + tau * viscosity by vertex; 1 for fixed ones.
  std::span<const double> inertia() const { return inertia_; }

  /// y = A x, from the springs: five numbers and two ends for each, where entries would need nine numbers.
  /// pre  x is zero along held axes
  void multiply(std::span<const Eigen::Vector3d> x, std::span<Eigen::Vector3d> y) const;

  /// y += K x with the stiffness of the force terms alone, fixed vertices being still.
  void add_stiffness_of_terms(std::span<const Eigen::Vector3d> x, std::span<Eigen::Vector3d> y) const;

  /// The entries, on a pattern of the same system.
  /// cost    O(vertices + springs)
  void assemble(const NodePattern& pattern, BlockMatrix& matrix) const;

  /// Follow a topological change while keeping the evaluated blocks of unchanged springs. Returned are the terms that
  /// lead from the old matrix to the new one.
  /// pre  there are no force terms, and no vertex is held along axes
  ///
  /// Springs and vertices are matched by number; those that changed are evaluated at `tangents`. A vertex whose number
  /// is beyond the old ones starts from `spare` times the identity.
  std::vector<RankOneTerm> follow(const SpringSystem& system, std::span<const SpringTangent> tangents, double spare);

 private:
  // One spring: p I + q d d' between vertices a and b.
  struct Block {
    SpringEnds ends;
    Eigen::Vector3d d;
    double p, q;
    template <class Archive>
    void state(Archive& archive) {
      archive(ends, d, p, q);
    }
  };
  struct Source {  // the spring that a block was evaluated for
    double stiffness, damping;
    friend bool operator==(const Source&, const Source&) = default;
    template <class Archive>
    void state(Archive& archive) {
      archive(stiffness, damping);
    }
  };
  Block block_of(const SpringSystem& system, std::size_t e, const SpringTangent& tangent) const;
  void set_inertia(const SpringSystem& system);
  void sum_diagonal();
  void hold_axes();
  Eigen::Vector3d free_at(std::size_t i, const Eigen::Vector3d& v) const {
    return held_axes_.empty() ? v : free_part(held_axes_[i], v);
  }
  Eigen::Matrix3d free_block(std::size_t i, std::size_t j, Eigen::Matrix3d block) const;
  void sum_terms(const SpringSystem& system, const NodePattern& pattern, const TermTangents& tangents);

  double tau_ = 0.0;
  std::vector<double> inertia_;
  std::vector<std::uint8_t> fixed_;
  std::vector<HeldAxes> held_axes_;  // by vertex; empty without held axes
  std::vector<Block> blocks_;        // by spring
  std::vector<Source> sources_;      // by spring
  std::vector<Eigen::Matrix3d> diagonal_;
  std::vector<std::uint32_t> links_;    // springs between two free vertices
  std::vector<std::uint32_t> anchors_;  // springs between a free and a fixed vertex
  BlockMatrix terms_;                   // tau^2 K of the force terms; empty without force terms
  BlockMatrix dampers_;                 // tau C of the damped force terms; empty without such terms
};

}  // namespace dartboard
