#include "core/scene/forces/attached_points.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "core/places/border.h"
#include "core/places/nearest_on_triangle.h"
#include "core/plain/error.h"
#include "core/scene/file/load_mesh.h"

namespace dartboard {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

// A tetrahedron or triangle whose measure is smaller than that of a cube (square) of its edges by this factor is flat.
constexpr double flat = 1e-12;
// [longest edges] out of the plane of a triangle; rounding to the digits of a file moves points by less.
constexpr double out_of_plane = 1e-6;

/// A tetrahedron or a triangle in a cell.
struct Simplex {
  std::uint32_t cell = 0, count = 0;
  std::array<std::uint32_t, 4> corners{};
  AlignedBox3d box;
};

/// The simplices of some of the cells of a mesh, and the search for the one that is nearest to a place.
class TargetCells {
 public:
  TargetCells(const Mesh& mesh, std::size_t first, std::size_t last) : mesh_(mesh) {
    std::vector<Vector3d> corners;
    for (std::size_t c = first; c < last; ++c) {
      add_cell(static_cast<std::uint32_t>(c));
      for (const std::uint32_t p : mesh.cell(c)) corners.push_back(mesh.points[p]);
    }
    thickness_ = border_thickness(corners);
    for (std::size_t k = 0; k < simplices_.size(); ++k) {
      if (k % of_block == 0) blocks_.emplace_back();
      blocks_.back().extend(simplices_[k].box);
    }
  }

  struct Found {
    const Simplex* simplex = nullptr;
    double distance = std::numeric_limits<double>::infinity();  // [m]
  };
  /// The first of the nearest, so that a body that is turned is attached alike: distances that differ by no more than
  /// the thickness of borders are equal, and those within it are 0.
  Found nearest(const Vector3d& x) const {
    Found found;
    // no nearest one is farther away than that of the block whose box is nearest
    double bound = std::numeric_limits<double>::infinity();
    const auto is_farther = [&](const AlignedBox3d& box) {
      return box.squaredExteriorDistance(x) > (1.0 + 1e-9) * std::min(bound * bound, found.distance * found.distance);
    };
    const auto look_at = [&](std::size_t block) {
      const std::size_t end = std::min(simplices_.size(), (block + 1) * of_block);
      for (std::size_t k = block * of_block; k < end; ++k) {
        if (is_farther(simplices_[k].box)) continue;
        double distance = distance_to(simplices_[k], x);
        if (distance <= thickness_) distance = 0.0;
        if (distance < found.distance - thickness_ || (distance == 0.0 && found.distance > 0.0))
          found = {&simplices_[k], distance};
      }
    };
    const auto to_box = [&x](const AlignedBox3d& box) { return box.squaredExteriorDistance(x); };
    if (blocks_.empty()) return found;
    look_at(static_cast<std::size_t>(std::ranges::min_element(blocks_, {}, to_box) - blocks_.begin()));
    bound = std::max(found.distance, thickness_);
    found = {};
    for (std::size_t block = 0; block < blocks_.size() && found.distance > 0.0; ++block)
      if (!is_farther(blocks_[block])) look_at(block);
    return found;
  }

  /// The weights of the corners by which x is a mean of them; of a triangle those of its foot.
  std::array<double, 4> weights(const Simplex& simplex, const Vector3d& x) const {
    const Vector3d origin = point(simplex, 0), b = point(simplex, 1) - origin, c = point(simplex, 2) - origin,
                   to = x - origin;
    std::array<double, 4> weight{};
    if (simplex.count == 4) {
      const Vector3d d = point(simplex, 3) - origin;
      const double whole = b.cross(c).dot(d);
      weight = {0.0, to.cross(c).dot(d) / whole, b.cross(to).dot(d) / whole, b.cross(c).dot(to) / whole};
    } else {
      const Vector3d normal = b.cross(c);
      const double whole = normal.squaredNorm();
      weight = {0.0, normal.dot(to.cross(c)) / whole, normal.dot(b.cross(to)) / whole, 0.0};
    }
    weight[0] = 1.0 - (weight[1] + weight[2] + weight[3]);
    return weight;
  }
  /// [m] From the plane of a triangle.
  double height(const Simplex& simplex, const Vector3d& x) const {
    const Vector3d origin = point(simplex, 0);
    const Vector3d normal = (point(simplex, 1) - origin).cross(point(simplex, 2) - origin);
    return std::abs(normal.normalized().dot(x - origin));
  }
  /// [m]
  double longest_edge(std::uint32_t cell) const {
    double longest = 0.0;
    const auto nodes = mesh_.cell(cell);
    for (const std::vector<int>& cycle : faces_of(mesh_.kinds[cell]))
      for (std::size_t k = 0; k < cycle.size(); ++k) {
        const auto at = [&](std::size_t j) -> const Vector3d& {
          return mesh_.points[nodes[static_cast<std::size_t>(cycle[j % cycle.size()])]];
        };
        longest = std::max(longest, (at(k + 1) - at(k)).norm());
      }
    return longest;
  }

 private:
  static constexpr std::size_t of_block = 64;

  const Vector3d& point(const Simplex& simplex, std::size_t k) const { return mesh_.points[simplex.corners[k]]; }

