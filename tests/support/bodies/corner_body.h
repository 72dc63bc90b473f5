#pragma once
// A body of triangles or tetrahedra without a map or a shared line with core's motion: every cell has corners of its
// own, glued by the faces between cells. An independent way to the expected end of a scene.

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "core/plain/problem.h"

namespace dartboard {

/// The mechanics are those of problem.h, summed over classes of corners and of sides of cells: glued to each other
/// across the faces that are still closed. Events close no face again and bring no cell back.
class CornerBody {
 public:
  using Vector = Eigen::Vector3d;
  /// The place and velocity of a driven point of the mesh at a time; nothing for a point that is not driven.
  using Drive = std::function<bool(std::uint32_t point, double time, Vector& x, Vector& v)>;

  explicit CornerBody(const Problem& problem, Drive drive = {}) : problem_(problem), drive_(std::move(drive)) {
    const Mesh& mesh = problem_.mesh;
    corners_ = mesh.dimension() + 1;
    alive_.assign(mesh.cell_count(), true);
    std::map<std::vector<std::uint32_t>, std::size_t> first;
    for (std::size_t c = 0; c < mesh.cell_count(); ++c)
      for (int left_out = 0; left_out < corners_; ++left_out) {
        std::vector<std::uint32_t> points;
        for (int k = 0; k < corners_; ++k)
          if (k != left_out) points.push_back(mesh.cell(c)[static_cast<std::size_t>(k)]);
        std::ranges::sort(points);
        const auto [entry, is_new] = first.try_emplace(points, c);
        if (!is_new) faces_.push_back({entry->second, c, points, true});
      }
    node_.assign(mesh.nodes.begin(), mesh.nodes.end());
    x = mesh.points;
    v = problem_.initial_velocity;
    if (v.empty()) v.assign(x.size(), Vector::Zero());
    glue();
  }

  std::vector<Vector> x, v;  // by class of corners

  std::size_t cells() const { return static_cast<std::size_t>(std::ranges::count(alive_, true)); }
  double mass() const { return std::accumulate(mass_.begin(), mass_.end(), 0.0); }

  // ---- events

  void remove(const std::function<bool(const Vector& centroid)>& which) {
    for (std::size_t c = 0; c < alive_.size(); ++c) alive_[c] = alive_[c] && !which(centroid(c));
    glue();
  }
  /// All faces between cells whose centroids are on different sides.
  void cut(const std::function<bool(const Vector& centroid)>& side) {
    for (Face& f : faces_) f.closed = f.closed && side(centroid(f.a)) == side(centroid(f.b));
    glue();
  }
  void open(std::vector<std::uint32_t> points) {
    std::ranges::sort(points);
    for (Face& f : faces_) f.closed = f.closed && f.points != points;
    glue();
  }

  // ---- motion

  /// The classical Runge-Kutta method.
  void step(double time, double h) {
    const auto k1 = slope(time, x, v);
    const auto k2 = slope(time + h / 2, moved(x, k1.first, h / 2), moved(v, k1.second, h / 2));
    const auto k3 = slope(time + h / 2, moved(x, k2.first, h / 2), moved(v, k2.second, h / 2));
    // just before the end: a driven vertex may turn round there
    const auto k4 = slope(time + h * (1 - 1e-9), moved(x, k3.first, h), moved(v, k3.second, h));
    for (std::size_t n = 0; n < x.size(); ++n) {
      x[n] += h / 6 * (k1.first[n] + 2 * k2.first[n] + 2 * k3.first[n] + k4.first[n]);
      v[n] += h / 6 * (k1.second[n] + 2 * k2.second[n] + 2 * k3.second[n] + k4.second[n]);
    }
  }
  void run(double from, double to, double longest) {
    const int steps = std::max(1, static_cast<int>(std::ceil((to - from) / longest - 1e-9)));
    for (int k = 0; k < steps; ++k) step(from + (to - from) * k / steps, (to - from) / steps);
  }

  // ---- its properties

