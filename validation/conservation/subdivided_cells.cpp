// The running bounds. u = 2^-53, M the largest absolute coordinate of the points in question.
//
// A mean of s <= 4 points: three additions and a division, on coordinates off by e at most: off by
// max e + gamma_4 M. A distance d between points off by e: each coordinate of the difference is off by 2 e and one
// rounding, so |d| is off by 2 sqrt(3) e + gamma_4 |d|, below 4 e + gamma_4 |d|. A volume is a sixth of a determinant
// of three such differences: with l the longest of them, it is off by at most l^2 / 2 (4 e) + gamma_10 l^3 / 6, and by
// a half more of the former for products of errors.
//
// Core derives the square of a length from squares of others: for w in the middle of S,
//
//     |w - j|^2 = sum_i |i - j|^2 / s  -  sum_{i<k} |i - k|^2 / s^2.
//
// With squares off by q_ij, the result is off by the same combination of the q, and gamma_20 of the same combination of
// absolute values (each edge is met several times, every sum has below 16 terms). The square root and squaring it again
// add gamma_4. A negative difference is taken for zero, which brings it closer. A half has a quarter of the square, and
// of its error.

#include "validation/conservation/subdivided_cells.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

#include "validation/conservation/conserved_sums.h"

namespace dartboard {
namespace {

bool has(std::uint8_t nodes, std::uint32_t node) { return (nodes >> node & 1u) != 0; }

}  // namespace

std::uint32_t SubdividedCells::edge_between(std::uint32_t a, std::uint32_t b) {
  std::uint32_t e = 0;
  while (ends[e][0] != std::min(a, b) || ends[e][1] != std::max(a, b)) ++e;
  return e;
}

SubdividedCells::SubdividedCells(const Mesh& mesh, double density) : count_(mesh.cell_count()) {
  for (const auto& p : mesh.points) points_.push_back({p, 0.0});
  std::map<std::array<std::uint32_t, 3>, Corner> side_with;
  for (std::uint32_t c = 0; c < mesh.cell_count(); ++c) {
    Tetrahedron t{};
    std::copy_n(mesh.cell(c).begin(), 4, t.points.begin());
    t.mass = density * std::abs(signed_measure(mesh, c));
    t.share.fill(1.0);
    t.is_there = true;
    cells_.push_back(t);
    Tetrahedron& cell = cells_.back();
    for (std::uint32_t e = 0; e < 6; ++e) {
      // norm() takes the root of a sum of three squares of rounded differences; squared again
      const double d = (mesh.points[t.points[ends[e][1]]] - mesh.points[t.points[ends[e][0]]]).norm();
      cell.square_error[e] = gamma(12) * d * d;
    }
    for (std::uint32_t n = 0; n < 4; ++n) {
      const Corner side{c, n};
      cell.across[n] = side;
      std::array<std::uint32_t, 3> key{};
      std::copy_if(t.points.begin(), t.points.end(), key.begin(), [&](std::uint32_t p) { return p != t.points[n]; });
      const Eigen::Vector3d a = mesh.points[key[0]], b = mesh.points[key[1]], d = mesh.points[key[2]];
      cell.side_area[n] = (b - a).cross(d - a).norm() / 2.0;
      std::sort(key.begin(), key.end());
      const auto [found, is_new] = side_with.try_emplace(key, side);
      if (is_new) continue;
      join(side, found->second);
      cell.side_area[n] = cells_[found->second.cell].side_area[found->second.node];
    }
  }
}

void SubdividedCells::join(Corner a, Corner b) {
  cells_[a.cell].across[a.node] = b;
  cells_[b.cell].across[b.node] = a;
}

void SubdividedCells::dissociate(Corner side) {
  const Corner other = cells_[side.cell].across[side.node];
  cells_[side.cell].across[side.node] = side;
  cells_[other.cell].across[other.node] = other;
}

void SubdividedCells::remove(std::uint32_t cell) {
  for (std::uint32_t n = 0; n < 4; ++n) dissociate({cell, n});
  cells_[cell].is_there = false;
  --count_;
}

std::uint32_t SubdividedCells::node_at(std::uint32_t cell, std::uint32_t point) const {
  const auto& points = cells_[cell].points;
  return static_cast<std::uint32_t>(std::find(points.begin(), points.end(), point) - points.begin());
}

std::vector<std::pair<std::uint32_t, std::uint8_t>> SubdividedCells::around(std::uint32_t cell,
                                                                            std::uint8_t nodes) const {
  std::vector<std::pair<std::uint32_t, std::uint8_t>> found{{cell, nodes}};
  for (std::size_t at = 0; at < found.size(); ++at) {
    const auto [c, here] = found[at];
    for (std::uint32_t n = 0; n < 4; ++n) {
      if (has(here, n) || !is_joined({c, n})) continue;  // the side opposite n has all nodes but n
      const std::uint32_t next = cells_[c].across[n].cell;
      std::uint8_t there = 0;
      for (std::uint32_t m = 0; m < 4; ++m)
        if (has(here, m)) there = static_cast<std::uint8_t>(there | 1u << node_at(next, cells_[c].points[m]));
      const std::pair<std::uint32_t, std::uint8_t> member{next, there};
      if (std::find(found.begin(), found.end(), member) == found.end()) found.push_back(member);
    }
  }
  return found;
}

std::vector<SubdividedCells::Child> SubdividedCells::subdivide(std::uint32_t cell, std::uint8_t nodes, double bracing) {
  const auto parents = around(cell, nodes);
  const auto vertex = static_cast<std::uint32_t>(points_.size());
  Point middle{Eigen::Vector3d(0, 0, 0), 0.0};
  double largest = 0.0;
  for (std::uint32_t n = 0; n < 4; ++n)
    if (has(nodes, n)) {
      const Point& p = points_[cells_[cell].points[n]];
      middle.rest += p.rest;
      middle.error = std::max(middle.error, p.error);
      largest = std::max(largest, p.rest.lpNorm<Eigen::Infinity>());
    }
  middle.rest /= std::popcount(nodes);
  middle.error += gamma(5) * largest;
  points_.push_back(middle);

  std::vector<Child> children;
  for (const auto& [parent, here] : parents) add_children(parent, here, vertex, bracing, children);

  // core derives the length of an edge in one of the cells around it; it does not matter in which
  std::map<std::uint32_t, double> error_to;  // by the point across
  for (const bool put : {false, true})
    for (const Child& child : children)
      for (std::uint32_t n = 0; n < 4; ++n) {
        if (n == child.replaced) continue;
        Tetrahedron& t = cells_[child.cell];
        double& error = t.square_error[edge_between(n, child.replaced)];
        double& largest_error = error_to[t.points[n]];
        largest_error = std::max(largest_error, error);
        if (put) error = largest_error;
      }

  const auto child_without = [&](std::uint32_t parent, std::uint32_t node) {
    return std::find_if(children.begin(), children.end(),
                        [=](const Child& c) { return c.parent == parent && c.replaced == node; })
        ->cell;
  };
  for (const auto& [parent, here] : parents)
    for (std::uint32_t n = 0; n < 4; ++n) {
      if (!has(here, n)) continue;
      const std::uint32_t child = child_without(parent, n);
      for (std::uint32_t m = 0; m < 4; ++m) {
        const Corner across = cells_[parent].across[m];
        if (has(here, m) && m != n) {
          join({child, m}, {child_without(parent, m), n});
        } else if (across == Corner{parent, m}) {
          continue;
        } else if (m == n) {  // the side of the parent that lacks n; a parent across it lacks one of the nodes too
          const bool divided = std::any_of(parents.begin(), parents.end(),
                                           [&](const auto& other) { return other.first == across.cell; });
          join({child, m}, divided ? Corner{child_without(across.cell, across.node), across.node} : across);
        } else {  // a part of a side that has all of the nodes
          const std::uint32_t there = node_at(across.cell, cells_[parent].points[n]);
          join({child, m}, {child_without(across.cell, there), across.node});
        }
      }
    }
  for (const auto& [parent, here] : parents) {
    cells_[parent].is_there = false;
    --count_;
  }
  return children;
}

void SubdividedCells::add_children(std::uint32_t parent, std::uint8_t nodes, std::uint32_t vertex, double bracing,
                                   std::vector<Child>& children) {
  const Tetrahedron whole = cells_[parent];
  const auto s = static_cast<double>(std::popcount(nodes));
  const auto square = [&](std::uint32_t a, std::uint32_t b) {
    return (points_[whole.points[a]].rest - points_[whole.points[b]].rest).squaredNorm();
  };
  for (std::uint32_t n = 0; n < 4; ++n) {
    if (!has(nodes, n)) continue;
    Tetrahedron t = whole;
    t.points[n] = vertex;
    t.mass = whole.mass / s;
    ++t.depth;
    const auto cell = static_cast<std::uint32_t>(cells_.size());
    for (std::uint32_t m = 0; m < 4; ++m) {
      t.across[m] = {cell, m};
      // two children meet in an inner side, which is never on a boundary before it is dissociated
      if (m == n) continue;
      if (has(nodes, m)) {
        std::vector<Eigen::Vector3d> p;
        for (std::uint32_t k = 0; k < 4; ++k)
          if (k != m) p.push_back(points_[t.points[k]].rest);
        t.side_area[m] = (p[1] - p[0]).cross(p[2] - p[0]).norm() / 2.0;
      } else {
        t.side_area[m] = whole.side_area[m] / s;
      }
    }
    for (std::uint32_t e = 0; e < 6; ++e) {
      const auto [a, b] = ends[e];
      const auto others = [&](std::uint32_t x, std::uint32_t y) {
        return s - (has(nodes, x) ? 1 : 0) - (has(nodes, y) && y != x ? 1 : 0);
      };
      if (a != n && b != n) {
        t.share[e] = whole.share[e] / others(a, b);
        continue;
      }
      const std::uint32_t j = a == n ? b : a;
      if (s == 2 && has(nodes, j)) {
        t.share[e] = 2.0 * whole.share[e];
        t.square_error[e] = whole.square_error[e] / 4.0 + gamma(4) * square(a, b) / 4.0;
        continue;
      }
      t.share[e] = bracing / others(j, j);
      double error = 0.0, magnitude = 0.0;
      for (std::uint32_t i = 0; i < 4; ++i)
        for (std::uint32_t k = i + 1; k < 4; ++k) {
          const std::uint32_t ik = edge_between(i, k);
          const double to_j = (i == j && has(nodes, k)) || (k == j && has(nodes, i)) ? 1.0 / s : 0.0;
          const double between = has(nodes, i) && has(nodes, k) ? 1.0 / (s * s) : 0.0;
          error += (to_j + between) * whole.square_error[ik];
          magnitude += (to_j + between) * square(i, k);
        }
      t.square_error[e] = 1.001 * error + gamma(24) * magnitude;
    }
    cells_.push_back(t);
    ++count_;
    children.push_back({parent, n, cell});
  }
}

std::pair<double, double> SubdividedCells::rest_length(EdgeOfCell edge) const {
  const Tetrahedron& t = cells_[edge.cell];
  const Point &a = points_[t.points[ends[edge.edge][0]]], &b = points_[t.points[ends[edge.edge][1]]];
  const double d = (b.rest - a.rest).norm();
  const double here = 2.0 * (a.error + b.error) + gamma(6) * d;
  // |L^2 - d^2| <= q, so |L - d| <= q / d; and never more than sqrt(q)
  const double q = t.square_error[edge.edge];
  return {d, 1.001 * (here + std::min(std::sqrt(q), q / d))};
}

std::pair<double, double> SubdividedCells::volume(std::uint32_t cell) const {
  const auto& p = cells_[cell].points;
  const Eigen::Vector3d& o = points_[p[0]].rest;
  std::array<Eigen::Vector3d, 3> d;
  double error = points_[p[0]].error, longest = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    d[k] = points_[p[k + 1]].rest - o;
    error = std::max(error, points_[p[k + 1]].error);
    longest = std::max(longest, d[k].norm());
  }
  const double volume = std::abs(d[0].dot(d[1].cross(d[2]))) / 6.0;
  return {volume, 3.0 * longest * longest * error + gamma(12) * longest * longest * longest};
}

std::size_t SubdividedCells::count_sides() const { return (4 * count_ + count_boundary()) / 2; }

std::size_t SubdividedCells::count_boundary() const {
  std::size_t sides = 0;
  for (std::uint32_t c = 0; c < cells_.size(); ++c)
    for (std::uint32_t n = 0; cells_[c].is_there && n < 4; ++n) sides += is_joined({c, n}) ? 0 : 1;
  return sides;
}

}  // namespace dartboard
