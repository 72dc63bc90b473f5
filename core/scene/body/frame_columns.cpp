#include "core/scene/body/frame_columns.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace dartboard {
namespace {

/// Put a column into another order: element k becomes the former element order[k].
template <class T>
void reorder(std::vector<T>& column, const std::vector<std::uint32_t>& order) {
  if (column.empty()) return;
  std::vector<T> ordered;
  ordered.reserve(column.size());
  for (const std::uint32_t k : order) ordered.push_back(column[k]);
  column = std::move(ordered);
}

double or_infinity(double x) { return std::isfinite(x) ? x : std::numeric_limits<double>::infinity(); }

}  // namespace

void put_in_order(Frame& frame, std::span<const std::uint32_t> number) {
  if (!number.empty())
    for (std::int64_t& p : frame.mesh_point)
      if (p >= 0) p = number[static_cast<std::size_t>(p)];
  if (!number.empty())
    for (RefinedFacet& facet : frame.refined_facets)
      for (std::int64_t& p : facet.lies_in) p = number[static_cast<std::size_t>(p)];
  if (frame.mesh_point.empty()) return;
  const auto last = static_cast<std::size_t>(*std::ranges::max_element(frame.mesh_point) + 1);
  const auto rank = [last](std::int64_t p) { return p < 0 ? last : static_cast<std::size_t>(p); };  // -1 comes last
  if (std::ranges::is_sorted(frame.mesh_point, {}, rank)) return;
  // sorted by counting: next[r] is the place of the next point of rank r
  std::vector<std::uint32_t> order(frame.mesh_point.size()), place(order.size()), next(last + 2, 0);
  for (const std::int64_t p : frame.mesh_point) ++next[rank(p) + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  for (std::uint32_t k = 0; k < order.size(); ++k) {
    place[k] = next[rank(frame.mesh_point[k])]++;
    order[place[k]] = k;
  }
  const auto reorder_all = [&order](auto&... columns) { (reorder(columns, order), ...); };
  reorder_all(frame.mesh.points, frame.velocity, frame.mass, frame.mesh_point, frame.held, frame.stress,
              frame.displacement, frame.contact_force, frame.contact_depth);
  for (std::uint32_t& node : frame.mesh.nodes) node = place[node];
  for (RefinedFacet& facet : frame.refined_facets)
    for (std::uint32_t& point : facet.points) point = place[point];
  for (FramePair& pair : frame.contact_pairs)
    for (std::span<std::int64_t> points : {std::span<std::int64_t>(pair.sample), std::span<std::int64_t>(pair.face)})
      for (std::int64_t& point : points)
        if (point != FramePair::none) point = place[static_cast<std::size_t>(point)];
  for (auto* lines : {&frame.links, &frame.springs})
    for (auto& [a, b] : *lines) {
      a = place[a];
      b = place[b];
    }
}

void fill_columns(Frame& frame, const FrameFields& fields, const VertexColumns& vertices, const SpringSystem& system,
                  const VertexVolumes& volumes) {
  const auto& ends = system.ends;
  const SpringSpan& springs = system.springs;
  const auto& x = vertices.position;
  frame.fields = fields;
  frame.mesh.points = x;
  frame.velocity = vertices.velocity;
  frame.mass = vertices.mass;
  for (const std::uint32_t p : vertices.point) frame.mesh_point.push_back(p == no_point ? -1 : std::int64_t{p});
  const bool is_chain = !frame.links.empty();
  if (fields.displacement)
    for (std::size_t k = 0; k < x.size(); ++k) frame.displacement.push_back(x[k] - vertices.rest[k]);
  if (fields.stress && !is_chain) {
    vertex_stresses(ends, springs, volumes, x, frame.stress, system.terms);
    frame.largest_stress = largest_principal_stress(frame.stress);
  }
  if (fields.springs && !is_chain) frame.springs.assign(ends.begin(), ends.end());
  const bool has_tensions = fields.stress && is_chain;
  if (!has_tensions && !fields.springs) return;
  for (std::size_t k = 0; k < springs.size(); ++k) {
    const Spring spring = springs[k];
    const double stretch = (x[ends[k][1]] - x[ends[k][0]]).norm() - spring.rest_length;
    if (has_tensions) frame.tension.push_back(or_infinity(spring.stiffness * stretch));
    if (fields.springs) frame.strain.push_back(or_infinity(stretch / spring.rest_length));
  }
}

std::vector<std::uint8_t> constraints_of(const VertexColumns& v, const std::function<bool(std::uint32_t)>& is_driven) {
  std::vector<std::uint8_t> held(v.size(), 0);
  for (std::size_t k = 0; k < v.held_axes.size(); ++k)
    if (v.held_axes[k] != 0) held[k] = 3;
  for (std::size_t k = 0; k < v.fixed.size(); ++k)
    if (v.fixed[k]) held[k] = is_driven(v.point[k]) ? 2 : 1;
  return held;
}

void fill_contact(Frame& frame, const Contacts& contacts) {
  const auto& x = frame.mesh.points;
  frame.contact_force.assign(x.size(), Eigen::Vector3d(0, 0, 0));
  frame.contact_depth.assign(x.size(), 0.0);
  if (contacts.obstacles != nullptr) contacts.obstacles->add_forces({.x = x}, frame.contact_force);
  if (contacts.bodies != nullptr) contacts.bodies->add_forces({.x = x}, frame.contact_force);
  contacts.for_each_touch({.x = x}, [&](const Touch& touch) {
    const SkinSample& sample = contacts.sample(touch);
    FramePair pair{.depth = touch.depth};
    std::ranges::copy(sample.corners(), pair.sample.begin());
    if (sample.count == 1) {
      double& depth = frame.contact_depth[sample.nodes[0]];
      depth = std::max(depth, touch.depth);
    }
    if (touch.in_body != nullptr)
      std::ranges::copy(contacts.bodies->solids().triangles()[touch.in_body->triangle].nodes, pair.face.begin());
    else
      pair.obstacle = touch.obstacle;
    frame.contact_pairs.push_back(pair);
  });
}

}  // namespace dartboard
