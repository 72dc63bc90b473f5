// Drag by still or moving air: a force against the normal part of the relative velocity of each face.

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/forces/force_size.h"
#include "core/forces/one_minus_exp.h"
#include "core/forces/rows_of_part.h"
#include "core/forces/term_damping.h"
#include "core/scene/file/keys/scene_value.h"
#include "core/scene/file/scene_file.h"
#include "core/scene/forces/body_force.h"
#include "core/scene/forces/kinds.h"
#include "core/topology/cells.h"

namespace dartboard {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// A face of the boundary of a solid, or a cell of a surface.
struct AirFace {
  std::uint32_t count = 0;  // of its corners: 3 or 4
  std::array<std::uint32_t, 4> corner{};
  double area = 0.0;  // [m^2] when it was found

  std::span<const std::uint32_t> corners() const { return {corner.data(), count}; }
  template <class Archive>
  void state(Archive& archive) {
    archive(count, corner, area);
  }
};

/// By the lines between vertices. Half the cross product of the diagonals is the area vector of any surface that four
/// corners span.
template <class Line>
Vector3d area_vector_of(const AirFace& face, const Line& line_between) {
  const auto line = [&](std::size_t a, std::size_t b) -> Vector3d {
    return line_between(face.corner[a], face.corner[b]);
  };
  return face.count == 3 ? 0.5 * line(0, 1).cross(line(0, 2)) : 0.5 * line(0, 2).cross(line(1, 3));
}
Vector3d area_vector(const AirFace& face, const StagePlaces& at) {
  return area_vector_of(face, [&at](std::uint32_t i, std::uint32_t j) { return at.line(i, j); });
}

/// The faces in the air, in no particular order: cuts expose more of them.
class FacesInAir {
 public:
  std::vector<AirFace> rows;

  template <class Body>
  void rebuild(const Body& body) {
    rows.clear();
    number_.clear();
    row_.assign(darts(body).size(), none);
    for (std::uint32_t k = 0; k < row_.size(); ++k) find(body, k);
  }

  /// cost    O(changed faces, and the faces around changed vertices), whatever the size of the body
  template <class Body>
  void apply(const Body& body, const ChangedEmbeddings& changed) {
    const std::size_t count = darts(body).size();
    for (auto k = static_cast<std::uint32_t>(count); k < row_.size(); ++k) erase(k);
    row_.resize(count, none);
    for (const std::uint32_t k : Body::dimension == 3 ? changed.faces : changed.cells) find(body, k);
    for (const std::uint32_t k : changed.vertices)
      for_each_dart_of(body.map, Vertex{body.vertices.dart[k]}, [&](Dart d) {
        if constexpr (Body::dimension == 3) {
          if (body.map.template is_free<3>(d)) find(body, body.face(body.map, d));
        } else {
          find(body, body.cell(body.map, d));
        }
      });
  }

  template <class Archive>
  void state(Archive& archive) {
    archive(rows, number_, row_);
  }
  std::size_t bytes() const { return bytes_of(rows) + bytes_of(number_, row_); }
  void shrink_to_fit() {
    number_.shrink_to_fit();
    row_.shrink_to_fit();
  }

 private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  template <class Body>
  static const std::vector<Dart>& darts(const Body& body) {
    if constexpr (Body::dimension == 3)
      return body.face_dart;
    else
      return body.cell_dart;
  }
  template <class Body>
  void find(const Body& body, std::uint32_t k) {
    const Dart first = darts(body)[k];
    if constexpr (Body::dimension == 3)
      if (!body.map.template is_free<3>(first)) return erase(k);
    AirFace face;
    Dart d = first;
    do {
      face.corner.at(face.count++) = body.vertex(body.map, d);
      d = body.map.template alpha<0, 1>(d);
    } while (d != first);
    face.area = area_vector(face, {body.vertices.position}).norm();
    if (row_[k] == none) {
      row_[k] = static_cast<std::uint32_t>(rows.size());
      rows.emplace_back();
      number_.push_back(k);
    }
    rows[row_[k]] = face;
  }
  /// The last row takes its place.
  void erase(std::uint32_t k) {
    const std::uint32_t row = row_[k];
    if (row == none) return;
    rows[row] = rows.back();
    number_[row] = number_.back();
    row_[number_[row]] = row;
    row_[k] = none;
    rows.pop_back();
    number_.pop_back();
  }

