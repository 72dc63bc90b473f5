#include "core/mechanics/refine.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/plain/error.h"

namespace dartboard {
namespace {

template <class Map>
using Body = MassSpringBody<Map, Held::by_every_dart>;

constexpr std::size_t other_end(std::size_t p) { return tet_darts.node[tet_darts.alpha[0][p]]; }

/// Numbers of the embeddings of a removed tetrahedron, by its nodes, edges (01 02 03 12 13 23) and faces.
struct OldNumbers {
  std::array<std::uint32_t, 4> vertices, faces;
  std::array<std::uint32_t, 6> edges;
  std::array<double, 6> shares;  // of stiffness, of each edge
  std::uint32_t cell;
};

/// One subdivision, step by step; every step reads the results of those before.
template <class Map>
class Refinement {
 public:
  Refinement(Body<Map>& body, const Subdivision& subdivision, double bracing)
      : body_(body), map_(body.map), s_(subdivision), bracing_(bracing) {
    // dead slots still hold the parents' labels
    for (const auto& parent : s_.parents) old_.push_back(numbers_of(parent.darts));
  }

  ChangedEmbeddings run() {
    add_vertex();
    add_cells();
    inherit_numbers();
    number_faces();
    share_stiffness();
    number_edges();
    find_darts_and_masses();
    for (auto* list : {&changed_.vertices, &changed_.edges, &changed_.faces, &changed_.cells}) {
      std::sort(list->begin(), list->end());
      list->erase(std::unique(list->begin(), list->end()), list->end());
    }
    changed_.vertex_count = body_.vertices.size();
    changed_.edge_count = body_.springs.size();
    changed_.face_count = body_.face_dart.size();
    changed_.cell_count = body_.cell_mass.size();
    return std::move(changed_);
  }

 private:
  bool is_of_cell(std::uint32_t parent, std::size_t node) const {
    return (s_.parents[parent].of_cell >> node & 1u) != 0;
  }
  double count() const { return s_.cell_vertices; }

  OldNumbers numbers_of(const Subdivision::Darts& darts) const {
    OldNumbers old{};
    old.cell = body_.cell(map_, darts[0]);
    for (std::size_t p = 0; p < 24; ++p) {
      old.vertices[tet_darts.node[p]] = body_.vertex(map_, darts[p]);
      old.edges[tet_darts.edge[p]] = body_.edge(map_, darts[p]);
      old.faces[p / 6] = body_.face(map_, darts[p]);
      old.shares[tet_darts.edge[p]] =
          body_.edge_share.empty() ? 1.0 : body_.edge_share[Map::template slot<1>(darts[p])];
    }
    return old;
  }

  void add_vertex() {
    VertexColumns& v = body_.vertices;
    vertex_ = static_cast<std::uint32_t>(v.size());
    Eigen::Vector3d position(0, 0, 0), velocity(0, 0, 0), rest(0, 0, 0);
    HeldAxes held = all_axes;  // the axes along which all its corners are held
    for (std::size_t n = 0; n < 4; ++n)
      if (is_of_cell(0, n)) {
        const std::uint32_t k = old_[0].vertices[n];
        position += v.position[k];
        velocity += v.velocity[k];
        if (!v.rest.empty()) rest += v.rest[k];
        const bool fixed = !v.fixed.empty() && v.fixed[k] != 0;
        held &= fixed ? all_axes : v.held_axes.empty() ? HeldAxes{0} : v.held_axes[k];
      }
    add_element(v, VertexColumns::embedded(), vertex_);
    v.position.back() = position / count();
    v.velocity.back() = velocity / count();
    if (!v.force.empty()) v.force.back().setZero();
    if (!v.pull.empty()) v.pull.back().setZero();
    if (!v.rest.empty()) v.rest.back() = rest / count();
    if (!v.fixed.empty()) v.fixed.back() = held == all_axes ? 1 : 0;
    if (!v.held_axes.empty()) v.held_axes.back() = held == all_axes ? HeldAxes{0} : held;
    v.point.back() = no_point;
    v.dart.push_back(s_.vertex());
  }

  using Corners = std::array<std::size_t, 4>;