  /// The class of some corner at a point of the mesh.
  std::size_t class_at(std::uint32_t point) const {
    for (std::size_t k = 0; k < node_.size(); ++k)
      if (alive_[k / static_cast<std::size_t>(corners_)] && problem_.mesh.nodes[k] == point) return node_[k];
    return x.size();
  }
  /// Centre of mass, its velocity, and mass of all cells connected with that of a point.
  struct Part {
    Vector centre, velocity;
    double mass;
  };
  Part part_of(std::uint32_t point) const {
    std::vector<std::size_t> group(alive_.size());
    std::iota(group.begin(), group.end(), std::size_t{0});
    for (const Face& f : faces_)
      if (is_glue(f)) join(group, f.a, f.b);
    std::size_t seed = 0;
    while (!alive_[seed] || std::ranges::count(problem_.mesh.cell(seed), point) == 0) ++seed;
    Part part{Vector::Zero(), Vector::Zero(), 0.0};
    for (std::size_t c = 0; c < alive_.size(); ++c) {
      if (!alive_[c] || root(group, c) != root(group, seed)) continue;
      const double share = cell_mass(c) / corners_;
      for (int k = 0; k < corners_; ++k) {
        part.centre += share * x[corner(c, k)];
        part.velocity += share * v[corner(c, k)];
      }
      part.mass += cell_mass(c);
    }
    part.centre /= part.mass;
    part.velocity /= part.mass;
    return part;
  }
  Vector centroid(std::size_t c) const {
    Vector sum = Vector::Zero();
    for (int k = 0; k < corners_; ++k) sum += x[corner(c, k)];
    return sum / corners_;
  }
  /// The force in a direction of the springs that cross a seam on the part on one side of it.
  double pull_across(const std::function<bool(const Vector&)>& side_at_rest, const Vector& along) const {
    double sum = 0.0;
    for (const Spring& s : springs_) {
      const bool a = side_at_rest(problem_.mesh.points[s.point_a]), b = side_at_rest(problem_.mesh.points[s.point_b]);
      if (a != b) sum += (a ? 1.0 : -1.0) * force(s, x, v).dot(along);
    }
    return sum;
  }

 private:
  struct Face {
    std::size_t a, b;
    std::vector<std::uint32_t> points;
    bool closed;
  };
  struct Spring {
    std::size_t a, b;
    std::uint32_t point_a, point_b;
    double stiffness, damping, length;
  };

  static std::size_t root(std::vector<std::size_t>& above, std::size_t k) {
    while (above[k] != k) k = above[k] = above[above[k]];
    return k;
  }
  static void join(std::vector<std::size_t>& above, std::size_t a, std::size_t b) {
    above[root(above, a)] = root(above, b);
  }
  std::size_t corner(std::size_t c, int k) const {
    return node_[c * static_cast<std::size_t>(corners_) + static_cast<std::size_t>(k)];
  }
  bool is_glue(const Face& f) const { return f.closed && alive_[f.a] && alive_[f.b]; }
  double cell_mass(std::size_t c) const { return material_of(c).density * std::abs(signed_measure(problem_.mesh, c)); }
  const Material& material_of(std::size_t c) const {
    return problem_.materials.empty() ? problem_.material : problem_.materials[problem_.cell_material[c]];
  }
  int place_in(std::size_t c, std::uint32_t point) const {
    const auto cell = problem_.mesh.cell(c);
    return static_cast<int>(std::ranges::find(cell, point) - cell.begin());
  }

