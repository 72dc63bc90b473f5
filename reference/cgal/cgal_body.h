#pragma once
// The same body carried by established topology: a CGAL linear cell complex for generalized maps.

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "core/plain/problem.h"

namespace dartboard::reference {

/// The way in which CGAL visits vertices and edges.
enum class CgalWalk {
  coverage,    // one_dart_per_cell<i>(): all darts are visited, marks record which cells have been met
  attributes,  // attributes<i>(): the container of the embeddings, and attribute->dart() for the neighbours
};

/// The counts of CGAL in the map.
struct CgalCounts {
  std::size_t darts, vertices, edges, faces, volumes, components;
  bool operator==(const CgalCounts&) const = default;
};

/// A mass/spring body whose points are vertex attributes and whose springs are edge attributes of a 3-g-map, moved by
/// classical Runge-Kutta of order 4. The number of cells around an edge, hence its stiffness, is CGAL's answer too, and
/// so are the masses: volumes by the exact numbers of its kernel.
class CgalBody {
 public:
  /// throws  InputError as AdjacencyGraph does, for a material with a Young's modulus, and if the cells make no
  ///         quasi-manifold: more than two of them share a face (an edge, for polygons), or a point lies on two
  ///         vertices of the map
  explicit CgalBody(const Problem& problem, CgalWalk walk = CgalWalk::coverage);
  ~CgalBody();
  CgalBody(CgalBody&&) noexcept;
  CgalBody& operator=(CgalBody&&) noexcept;

  /// Advance by n time steps.
  void step(int n);

  PointState state() const;

  /// Continue from `state`; fixed points take its positions and stay still.
  ///
  /// throws  InputError if `state` has another number of points
  void set_state(const PointState& state);

  /// f_i - viscosity m_i v_i [N] at the current state, for every point, also the fixed.
  std::vector<Eigen::Vector3d> spring_and_drag_forces() const;

  CgalCounts counts() const;

  /// CGAL's own judgement of the map and its attributes.
  bool is_valid() const;

 private:
  struct Complex;
  std::unique_ptr<Complex> complex_;
};

/// The version of CGAL, such as "5.5.1".
std::string cgal_version();

}  // namespace dartboard::reference