  /// The corners of a tetrahedron as its rest shape has them, by local node, from the place of its lowest dart: what
  /// `find_nodes` reads off its darts, of tetrahedra alone or among cells of other kinds.
  Corners local_corners(std::size_t lowest, bool inside_out) const {
    const auto& alpha = tet_darts.alpha;
    if (!is_of<SolidShape>(body_.elements))
      return {tet_darts.node[lowest], tet_darts.node[alpha[0][lowest]], tet_darts.node[alpha[0][alpha[1][lowest]]],
              tet_darts.node[alpha[0][alpha[1][alpha[2][lowest]]]]};
    // around a face, clockwise seen from outside, and up to the tip
    const std::size_t first = inside_out ? lowest : alpha[0][lowest];
    const std::size_t second = alpha[1][alpha[0][first]], third = alpha[1][alpha[0][second]];
    return {tet_darts.node[first], tet_darts.node[second], tet_darts.node[third],
            tet_darts.node[alpha[0][alpha[1][alpha[2][first]]]]};
  }

  /// The coordinate mu of a point for the new corner is m, the number of the cell's vertices, times lambda_r of the
  /// node r it replaces; for another node of the cell it is lambda - lambda_r. The gradients follow the same rule.
  RestShape shape_of_child(const Subdivision::Child& child, const Corners& of_child, const RestShape& parent,
                           const Corners& of_parent) const {
    std::array<Eigen::Vector3d, 4> gradient;
    for (std::size_t k = 1; k < 4; ++k) gradient[of_parent[k]] = parent.row(static_cast<Eigen::Index>(k) - 1);
    gradient[of_parent[0]] = -(gradient[of_parent[1]] + gradient[of_parent[2]] + gradient[of_parent[3]]);
    const Eigen::Vector3d replaced = gradient[child.replaced];
    RestShape shape;
    for (std::size_t k = 1; k < 4; ++k) {
      const std::size_t node = of_child[k];
      Eigen::Vector3d own = gradient[node];
      if (node == child.replaced)
        own *= count();
      else if (is_of_cell(child.parent, node))
        own -= replaced;
      shape.row(static_cast<Eigen::Index>(k) - 1) = own;
    }
    return shape;
  }

  // The first child of a parent keeps its number.
  void add_cells() {
    for (const auto& child : s_.children) {
      const std::uint32_t parent_cell = old_[child.parent].cell;
      const auto& parent = s_.parents[child.parent];
      const bool is_first =
          s_.children[child.parent * static_cast<std::uint32_t>(s_.cell_vertices)].replaced == child.replaced;
      std::uint32_t number = parent_cell;
      if (is_first) {
        whole_mass_ = body_.cell_mass[parent_cell];
        was_inside_out_ = body_.cell_inside_out[parent_cell] != 0;
        const auto at = std::find(parent.darts.begin(), parent.darts.end(), body_.cell_dart[parent_cell]);
        turned_ = (at - parent.darts.begin()) % 2 != 0;
        parent_corners_ = local_corners(static_cast<std::size_t>(at - parent.darts.begin()), was_inside_out_);
        if (const auto* shape = std::get_if<std::vector<RestShape>>(&body_.elements))
          parent_shape_ = (*shape)[parent_cell];
        if (const auto* shape = std::get_if<std::vector<SolidShape>>(&body_.elements))
          parent_solid_ = (*shape)[parent_cell];
      } else {
        number = static_cast<std::uint32_t>(body_.cell_mass.size());
        add_element(body_, Body<Map>::embedded_in_cells(), number);
        body_.cell_dart.push_back(no_dart);
      }
      body_.cell_mass[number] = whole_mass_ / count();
      if (!body_.cell_material.empty()) body_.cell_material[number] = body_.cell_material[parent_cell];
      body_.node_share[number] = body_.cell_mass[number] / 4.0;
      const auto lowest = std::min_element(child.darts.begin(), child.darts.end());
      body_.cell_dart[number] = *lowest;
      // an even number of steps away from the parent's dart, a child's lowest dart has the same orientation
      const bool odd = (lowest - child.darts.begin()) % 2 != 0;
      const bool inside_out = was_inside_out_ != (odd != turned_);
      body_.cell_inside_out[number] = inside_out;
      const Corners corners = local_corners(static_cast<std::size_t>(lowest - child.darts.begin()), inside_out);
      if (auto* shape = std::get_if<std::vector<RestShape>>(&body_.elements))
        (*shape)[number] = shape_of_child(child, corners, parent_shape_, parent_corners_);
      if (auto* shape = std::get_if<std::vector<SolidShape>>(&body_.elements)) {
        // one Gauss point, whose inverse Jacobian is that shape
        SolidShape& solid = (*shape)[number] = parent_solid_;
        solid.inverse[0] = shape_of_child(child, corners, parent_solid_.inverse[0], parent_corners_);
        solid.volume[0] = parent_solid_.volume[0] / count();
      }
      body_.cell.attach_places(map_, child.darts, number);
      changed_.cells.push_back(number);
    }
  }