  std::vector<std::uint32_t> number_;  // by row: of its face
  std::vector<std::uint32_t> row_;     // by face; none within the body
};

/// The normal of a face, and the force [N s/m] of each corner against the normal part of its relative velocity.
struct Drag {
  Vector3d normal{0, 0, 0};
  double rate = 0.0;

  Drag(const Air& air, const AirFace& face, const Vector3d& area) {
    const double size = area.stableNorm();
    if (!(size > 0.0)) return;  // without a direction
    normal = area / size;
    rate = air.drag * size / face.count;
  }
  Drag(const Air& air, const AirFace& face, const StagePlaces& at) : Drag(air, face, area_vector(face, at)) {}
  Vector3d force(const Vector3d& relative) const { return (rate * normal.dot(relative)) * normal; }
};

/// A bound of what rounding is relative to in `Drag::rate`.
double rate_size(const Air& air, const AirFace& face, const StagePlaces& at) {
  const std::uint32_t last = face.corner[face.count - 1];
  return air.drag * line_size(at, face.corner[0], face.corner[face.count == 3 ? 1 : 2]) *
         line_size(at, face.corner[face.count == 3 ? 0 : 1], last);
}

/// Visits a diagonal of equal blocks for a face.
void visit_diagonal(const AirFace& face, const Matrix3d& block, const ForceTerm::VisitTangent& visit) {
  std::array<Matrix3d, 10> blocks;
  blocks.fill(Matrix3d::Zero());
  for (std::size_t a = 0; a < face.count; ++a) blocks[a * (a + 3) / 2] = block;
  visit(face.corners(), std::span(blocks).first(face.count * (face.count + 1) / 2));
}

/// - C v, as if the air stood still: C has a block for each corner, rate n n'.
class StillAir final : public TermDamping {
 public:
  StillAir(const std::vector<AirFace>& rows, const Air& air) : rows_(rows), air_(air) {}

  double time(std::size_t) const override { return 1.0; }
  bool is_viscous() const override { return true; }

  void add_forces(const StagePlaces& at, std::span<const Vector3d> v, std::span<Vector3d> force) const override {
    for (const AirFace& face : rows_) {
      const Drag drag(air_, face, at);
      for (const std::uint32_t k : face.corners()) force[k] -= drag.force(v[k]);
    }
  }
  void add_force_sizes(const StagePlaces& at, std::span<const Vector3d> v, std::span<double> size) const override {
    for (const AirFace& face : rows_) {
      const double rate = rate_size(air_, face, at);
      for (const std::uint32_t k : face.corners()) size[k] += 4.0 * rate * v[k].norm();
    }
  }
  double power(std::span<const std::uint32_t> pieces, std::span<const Vector3d> x, std::span<const Vector3d> v,
               std::span<const Vector3d> w) const override {
    double sum = 0.0;
    for (const std::uint32_t row : pieces) {
      const Drag drag(air_, rows_[row], {x});
      for (const std::uint32_t k : rows_[row].corners()) sum -= drag.force(v[k]).dot(w[k]);
    }
    return sum;
  }
  EnergyChange rate_change(const StagePlaces& at, std::span<const Vector3d> v, std::span<const Vector3d> step,
                           double scale) const override {
    EnergyChange sum;
    for (const AirFace& face : rows_) {
      const Drag drag(air_, face, at);
      for (const std::uint32_t k : face.corners()) {
        const double more = scale * drag.normal.dot(step[k]);
        const double change = drag.rate * (drag.normal.dot(v[k]) + 0.5 * more) * more;
        sum.value += change;
        sum.sizes += std::abs(change);
      }
    }
    return sum;
  }
  void for_each_tangent(const StagePlaces& at, const VisitTangent& visit) const override {
    for (const AirFace& face : rows_) {
      const Drag drag(air_, face, at);
      visit_diagonal(face, drag.rate * drag.normal * drag.normal.transpose(), visit);
    }
  }
  void for_each_constant_tangent(const VisitTangent& visit) const override {
    for (const AirFace& face : rows_)
      visit_diagonal(face, (air_.drag * face.area / face.count) * Matrix3d::Identity(), visit);
  }
  void decay(std::span<const Vector3d> x, double h, const Mobility& mobility, bool backwards,
             std::span<Vector3d> v) const override {
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      const AirFace& face = rows_[backwards ? rows_.size() - 1 - row : row];
      const Drag drag(air_, face, {x});
      for (const std::uint32_t k : face.corners()) {
        const double mobile = mobility.along(k, drag.normal);
        if (mobile == 0.0) continue;
        const double lost = one_minus_exp_of_minus(drag.rate * mobile * h) / mobile;
        v[k] -= mobility.velocity_of(k, (lost * drag.normal.dot(v[k])) * drag.normal);
      }
    }
  }

