#include "core/elements/attachments.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/counted.h"
#include "core/scene/file/keys/scene_value.h"
#include "core/scene/file/scene_file.h"
#include "core/scene/forces/attached_points.h"
#include "core/scene/forces/body_force.h"
#include "core/scene/forces/corners_of_cells.h"
#include "core/scene/forces/kinds.h"
#include "core/views/attachments_view.h"

namespace dartboard {
namespace {

class AttachmentsForce final : public ViewedForce<AttachmentsView> {
 public:
  AttachmentsForce(std::vector<AttachedPoints> points, const ForceSite& site)
      : points_(std::move(points)),
        mesh_cell_(site.mesh_cell),
        term_(make_attachments(view_.rows, site.vertices.mass)) {}

  const ForceTerm& term() const override { return *term_; }
  std::vector<std::array<Eigen::Vector3d, 2>> attachments(std::span<const Eigen::Vector3d> x) const override {
    std::vector<std::array<Eigen::Vector3d, 2>> lines;
    for (const AttachedVertex& row : view_.rows) lines.push_back({x[row.nodes[0]], place_of(row, x)});
    return lines;
  }
  std::size_t bytes() const override { return ViewedForce::bytes() + bytes_of(attachments_); }

  void rebuild(const MapBody& body) override {
    if (!points_.empty())
      view_ = AttachmentsView(
          std::visit([&](const auto* on) { return shared_by_mass(std::exchange(points_, {}), on->vertices); }, body),
          mesh_cell_);
    ViewedForce::rebuild(body);
  }
  void leave_map() override {
    ViewedForce::leave_map();
    attachments_ = {};
  }
  /// Each part of an attached vertex has a row, as in AttachmentsView.
  void rebuild(const BodyWithoutMap& body) override {
    if (!points_.empty()) attachments_ = shared_by_mass(std::exchange(points_, {}), body.vertices);
    on_map_ = false;
    std::vector<AttachedVertex>& rows = view_.rows;
    rows.clear();
    std::vector<std::uint32_t> cells;
    for (const Attachment& one : attachments_)
      if (one.has_cell()) cells.push_back(one.cell);
    const CornersOfCells corners(body, std::move(cells));
    std::vector<std::pair<std::uint32_t, std::uint32_t>> at;  // (point, vertex)
    for (std::uint32_t k = 0; k < body.vertices.size(); ++k) at.push_back({body.vertices.point[k], k});
    std::ranges::sort(at);
    for (const Attachment& one : attachments_) {
      if (one.has_cell() && !corners.is_there(one.cell)) continue;
      for (auto k = std::ranges::lower_bound(at, std::pair(one.point, 0u)); k != at.end() && k->first == one.point;
           ++k) {
        AttachedVertex& row = rows.emplace_back(attached(one, k->second));
        for (std::size_t a = 0; a < one.count; ++a) row.nodes[a + 1] = corners.vertex_at(one.cell, one.corners[a]);
      }
    }
  }

 private:
  std::vector<AttachedPoints> points_;  // until their stiffness is shared
  std::function<std::uint32_t(std::uint32_t)> mesh_cell_;
  std::vector<Attachment> attachments_;  // without a map
  std::unique_ptr<ForceTerm> term_;
};

std::optional<ForceNeed> attachments_need(const SceneFile& scene, const Problem& problem) {
  if (scene.attachments.empty()) return {};
  std::vector<AttachedPoints> points = find_attachments(scene, problem);
  std::string held, why;
  for (std::size_t k = 0; k < scene.attachments.size(); ++k) {
    const SceneAttachment& one = scene.attachments[k];
    const std::size_t count = points[k].points.size();
    held += fmt::format("{}{} to {}", k == 0 ? "" : ", ", counted(count, "vertex", "vertices"),
                        one.to ? fmt::format("body {}", *one.to) : "fixed places");
    why += fmt::format("{}{}/stiffness: {}", k == 0 ? "" : "; ", one.path, one.stiffness);
  }
  return ForceNeed{.make = [points = std::move(points)](
                               const ForceSite& site) { return std::make_unique<AttachmentsForce>(points, site); },
                   .what = "springs without length: " + held,
                   .why = why,
                   .over_parts = true};
}

SceneAttachment read_one(const SceneValue& value, const SceneFile& scene) {
  SceneAttachment attachment{.vertices = read_vertices(value),
                             .to = value.find<std::uint32_t>("to"),
                             .stiffness = value.get<double>("stiffness"),
                             .path = value.path()};
  if (!attachment.to) return attachment;
  if (!std::holds_alternative<BodyList>(scene.body.mesh))
    value.fail_at("to", fmt::format("is {} without /bodies", *attachment.to), "several bodies, or no such key");
  if (*attachment.to >= scene.bodies().size())
    value.fail_at("to", fmt::format("is {}", *attachment.to),
                  fmt::format("the number of a body, less than {}", scene.bodies().size()));
  return attachment;
}

}  // namespace

ForceKind attachments_kind() {
  using enum ValueType;
  return {
      .name = "attachments",
      // clang-format off
      .rows = {
          .keys = {
              {.shape = Shape::scene, .name = "attachments", .type = objects, .of = Shape::attachment, .standard = "[]",
               .help = "vertices that springs hold to a body or to the places where they are at rest"},
              {.shape = Shape::attachment, .name = "to", .type = integer, .range = {.least = 0.0, .most = 4294967294.0},
               .help = "the body that they are attached to, by its place in 'bodies', counted from 0; selected vertices of that body "
                       "are not held. Left out, they are held to the places where they are at rest"},
              {.shape = Shape::attachment, .name = "stiffness", .type = real, .unit = "N/m",
               .range = {.least = 0.0, .above = true}, .required = true,
               .help = "of all springs together, shared in proportion to the masses of the vertices"}},
          .shapes = {
              {Shape::attachment, "attachment",
               "Springs without length and without damping, one for each of some vertices. Each is attached to the point of a "
               "body, or of space, where the vertex is at rest, so that at rest there is no force. In a body that point is in "
               "the cell that the vertex is in or nearest to, no farther away than the longest edge of that cell, and moves "
               "with a tetrahedron (of a surface a triangle) of it; to be attached to a surface, a vertex lies in the plane of "
               "such a triangle. Momentum is kept, also where a fixed or driven vertex is attached. Parts of a vertex that "
               "comes apart share its spring in proportion to their masses, what loses cells loses their share, and a cell "
               "that is removed takes what is attached to it along. Not with refinement."}},
          .rules = {{SceneRule::exactly_one, Shape::attachment, {"ids", "box", "plane", "sphere", "around"}}}},
      // clang-format on
      .is_in = [](const SceneFile& scene) { return !scene.attachments.empty(); },
      .read =
          [](const SceneValue& value, SceneFile& scene) {
            for (const SceneValue& one : value.at("attachments").entries())
              scene.attachments.push_back(read_one(one, scene));
          },
      .for_each_selection =
          [](SceneFile& scene, const ForceKind::Selection& visit) {
            for (SceneAttachment& one : scene.attachments) visit(one.path, one.vertices);
          },
      .for_each_number =
          [](const SceneFile& scene, const ForceKind::Number& visit) {
            for (const SceneAttachment& one : scene.attachments) visit(one.path + "/stiffness", one.stiffness);
          },
      .need = attachments_need};
}

}  // namespace dartboard