  void inherit_numbers() {
    for (const auto& child : s_.children) {
      const OldNumbers& old = old_[child.parent];
      for (std::size_t p = 0; p < 24; ++p) {
        const std::size_t node = tet_darts.node[p], n = child.replaced;
        const std::array<Dart, 1> place{child.darts[p]};
        const bool on_new_edge = node == n || other_end(p) == n;
        body_.vertex.attach_places(map_, place, node == n ? vertex_ : old.vertices[node]);
        body_.edge.attach_places(map_, place, on_new_edge ? no_embedding : old.edges[tet_darts.edge[p]]);
        body_.face.attach_places(map_, place, p / 6 == n ? old.faces[n] : no_embedding);
      }
    }
  }

  /// The number of a part of cell `old`: the first part met keeps it, the next gets the next one.
  template <class Column>
  static std::uint32_t part_of(std::uint32_t old, std::vector<std::uint32_t>& kept, const Column& column) {
    if (old != no_embedding && std::find(kept.begin(), kept.end(), old) == kept.end()) {
      kept.push_back(old);
      return old;
    }
    return static_cast<std::uint32_t>(column.size());
  }

  void number_faces() {
    std::vector<std::uint32_t> kept;
    for (const auto& child : s_.children)
      for (std::size_t m = 0; m < 4; ++m) {
        const Dart d = child.darts[6 * m];
        if (m != child.replaced && body_.face(map_, d) == no_embedding) {
          const bool inside = is_of_cell(child.parent, m);
          const std::uint32_t number =
              part_of(inside ? no_embedding : old_[child.parent].faces[m], kept, body_.face_dart);
          if (number == body_.face_dart.size()) body_.face_dart.push_back(d);
          body_.face.attach(map_, Face{d}, number);
        }
        const std::uint32_t number = body_.face(map_, d);
        body_.face_dart[number] = no_dart;
        changed_.faces.push_back(number);
      }
  }

  /// The contribution of each child to the stiffness of its edges, over the stiffness of the material.
  void share_stiffness() {
    body_.edge_share.resize(map_.template slot_count<1>(), 1.0);
    for (const auto& child : s_.children)
      for (std::size_t p = 0; p < 24; ++p) {
        const std::size_t n = child.replaced, a = tet_darts.node[p], b = other_end(p);
        const auto in_cell = [&](std::size_t node) { return is_of_cell(child.parent, node) ? 1 : 0; };
        double share;
        if (a == n || b == n) {
          const std::size_t other = a == n ? b : a;
          const bool is_half = s_.cell_vertices == 2 && in_cell(other) == 1;
          // the children that have this edge: those that replaced another node than `other`
          share = is_half ? 2.0 * old_[child.parent].shares[tet_darts.edge[p]]
                          : bracing_ / (s_.cell_vertices - in_cell(other));
        } else {
          share = old_[child.parent].shares[tet_darts.edge[p]] / (s_.cell_vertices - in_cell(a) - in_cell(b));
        }
        body_.edge_share[Map::template slot<1>(child.darts[p])] = share;
      }
  }

  /// Rest length from the new vertex, the barycentre of the cell's vertices at rest, to node j of a parent:
  /// |w - j|^2 is the mean of |i - j|^2 over the cell's vertices i, less their mean square distance from w.
  double rest_length_to(std::size_t j, std::uint32_t parent) const {
    double to_j = 0.0, between = 0.0;
    for (std::size_t p = 0; p < 24; ++p) {  // each edge is met by four darts, two from either end
      const std::size_t a = tet_darts.node[p], b = other_end(p);
      const double length = rest_length_[index_of(parent, p)];
      const double square = length * length;
      if (b == j && is_of_cell(parent, a)) to_j += square / 2.0;
      if (is_of_cell(parent, a) && is_of_cell(parent, b)) between += square / 4.0;
    }
    return std::sqrt(std::max(0.0, to_j / count() - between / (count() * count())));
  }