 private:
  const std::vector<AirFace>& rows_;
  const Air air_;
};

/// The forces C u of air that moves at u, and by `damping` - C v. Their work is no energy's; the change of C u with the
/// places is left out of the tangents, as that of C v is.
class AirTerm final : public ForceTerm {
 public:
  AirTerm(const std::vector<AirFace>& rows, const Air& air) : rows_(rows), air_(air), still_(rows, air) {}

  std::string_view pieces_name() const override { return "faces in the air"; }
  std::size_t size() const override { return rows_.size(); }
  Nodes nodes(std::size_t piece) const override { return rows_[piece].corners(); }
  bool has_energy() const override { return air_.velocity.isZero(0.0); }
  const TermDamping* damping() const override { return &still_; }

  void add_forces(const StagePlaces& at, std::span<Vector3d> force) const override {
    if (has_energy()) return;
    for (const AirFace& face : rows_) {
      const Vector3d share = Drag(air_, face, at).force(air_.velocity);
      for (const std::uint32_t k : face.corners()) force[k] += share;
    }
  }
  void add_discrete_forces(const StagePlaces& at, std::span<Vector3d> force) const override { add_forces(at, force); }
  void add_force_sizes(const StagePlaces& at, std::span<double> size) const override {
    for (const AirFace& face : rows_) {
      const double share = 4.0 * rate_size(air_, face, at) * air_.velocity.norm();
      for (const std::uint32_t k : face.corners()) size[k] += share;
    }
  }

  double energy(std::span<const Vector3d>, std::size_t, std::size_t) const override { return 0.0; }
  /// The force half way, along the line.
  EnergyChange energy_change(const StagePlaces& at, std::span<const Vector3d> step, double scale) const override {
    EnergyChange sum;
    if (has_energy()) return sum;
    for (const AirFace& face : rows_) {
      const Vector3d area = area_vector_of(face, [&](std::uint32_t i, std::uint32_t j) -> Vector3d {
        return at.line(i, j) + (0.5 * scale) * (step[j] - step[i]);
      });
      const Vector3d share = Drag(air_, face, area).force(air_.velocity);
      for (const std::uint32_t k : face.corners()) {
        sum.value -= scale * share.dot(step[k]);
        sum.sizes += std::abs(scale) * share.norm() * step[k].norm();
      }
    }
    return sum;
  }
  double power(std::span<const std::uint32_t> pieces, std::span<const Vector3d> x,
               std::span<const Vector3d> w) const override {
    double sum = 0.0;
    for (const std::uint32_t row : pieces) {
      const Vector3d share = Drag(air_, rows_[row], {x}).force(air_.velocity);
      for (const std::uint32_t k : rows_[row].corners()) sum += share.dot(w[k]);
    }
    return sum;
  }

  void for_each_tangent(const StagePlaces&, Compression, const VisitTangent& visit) const override {
    for_each_constant_tangent(visit);
  }
  void for_each_constant_tangent(const VisitTangent& visit) const override {
    for (const AirFace& face : rows_) visit_diagonal(face, Matrix3d::Zero(), visit);
  }
  Virial virial(std::span<const Vector3d>, std::size_t) const override { return {}; }
  TermOfPart of_part(const VertexSubset& part) const override {
    const auto own = std::make_shared<std::vector<AirFace>>(
        rows_of_part(rows_, pieces_of_part(*this, part), part,
                     [](AirFace& face) { return std::span(face.corner).first(face.count); }));
    return {own, std::make_unique<AirTerm>(*own, air_)};
  }

 private:
  const std::vector<AirFace>& rows_;
  const Air air_;
  StillAir still_;
};

