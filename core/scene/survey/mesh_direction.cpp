#include "core/scene/survey/mesh_direction.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cstddef>
#include <span>
#include <variant>

namespace dartboard {

std::optional<MeshDirection> direction_of(const Mesh& mesh) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    const std::span<const std::uint32_t> nodes = mesh.cell(c);
    for (const std::vector<int>& face : faces_of(mesh.kinds[c]))
      for (std::size_t k = 0; k < face.size(); ++k) {
        const auto from = static_cast<std::size_t>(face[k]), to = static_cast<std::size_t>(face[(k + 1) % face.size()]);
        const Eigen::Vector3d edge = mesh.points[nodes[to]] - mesh.points[nodes[from]];
        sum += edge * edge.transpose();
      }
  }
  const double size = sum.trace();
  if (!(size > 0.0)) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(sum / size);
  const Eigen::Vector3d& shares = solver.eigenvalues();  // ascending
  constexpr double flat = 1e-12;
  if (shares[0] < flat) return std::nullopt;
  Eigen::Vector3d axis = solver.eigenvectors().col(2);
  if (axis.sum() < 0.0) axis = -axis;
  return MeshDirection{axis, shares[2] / shares[0]};
}

std::string direction_in_words(const SceneFile& scene, const Mesh& mesh) {
  constexpr double worth_a_word = 1.5;
  const std::optional<MeshDirection> found = is_mixed(mesh) ? std::nullopt : direction_of(mesh);
  if (!found || found->ratio < worth_a_word) return "";
  const Eigen::Vector3d& a = found->axis;
  std::string text = fmt::format(
      "The mesh has a direction: the squares of its edges sum to {:.2g} times as much along [{:.2g}, {:.2g}, {:.2g}] as "
      "across. Springs are that much stiffer there however fine the mesh, so a pull along another direction moves the "
      "body sideways as well; elements do so less and less as cells get smaller.",
      found->ratio, a[0], a[1], a[2]);
  for (const BodySource& body : scene.bodies())
    if (const auto* box = std::get_if<BoxMesh>(&body.mesh); box != nullptr && box->pattern == "kuhn")
      return text + fmt::format(" A box with {}/generate/box/pattern \"mirrored\" has none for even counts of cells.",
                                body.path);
  return text;
}

}  // namespace dartboard