  static std::size_t index_of(std::uint32_t parent, std::size_t p) { return 6 * parent + tet_darts.edge[p]; }

  void number_edges() {
    for (const OldNumbers& old : old_)
      for (const std::uint32_t e : old.edges) rest_length_.push_back(body_.springs[e].rest_length);
    std::vector<std::uint32_t> kept;
    for (const auto& child : s_.children)
      for (std::size_t p = 0; p < 24; ++p) {
        const Dart d = child.darts[p];
        if (body_.edge(map_, d) == no_embedding) {
          const std::size_t j = tet_darts.node[p] == child.replaced ? other_end(p) : tet_darts.node[p];
          const bool is_half = s_.cell_vertices == 2 && is_of_cell(child.parent, j);
          const std::uint32_t number =
              part_of(is_half ? old_[child.parent].edges[tet_darts.edge[p]] : no_embedding, kept, body_.springs);
          const double length =
              is_half ? rest_length_[index_of(child.parent, p)] / 2.0 : rest_length_to(j, child.parent);
          if (number == body_.springs.size()) {
            body_.springs.push_back({});
            body_.edge_dart.push_back(d);
          }
          body_.springs.change(number, [length](Spring& s) { s.rest_length = length; });
          body_.edge.attach(map_, Edge{d}, number);
        }
        const std::uint32_t number = body_.edge(map_, d);
        body_.edge_dart[number] = no_dart;
        changed_.edges.push_back(number);
      }
  }

  // The cells around the subdivided one have lost the darts of the parents and have got those of the children.
  void find_darts_and_masses() {
    std::vector<Dart> places;
    Mark seen(map_);
    const auto gather = [&]<int i>(Cell<i> cell) {
      places.clear();
      for_each_place_of(map_, cell, seen, [&places](Dart d) { places.push_back(d); });
      return *std::min_element(places.begin(), places.end());
    };
    for (const auto& child : s_.children)
      for (std::size_t p = 0; p < 24; ++p) {
        const Dart d = child.darts[p];
        if (Dart& lowest = body_.face_dart[body_.face(map_, d)]; lowest == no_dart) {
          seen.clear();
          lowest = gather(Face{d});
        }
        const std::uint32_t e = body_.edge(map_, d);
        if (Dart& lowest = body_.edge_dart[e]; lowest == no_dart) {
          seen.clear();
          lowest = gather(Edge{d});
          body_.springs.set(e, body_.spring_of(places, body_.springs[e].rest_length));
        }
        const std::uint32_t k = body_.vertex(map_, d);
        if (std::find(changed_.vertices.begin(), changed_.vertices.end(), k) == changed_.vertices.end()) {
          changed_.vertices.push_back(k);
          seen.clear();
          body_.vertices.dart[k] = gather(Vertex{d});
          body_.set_mass(k, body_.mass_of(places));
        }
      }
  }

  Body<Map>& body_;
  const Map& map_;
  const Subdivision& s_;
  const double bracing_;
  std::vector<OldNumbers> old_;
  std::vector<double> rest_length_;  // of the parents' edges, six each
  std::uint32_t vertex_ = 0;
  // of the parent whose children are added
  double whole_mass_ = 0.0;
  bool was_inside_out_ = false, turned_ = false;
  Corners parent_corners_{};
  RestShape parent_shape_ = RestShape::Zero();
  SolidShape parent_solid_;
  ChangedEmbeddings changed_;
};

}  // namespace

template <class Map>
ChangedEmbeddings adapt(Body<Map>& body, const Subdivision& subdivision, double bracing) {
  if (!(std::isfinite(bracing) && bracing >= 0.0))
    throw InputError(fmt::format("bracing is {}, expected a number of at least 0", bracing));
  return Refinement<Map>(body, subdivision, bracing).run();
}

template ChangedEmbeddings adapt(Body<Map3>&, const Subdivision&, double);
template ChangedEmbeddings adapt(Body<TetMap>&, const Subdivision&, double);

}  // namespace dartboard
