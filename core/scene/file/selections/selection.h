#pragma once
// Selections of points and cells of a body.

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/plain/held_axes.h"

namespace dartboard {

class SceneValue;

// ---- kinds: each has its key, and is read from a value that has been checked against the table of keys

/// Points or cells of the mesh, by number.
struct IdSelection {
  static constexpr std::string_view key = "ids";
  static IdSelection read(const SceneValue& value);

  std::vector<std::uint32_t> ids;
};
/// A box with faces across the axes, surface included.
struct BoxSelection {
  static constexpr std::string_view key = "box";
  static BoxSelection read(const SceneValue& value);

  Eigen::Vector3d min, max;
};
/// A plane and the side that its normal points to.
struct PlaneSelection {
  static constexpr std::string_view key = "plane";
  static PlaneSelection read(const SceneValue& value);

  Eigen::Vector3d point, normal;
};
/// A ball, surface included.
struct SphereSelection {
  static constexpr std::string_view key = "sphere";
  static SphereSelection read(const SceneValue& value);

  Eigen::Vector3d centre;
  double radius;
};
/// A prism without ends: a polygon extended along a direction.
struct PolygonSelection {
  static constexpr std::string_view key = "polygon";
  static PolygonSelection read(const SceneValue& value, const Eigen::Vector3d& along);

  Eigen::Vector3d along;                 // a unit vector
  std::vector<Eigen::Vector3d> corners;  // in turn; three at least
};
/// The legs of a path, each as deep as `depth`.
struct BladeSweep {
  static constexpr std::string_view key = "blade";
  static BladeSweep read(const SceneValue& value);

  std::vector<Eigen::Vector3d> path;
  Eigen::Vector3d depth;
};
/// All that is near a path, or near the area that a blade sweeps along it.
struct AroundSelection {
  static constexpr std::string_view key = "around";
  static AroundSelection read(const SceneValue& value);

  BladeSweep sweep;
  double distance;
};
/// Cells that a mesh file marks: those with this value, or the value of this name, of the tags of that name.
struct TagSelection {
  static constexpr std::string_view key = "tag";
  static TagSelection read(const SceneValue& value);

  std::string tag;  // empty where the file has one kind of tag
  std::variant<std::int32_t, std::string> value;
};
/// `count` of the cells, drawn without replacement.
struct RandomSelection {
  static constexpr std::string_view key = "random";
  static RandomSelection read(const SceneValue& value);

  std::uint32_t count;
  std::uint64_t seed;
};

// ---- what a key of a scene may be

/// The region that limits a cut.
using CutRegion = std::variant<BoxSelection, SphereSelection, AroundSelection, PolygonSelection>;
using VertexSelection = std::variant<IdSelection, BoxSelection, PlaneSelection, SphereSelection, AroundSelection>;
using CellSelection = std::variant<IdSelection, BoxSelection, PlaneSelection, SphereSelection, AroundSelection,
                                   RandomSelection, TagSelection>;
/// Vertices that are held: still, or along some axes.
struct HeldSelection {
  static HeldSelection read(const SceneValue& value);

  VertexSelection vertices;
  HeldAxes axes = all_axes;
};

VertexSelection read_vertices(const SceneValue& value);
CellSelection read_cells(const SceneValue& value);

/// Is a place in a region, whose border is `thickness` thick (core/places/border.h) and belongs to it?
bool contains(const BoxSelection& box, const Eigen::Vector3d& x, double thickness);
bool contains(const PlaneSelection& plane, const Eigen::Vector3d& x, double thickness);
bool contains(const SphereSelection& sphere, const Eigen::Vector3d& x, double thickness);
bool contains(const AroundSelection& around, const Eigen::Vector3d& x, double thickness);
/// Decided by the parity of the sides that a ray crosses, so the polygon need not be convex.
bool contains(const PolygonSelection& polygon, const Eigen::Vector3d& x, double thickness);
bool contains(const CutRegion& region, const Eigen::Vector3d& x, double thickness);

/// The numbers of the points in the selection at `path`, ascending, each once. The points set the thickness of borders.
///
/// throws  InputError "PATH/ids/1: ..." for an id that is no point
std::vector<std::uint32_t> select_points(const VertexSelection& selection, std::span<const Eigen::Vector3d> points,
                                         std::string_view path);
/// The axes along which each of the points is held by the selections in the list at `path`.
///
/// throws  InputError as above, and for a selection of no point
std::vector<HeldAxes> held_axes_of(std::span<const HeldSelection> selections, std::span<const Eigen::Vector3d> points,
                                   std::string_view path = "/fixed");

/// The numbers of those centroids that are in a region, ascending; empty for a selection that is not a region.
std::vector<std::uint32_t> cells_in(const CellSelection& selection, std::span<const Eigen::Vector3d> centroids,
                                    double thickness);

/// throws  InputError "PATH: ..." if none of the points is selected; it says where they are
void require_some(std::span<const std::uint32_t> selected, std::string_view path,
                  std::span<const Eigen::Vector3d> points);

}  // namespace dartboard
