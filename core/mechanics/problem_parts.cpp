#include "core/mechanics/problem_parts.h"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "core/plain/error.h"

namespace dartboard {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

/// Is it in none of them?
std::vector<bool> unused_points(const Mesh& mesh) {
  std::vector<bool> unused(mesh.points.size(), true);
  for (const std::uint32_t p : mesh.nodes) unused[p] = false;
  for (const auto& link : mesh.links)
    for (const std::uint32_t p : link) unused[p] = false;
  return unused;
}

class PartMaker {
 public:
  PartMaker(const Problem& whole, int dimension, std::vector<bool> taken) : whole_(whole), taken_(std::move(taken)) {
    part_.dimension = dimension;
    const Mesh& mesh = whole.mesh;
    for (std::uint32_t c = 0; c < mesh.cell_count(); ++c)
      if (dartboard::dimension(mesh.kinds[c]) == dimension) take(c, mesh.cell(c));
    if (dimension == 1)
      for (std::uint32_t k = 0; k < mesh.links.size(); ++k)
        take(static_cast<std::uint32_t>(mesh.cell_count()) + k, mesh.links[k]);
  }

  bool empty() const { return part_.cell.empty(); }

  ProblemPart part() {
    Problem& problem = part_.problem;
    problem.surroundings = whole_.surroundings;
    problem.h = whole_.h;
    take_points();
    take_cells();
    take_materials();
    return std::move(part_);
  }

 private:
  template <class Nodes>
  void take(std::uint32_t cell, const Nodes& nodes) {
    part_.cell.push_back(cell);
    for (const std::uint32_t p : nodes) taken_[p] = true;
  }

  void take_points() {
    Problem& problem = part_.problem;
    number_.assign(taken_.size(), none);
    for (std::uint32_t p = 0; p < taken_.size(); ++p) {
      if (!taken_[p]) continue;
      number_[p] = static_cast<std::uint32_t>(part_.point.size());
      part_.point.push_back(p);
      problem.mesh.points.push_back(whole_.mesh.points[p]);
      if (!whole_.initial_velocity.empty()) problem.initial_velocity.push_back(whole_.initial_velocity[p]);
    }
    for (const std::uint32_t p : whole_.fixed)
      if (number_[p] != none) problem.fixed.push_back(number_[p]);
    for (const HeldPoint& held : whole_.held_axes)
      if (number_[held.point] != none) problem.held_axes.push_back({number_[held.point], held.axes});
  }

  void take_cells() {
    const Mesh& mesh = whole_.mesh;
    for (const std::uint32_t c : part_.cell) {
      if (c >= mesh.cell_count()) {
        const auto [a, b] = mesh.links[c - mesh.cell_count()];
        part_.problem.mesh.links.push_back({number_[a], number_[b]});
        continue;
      }
      std::vector<std::uint32_t> nodes;
      for (const std::uint32_t p : mesh.cell(c)) nodes.push_back(number_[p]);
      part_.problem.mesh.add_cell(mesh.kinds[c], nodes);
    }
  }

  void take_materials() {
    Problem& problem = part_.problem;
    const CellMaterials materials = whole_.cell_materials();
    problem.material = materials[part_.cell.front()];
    problem.material.viscosity = whole_.material.viscosity;
    if (materials.is_one()) return;
    std::vector<std::uint32_t> place(materials.all().size(), none);
    for (const std::uint32_t c : part_.cell) {
      const MaterialNumber number = materials.number(c);
      if (place[number] == none) {
        place[number] = static_cast<std::uint32_t>(part_.material.size());
        part_.material.push_back(number);
        problem.materials.push_back(materials[c]);
      }
      problem.cell_material.push_back(static_cast<MaterialNumber>(place[number]));
    }
    if (problem.materials.size() > 1) return;
    problem.materials.clear();
    problem.cell_material.clear();
  }

  const Problem& whole_;
  std::vector<bool> taken_;            // by point of the whole
  std::vector<std::uint32_t> number_;  // in the part, by point of the whole
  ProblemPart part_;
};

}  // namespace

std::vector<ProblemPart> parts_of(const Problem& problem) {
  std::vector<ProblemPart> parts;
  for (const int dimension : {3, 2, 1})
    if (PartMaker maker(problem, dimension,
                        parts.empty() ? unused_points(problem.mesh) : std::vector<bool>(problem.mesh.points.size()));
        !maker.empty())
      parts.push_back(maker.part());
  std::vector<int> dimension(problem.mesh.points.size(), 0);
  for (const ProblemPart& part : parts)
    for (const std::uint32_t p : part.point)
      if (std::exchange(dimension[p], part.dimension) != 0)
        throw InputError(
            fmt::format("point {} belongs to cells of several dimensions; expected points of their own, which "
                        "attachments can hold to each other",
                        p));
  return parts;
}

}  // namespace dartboard