  // From the corner of the lowest number, as SkinSolidsView does.
  void add_cell(std::uint32_t cell) {
    const auto nodes = mesh_.cell(cell);
    const std::uint32_t top = *std::ranges::min_element(nodes);
    for (const std::vector<int>& cycle : faces_of(mesh_.kinds[cell])) {
      std::vector<std::uint32_t> face;
      for (const int k : cycle) face.push_back(nodes[static_cast<std::size_t>(k)]);
      std::rotate(face.begin(), std::ranges::min_element(face), face.end());
      const bool solid = dimension(mesh_.kinds[cell]) == 3;
      if (solid && std::ranges::find(face, top) != face.end()) continue;
      for (std::size_t k = 1; k + 1 < face.size(); ++k)
        solid ? add({cell, 4, {top, face[0], face[k], face[k + 1]}, {}})
              : add({cell, 3, {face[0], face[k], face[k + 1]}, {}});
    }
  }
  void add(Simplex simplex) {
    double longest = 0.0;
    for (std::size_t a = 0; a < simplex.count; ++a) {
      simplex.box.extend(point(simplex, a));
      for (std::size_t b = 0; b < a; ++b) longest = std::max(longest, (point(simplex, a) - point(simplex, b)).norm());
    }
    const Vector3d origin = point(simplex, 0);
    const Vector3d across = (point(simplex, 1) - origin).cross(point(simplex, 2) - origin);
    const double measure = simplex.count == 4 ? std::abs(across.dot(point(simplex, 3) - origin)) : across.norm();
    if (measure > flat * longest * longest * (simplex.count == 4 ? longest : 1.0)) simplices_.push_back(simplex);
  }

  double distance_to(const Simplex& simplex, const Vector3d& x) const {
    const auto to_triangle = [&](std::size_t a, std::size_t b, std::size_t c) {
      return nearest_on_triangle(point(simplex, a) - x, point(simplex, b) - x, point(simplex, c) - x).way.norm();
    };
    if (simplex.count == 3) return to_triangle(0, 1, 2);
    if (std::ranges::all_of(weights(simplex, x), [](double w) { return w >= 0.0; })) return 0.0;
    return std::min({to_triangle(1, 2, 3), to_triangle(0, 2, 3), to_triangle(0, 1, 3), to_triangle(0, 1, 2)});
  }

  const Mesh& mesh_;
  double thickness_ = 0.0;  // of the borders of these cells alone
  std::vector<Simplex> simplices_;
  std::vector<AlignedBox3d> blocks_;  // of 64 simplices, which are often next to each other
};

/// Attaches the points to the cells first to last - 1, except the corners of these.
void attach(const SceneFile& scene, const SceneAttachment& to, const Mesh& mesh, std::size_t first, std::size_t last,
            std::vector<Attachment>& points) {
  if (first == last)
    scene.fail(to.path + "/to", fmt::format("is {}, a chain, which has no cells", *to.to),
               "a body with cells that the chain's vertices are attached to");
  std::vector<bool> is_of_target(mesh.points.size(), false);
  for (std::size_t c = first; c < last; ++c)
    for (const std::uint32_t p : mesh.cell(c)) is_of_target[p] = true;
  std::erase_if(points, [&](const Attachment& one) { return is_of_target[one.point]; });
  if (points.empty())
    scene.fail(to.path + "/to", fmt::format("is {}, and all selected vertices belong to that body", *to.to),
               "vertices of another body");
  const TargetCells cells(mesh, first, last);
  for (Attachment& one : points) {
    const Vector3d& x = mesh.points[one.point];
    const auto [simplex, distance] = cells.nearest(x);
    const std::size_t number = number_in_file(scene, one.point);
    if (simplex == nullptr)
      scene.fail(to.path + "/to", fmt::format("is {}, whose cells are flat or not finite", *to.to),
                 "cells with an inside");
    const double longest = cells.longest_edge(simplex->cell);
    if (!(distance <= longest))
      scene.fail(to.path,
                 fmt::format("vertex {} is {:.3g} m away from body {}, whose nearest cell has edges of up to {:.3g} m",
                             number, distance, *to.to, longest),
                 "no vertex farther away than that");
    if (simplex->count == 3)
      if (const double height = cells.height(*simplex, x); !(height <= out_of_plane * longest))
        scene.fail(
            to.path,
            fmt::format("vertex {} is {:.3g} m above the plane of the nearest face of body {}", number, height, *to.to),
            "vertices in that plane, so that there is no force at rest");
    one.cell = simplex->cell;
    one.count = simplex->count;
    one.corners = simplex->corners;
    one.weight = cells.weights(*simplex, x);
  }
}

}  // namespace

std::vector<AttachedPoints> find_attachments(const SceneFile& scene, const Problem& problem) {
  const Mesh& mesh = problem.mesh;
  std::vector<AttachedPoints> all;
  for (const SceneAttachment& one : scene.attachments) {
    AttachedPoints held{.stiffness = one.stiffness};
    const std::vector<std::uint32_t> selected = [&] {
      try {
        auto points = select_points(one.vertices, mesh.points, one.path);
        require_some(points, one.path, mesh.points);
        return points;
      } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", scene.file, error.what()));
      }
    }();
    for (const std::uint32_t p : selected) held.points.push_back({.point = p, .place = mesh.points[p]});
    if (one.to) attach(scene, one, mesh, problem.bodies.cell[*one.to], problem.bodies.cell[*one.to + 1], held.points);
    all.push_back(std::move(held));
  }
  return all;
}

std::vector<Attachment> shared_by_mass(const std::vector<AttachedPoints>& attached, const VertexColumns& vertices) {
  std::vector<double> mass;
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    mass.resize(std::max<std::size_t>(mass.size(), vertices.point[k] + std::size_t{1}), 0.0);
    mass[vertices.point[k]] = vertices.mass[k];
  }
  std::vector<Attachment> all;
  for (const AttachedPoints& group : attached) {
    double sum = 0.0;
    for (const Attachment& one : group.points) sum += mass.at(one.point);
    for (Attachment one : group.points) {
      one.per_mass = group.stiffness / sum;
      all.push_back(one);
    }
  }
  return all;
}

}  // namespace dartboard