class AirForce final : public ViewedForce<FacesInAir> {
 public:
  explicit AirForce(const Air& air) : air_(air) {}

  const ForceTerm& term() const override { return term_; }
  std::size_t bytes() const override { return ViewedForce::bytes() + bytes_of(begin_); }

  bool does_work() const override { return true; }
  void begin_work(std::span<const Vector3d> x) override { begin_.assign(x.begin(), x.end()); }
  /// By the areas half way.
  double work(std::span<const Vector3d> x, double h) const override {
    const auto velocity = [&](std::uint32_t k) -> Vector3d { return (x[k] - begin_[k]) / h; };
    double sum = 0.0;
    for (const AirFace& face : view_.rows) {
      const Drag drag(air_, face, area_vector_of(face, [&](std::uint32_t i, std::uint32_t j) -> Vector3d {
                        return (begin_[j] - begin_[i]) + 0.5 * h * (velocity(j) - velocity(i));
                      }));
      for (const std::uint32_t k : face.corners()) {
        const Vector3d v = velocity(k);
        sum += h * drag.force(air_.velocity - v).dot(v);
      }
    }
    return sum;
  }

 private:
  const Air air_;
  AirTerm term_{view_.rows, air_};
  std::vector<Vector3d> begin_;  // by vertex: where it was
};

std::optional<ForceNeed> air_need(const SceneFile& scene, const Problem& problem) {
  if (!scene.air) return {};
  if (problem.mesh.cell_count() == 0)
    scene.fail("/air", "is around chains alone, which have no faces", "a solid or a surface, or no such key");
  const Vector3d& u = scene.air->velocity;
  return ForceNeed{.make = [air = *scene.air](const ForceSite& site) -> std::unique_ptr<BodyForce> {
                     if (site.dimension == 1) return nullptr;
                     return std::make_unique<AirForce>(air);
                   },
                   .what = "by face of the boundary its corners; drag, whose work is summed",
                   .why = fmt::format("/air/drag: {}, velocity: [{}, {}, {}]", scene.air->drag, u.x(), u.y(), u.z())};
}

}  // namespace

ForceKind air_kind() {
  using enum ValueType;
  return {
      .name = "air",
      // clang-format off
      .rows = {
          .keys = {
              {.shape = Shape::scene, .name = "air", .type = object, .of = Shape::air,
               .help = "air around all bodies, at rest or moving, which slows and carries them"},
              {.shape = Shape::air, .name = "drag", .type = real, .unit = "N s/m^3", .range = {.least = 0.0, .above = true},
               .required = true, .help = "force per area and per speed, along the normal"},
              {.shape = Shape::air, .name = "velocity", .type = point, .unit = "m/s", .standard = "[0, 0, 0]",
               .help = "of the air; not above that of light"}},
          .shapes = {
              {Shape::air, "air",
               "Drag of a face of the boundary of a solid, cuts included, or of a cell of a surface: drag times its area times the "
               "normal part of the velocity of the air relative to it, along the normal (Provot 1995), in equal shares at its "
               "corners. It is linear in the velocity, and there is none along a face, none in the lee of another body, and none on "
               "chains. A plate of mass m and area A sinks at m g / (drag A) in the end, a box at half of that, since it has two such "
               "faces. Its work is among that of applied forces: summed by the mean velocities of steps, of second order in the "
               "step."}}},
      // clang-format on
      .changes_energy = true,
      .is_in = [](const SceneFile& scene) { return scene.air.has_value(); },
      .read =
          [](const SceneValue& value, SceneFile& scene) {
            if (!value.has("air")) return;
            const SceneValue air = value.at("air");
            scene.air = Air{.drag = air.get<double>("drag"), .velocity = air.get<Vector3d>("velocity")};
            if (!(scene.air->velocity.stableNorm() <= speed_of_light))
              air.fail_at("velocity", fmt::format("is {}", air.at("velocity").shown()), "no speed above that of light");
          },
      .for_each_number =
          [](const SceneFile& scene, const ForceKind::Number& visit) {
            if (!scene.air) return;
            visit("/air/drag", scene.air->drag);
            visit("/air/velocity", scene.air->velocity.lpNorm<Eigen::Infinity>());
          },
      .need = air_need};
}

}  // namespace dartboard
