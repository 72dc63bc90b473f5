#include "core/elements/bending.h"

#include <fmt/format.h>

#include "core/scene/file/keys/scene_value.h"
#include "core/scene/file/scene_file.h"
#include "core/scene/forces/body_force.h"
#include "core/scene/forces/kinds.h"
#include "core/views/inner_edges_view.h"

namespace dartboard {
namespace {

/// Rows across the inner edges of a surface.
template <class View>
class InnerEdgesForce final : public ViewedForce<View> {
 public:
  template <class Make>
  InnerEdgesForce(View view, const Make& make) : ViewedForce<View>(std::move(view)), term_(make(this->view_.rows)) {}

  const ForceTerm& term() const override { return *term_; }
  void rebuild(const MapBody& body) override { this->view_.rebuild(surface(body)); }
  using ViewedForce<View>::rebuild;
  void apply(const MapBody& body, const ChangedEmbeddings& changed) override {
    this->view_.apply(surface(body), changed);
  }

 private:
  static const BodyOf<Map2>& surface(const MapBody& body) { return *std::get<const BodyOf<Map2>*>(body); }

  std::unique_ptr<ForceTerm> term_;
};

std::optional<ForceNeed> bending_need(const SceneFile& scene, const Problem&) {
  const Bending bending = scene.bending;
  if (!bending.any()) return {};
  const bool is_quadratic = bending.rigidity > 0.0;
  const auto make = [bending, is_quadratic](const ForceSite& site) -> std::unique_ptr<BodyForce> {
    if (site.dimension != 2) return nullptr;
    if (is_quadratic)
      return std::make_unique<InnerEdgesForce<BendingView>>(BendingView(bending.rigidity), make_bending);
    return std::make_unique<InnerEdgesForce<SecondNeighboursView>>(SecondNeighboursView(), [&](const auto& rows) {
      return make_second_neighbours(rows, bending.second_neighbours);
    });
  };
  return ForceNeed{.make = make,
                   .what = is_quadratic ? "by edge: four vertices and their coefficients"
                                        : "by edge: second neighbours across it, rest lengths",
                   .why = is_quadratic ? fmt::format("/bending/rigidity: {}", bending.rigidity)
                                       : fmt::format("/bending/second_neighbours: {}", bending.second_neighbours),
                   .rest = true};
}

void read(const SceneValue& value, SceneFile& scene) {
  if (!value.has("bending")) return;
  const SceneValue bending = value.at("bending");
  scene.bending = {.rigidity = bending.find<double>("rigidity").value_or(0.0),
                   .second_neighbours = bending.find<double>("second_neighbours").value_or(0.0)};
}

}  // namespace

ForceKind bending_kind() {
  using enum ValueType;
  return {
      .name = "bending",
      // clang-format off
      .rows = {
          .keys = {
              {.shape = Shape::scene, .name = "bending", .type = object, .of = Shape::bending,
               .help = "what resists the bending of a surface"},
              {.shape = Shape::bending, .name = "rigidity", .type = real, .unit = "N m", .range = {.least = 0.0},
               .help = "flexural rigidity of a flat sheet of triangles, E h^3 / (12 (1 - nu^2)) of a plate of thickness h: energy "
                       "that is quadratic in the bend of each edge, with a constant matrix. Exact on triangles with equal sides; "
                       "squares halved have it along their sides, and thrice that along one diagonal. It is that of a cylinder: a free "
                       "strip of the generated squares sags some 20 % more than a beam of that rigidity, and one of equal "
                       "triangles (0.4 m by 0.2 m, edges of 20, 10 and 5 mm) 21, 12 and 7 % more, so that a clamp and free "
                       "borders cost about the width of a cell"},
              {.shape = Shape::bending, .name = "second_neighbours", .type = real, .unit = "N/m", .range = {.least = 0.0},
               .help = "stiffness of springs between second neighbours, as Provot has them: between the two corners across an edge "
                       "of triangles, along the lines of a mesh of quadrilaterals. They have no linear bending stiffness: their "
                       "energy goes with the fourth power of the curvature, so take them for the paper, not for numbers"}},
          .shapes = {{Shape::bending, "bending", "What resists the bending of a surface: by its rigidity, or by springs."}},
          .rules = {{SceneRule::exactly_one, Shape::bending, {"rigidity", "second_neighbours"}}}},
      // clang-format on
      .is_in = [](const SceneFile& scene) { return scene.bending.any(); },
      .read = read,
      .need = bending_need};
}

}  // namespace dartboard
