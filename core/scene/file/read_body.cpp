#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>
#include <numbers>

#include "core/base/cell_limits.h"
#include "core/scene/file/keys/scene_value.h"
#include "core/scene/file/read_parts.h"

namespace dartboard {
namespace {

// The elements of a map are numbered in 32 bits.
void require_room(const SceneValue& cells, std::uint64_t most) {
  double count = 1.0;
  for (const double along : cells.as<std::vector<double>>()) count *= along;
  if (count > static_cast<double>(most))
    cells.fail(fmt::format("is {}, {:.0f} in all", cells.shown(), count), fmt::format("at most {} in all", most));
}

BoxMesh read_box(const SceneValue& box) {
  const auto kind = box.get<std::string>("kind");
  // six tetrahedra to a cube; of mixed cells at most as many darts as seven pyramids have (mixed_box)
  require_room(box.at("cells"), kind == "tetrahedra"  ? most_tetrahedra / 6
                                : kind == "hexahedra" ? most_darts(3) / darts_of(CellKind::hexahedron)
                                                      : most_darts(3) / (7 * darts_of(CellKind::pyramid)));
  const auto jitter = box.get<double>("jitter");
  if (kind != "tetrahedra" && jitter != 0.0)
    box.fail_at("jitter", "is " + box.at("jitter").shown(), "0: only boxes of tetrahedra can have it");
  return {box.get<std::array<int, 3>>("cells"), box.get<double>("spacing"),     kind, jitter,
          box.get<std::uint64_t>("seed"),       box.get<std::string>("pattern")};
}

SheetMesh read_sheet(const SceneValue& sheet) {
  const auto kind = sheet.get<std::string>("kind");
  const std::uint64_t darts =
      kind == "triangles" ? 2 * darts_of(CellKind::triangle) : darts_of(CellKind::quadrilateral);
  require_room(sheet.at("cells"), most_darts(2) / darts);
  return {sheet.get<std::array<int, 2>>("cells"), sheet.get<double>("spacing"), kind};
}

Eigen::Matrix3d read_rotation(const SceneValue& rotate) {
  return Eigen::AngleAxisd(rotate.get<double>("degrees") * (std::numbers::pi / 180.0), rotate.at("axis").direction())
      .toRotationMatrix();
}

}  // namespace

BodySource read_body(const SceneValue& value, const std::filesystem::path& folder) {
  BodySource source{.mesh = {},
                    .scale = value.get<double>("scale"),
                    .translate = value.get<Eigen::Vector3d>("translate"),
                    .split_touching = value.get<std::string>("touching") == "split",
                    .path = value.path(),
                    .weld = value.find<double>("weld")};
  if (value.has("rotate")) source.rotate = read_rotation(value.at("rotate"));
  if (value.has("mesh")) {
    source.mesh = folder / value.get<std::string>("mesh");
    return source;
  }
  if (source.weld) value.fail_at("weld", "is given for a mesh that is generated", "'mesh', or no 'weld'");
  const SceneValue generate = value.at("generate");
  if (generate.has("box"))
    source.mesh = read_box(generate.at("box"));
  else if (generate.has("sheet"))
    source.mesh = read_sheet(generate.at("sheet"));
  else if (generate.has("ball"))
    source.mesh = BallMesh{generate.at("ball").get<int>("layers"), generate.at("ball").get<double>("radius")};
  else
    source.mesh = ChainMesh{generate.at("chain").get<int>("links"), generate.at("chain").get<double>("spacing")};
  return source;
}

BodySource read_bodies(const SceneValue& list, const std::filesystem::path& folder) {
  BodyList bodies;
  for (const SceneValue& value : list.entries()) {
    BodySource& body = bodies.all.emplace_back(read_body(value, folder));
    if (value.has("material")) body.material = read_material(value.at("material"));
    if (value.has("initial_velocity")) body.velocity = read_velocity(value.at("initial_velocity"));
  }
  if (bodies.all.empty()) list.fail("is empty", "at least one body");
  return {.mesh = std::move(bodies), .scale = 1.0, .translate = {0, 0, 0}, .path = list.path()};
}

}  // namespace dartboard