  /// Builds the classes of corners and of edges anew; each class has the state of the class that it was part of.
  void glue() {
    const Mesh& mesh = problem_.mesh;
    const auto n = static_cast<std::size_t>(corners_);
    const auto number = [n](std::size_t c, int k) { return c * n + static_cast<std::size_t>(k); };
    const auto pair_number = [n](std::size_t c, int j, int k) {
      return (c * n + static_cast<std::size_t>(std::min(j, k))) * n + static_cast<std::size_t>(std::max(j, k));
    };
    std::vector<std::size_t> corners(mesh.nodes.size()), pairs(mesh.nodes.size() * n);
    std::iota(corners.begin(), corners.end(), std::size_t{0});
    std::iota(pairs.begin(), pairs.end(), std::size_t{0});
    for (const Face& f : faces_) {
      if (!is_glue(f)) continue;
      for (std::size_t p = 0; p < f.points.size(); ++p) {
        const int a = place_in(f.a, f.points[p]), b = place_in(f.b, f.points[p]);
        join(corners, number(f.a, a), number(f.b, b));
        for (std::size_t q = 0; q < p; ++q)
          join(pairs, pair_number(f.a, a, place_in(f.a, f.points[q])), pair_number(f.b, b, place_in(f.b, f.points[q])));
      }
    }
    std::map<std::size_t, std::size_t> classes;
    std::vector<Vector> new_x, new_v;
    mass_.clear();
    point_.clear();
    const std::vector<std::size_t> old = node_;
    for (std::size_t c = 0; c < alive_.size(); ++c)
      for (int k = 0; k < corners_ && alive_[c]; ++k) {
        const auto [entry, is_new] = classes.try_emplace(root(corners, number(c, k)), new_x.size());
        if (is_new) {
          new_x.push_back(x[old[number(c, k)]]);
          new_v.push_back(v[old[number(c, k)]]);
          mass_.push_back(0.0);
          point_.push_back(mesh.nodes[number(c, k)]);
        }
        node_[number(c, k)] = entry->second;
        mass_[entry->second] += cell_mass(c) / corners_;
      }
    x = std::move(new_x);
    v = std::move(new_v);
    fixed_.clear();
    for (const std::uint32_t p : point_) fixed_.push_back(std::ranges::binary_search(problem_.fixed, p));
    std::map<std::size_t, std::size_t> edges;
    springs_.clear();
    for (std::size_t c = 0; c < alive_.size(); ++c)
      for (int j = 0; j < corners_ && alive_[c]; ++j)
        for (int k = j + 1; k < corners_; ++k) {
          const auto [entry, is_new] = edges.try_emplace(root(pairs, pair_number(c, j, k)), springs_.size());
          const std::uint32_t a = mesh.nodes[number(c, j)], b = mesh.nodes[number(c, k)];
          if (is_new)
            springs_.push_back({corner(c, j), corner(c, k), a, b, 0.0, 0.0, (mesh.points[b] - mesh.points[a]).norm()});
          const Material& of = material_of(c);
          const double stiffness = of.young > 0.0 ? of.young * std::abs(signed_measure(mesh, c)) /
                                                        (mesh.points[b] - mesh.points[a]).squaredNorm()
                                                  : of.stiffness;
          springs_[entry->second].stiffness += stiffness;
          springs_[entry->second].damping += of.young > 0.0 ? of.damping * stiffness / of.stiffness : of.damping;
        }
  }

  Vector force(const Spring& s, const std::vector<Vector>& at, const std::vector<Vector>& speed) const {
    const Vector d = at[s.b] - at[s.a];
    const double length = d.norm();
    const Vector u = d / length;
    return (s.stiffness * (length - s.length) + s.damping * (speed[s.b] - speed[s.a]).dot(u)) * u;
  }
  static std::vector<Vector> moved(const std::vector<Vector>& from, const std::vector<Vector>& by, double h) {
    std::vector<Vector> to(from);
    for (std::size_t n = 0; n < to.size(); ++n) to[n] += h * by[n];
    return to;
  }
  std::pair<std::vector<Vector>, std::vector<Vector>> slope(double time, std::vector<Vector> at,
                                                            std::vector<Vector> speed) {
    std::vector<bool> driven(at.size(), false);
    for (std::size_t n = 0; drive_ && n < at.size(); ++n) driven[n] = drive_(point_[n], time, at[n], speed[n]);
    std::vector<Vector> f(at.size(), Vector::Zero());
    for (const Spring& s : springs_) {
      const Vector pull = force(s, at, speed);
      f[s.a] += pull;
      f[s.b] -= pull;
    }
    for (std::size_t n = 0; n < at.size(); ++n) {
      f[n] = f[n] / mass_[n] - problem_.material.viscosity * speed[n] + problem_.surroundings.gravity;
      if (fixed_[n] || driven[n]) f[n].setZero();
      if (fixed_[n] && !driven[n]) speed[n].setZero();
    }
    return {std::move(speed), std::move(f)};
  }

  Problem problem_;
  Drive drive_;
  int corners_ = 0;
  std::vector<char> alive_;
  std::vector<Face> faces_;
  std::vector<std::size_t> node_;     // class by corner
  std::vector<double> mass_;          // by class
  std::vector<std::uint32_t> point_;  // of the mesh, by class
  std::vector<char> fixed_;
  std::vector<Spring> springs_;
};

}  // namespace dartboard
