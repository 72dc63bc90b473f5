#include "validation/statics/calculix_deck.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <span>
#include <sstream>

#include "core/plain/error.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

/// Twenty characters at most, including sign and exponent.
std::string number(double value) { return fmt::format("{:.13e}", value); }

/// The parts common to all decks; nodes are counted from 1.
class Deck {
 public:
  explicit Deck(std::span<const Vector3d> nodes) {
    text_ = "*NODE, NSET=ALL\n";
    for (std::size_t i = 0; i < nodes.size(); ++i)
      text_ += fmt::format("{}, {}, {}, {}\n", i + 1, number(nodes[i][0]), number(nodes[i][1]), number(nodes[i][2]));
  }
  void elements(std::string_view type) { text_ += fmt::format("*ELEMENT, TYPE={}, ELSET=SOLID\n", type); }
  void element(std::span<const std::uint32_t> nodes) {
    text_ += fmt::format("{}", ++count_);
    for (const std::uint32_t node : nodes) text_ += fmt::format(", {}", node + 1);
    text_ += "\n";
  }
  /// Material, clamps, and the step.
  template <class Force>
  std::string with(const StaticProblem& problem, std::span<const std::uint32_t> held, std::size_t nodes,
                   Force&& force) {
    text_ += fmt::format("*MATERIAL, NAME=ELASTIC\n*ELASTIC\n{}, {}\n*SOLID SECTION, ELSET=SOLID, MATERIAL=ELASTIC\n",
                         number(problem.young), number(problem.poisson));
    text_ += "*BOUNDARY\n";
    for (const std::uint32_t node : held) text_ += fmt::format("{}, 1, 3\n", node + 1);
    if (problem.large)
      text_ += fmt::format(
          "*STEP, NLGEOM, INC={0}\n*STATIC, DIRECT\n{1:.6f}, 1.\n*CONTROLS, PARAMETERS=FIELD\n1.e-9, 1.e-9\n",
          StaticProblem::parts, 1.0 / StaticProblem::parts);
    else
      text_ += "*STEP\n*STATIC\n";
    text_ += "*CLOAD\n";
    for (std::size_t i = 0; i < nodes; ++i) {
      const Vector3d f = force(i);
      for (int c = 0; c < 3; ++c)
        if (f[c] != 0.0) text_ += fmt::format("{}, {}, {}\n", i + 1, c + 1, number(f[c]));
    }
    return text_ + "*NODE PRINT, NSET=ALL\nU\n*END STEP\n";
  }

 private:
  std::string text_;
  std::size_t count_ = 0;
};

}  // namespace

std::string calculix_deck(const StaticProblem& problem) {
  const Mesh& mesh = problem.mesh;
  const CellKind kind = mesh.kinds.empty() ? CellKind::tetrahedron : mesh.kinds.front();
  for (const CellKind other : mesh.kinds)
    if (other != kind || (kind != CellKind::tetrahedron && kind != CellKind::hexahedron))
      throw InputError(fmt::format("a deck has tetrahedra or hexahedra alone, and not a {}", name(other)));
  Deck deck(mesh.points);
  deck.elements(kind == CellKind::tetrahedron ? "C3D4" : "C3D8");
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) deck.element(mesh.cell(c));
  return deck.with(problem, problem.held, mesh.points.size(), [&](std::size_t i) { return problem.force[i]; });
}

std::string calculix_deck(const StaticProblem& problem, const reference::QuadraticSolid& solid,
                          const std::vector<std::uint32_t>& held, const Eigen::VectorXd& force) {
  // the reference has nodes in the middle of edges, computed in the same way as here
  std::map<std::array<double, 3>, std::uint32_t> node_at;
  for (std::uint32_t i = 0; i < solid.nodes().size(); ++i) {
    const Vector3d& x = solid.nodes()[i];
    node_at[{x[0], x[1], x[2]}] = i;
  }
  Deck deck(solid.nodes());
  deck.elements("C3D10");
  for (std::size_t c = 0; c < problem.mesh.cell_count(); ++c) {
    const auto cell = problem.mesh.cell(c);
    std::vector<std::uint32_t> nodes(cell.begin(), cell.end());
    for (const auto& [i, j] : {std::pair{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}) {
      const Vector3d x = 0.5 * (problem.mesh.points[cell[static_cast<std::size_t>(i)]] +
                                problem.mesh.points[cell[static_cast<std::size_t>(j)]]);
      nodes.push_back(node_at.at({x[0], x[1], x[2]}));
    }
    deck.element(nodes);
  }
  return deck.with(problem, held, solid.nodes().size(),
                   [&](std::size_t i) { return Vector3d(force.segment<3>(static_cast<Eigen::Index>(3 * i))); });
}

std::vector<Vector3d> calculix_displacements(std::string_view printed, std::size_t nodes) {
  std::vector<Vector3d> u;
  std::istringstream lines{std::string(printed)};
  std::size_t count = 0;
  bool in_block = false;
  const auto fail = [&](const std::string& what) { throw IoError(fmt::format("calculix: line {}: {}", count, what)); };
  for (std::string line; std::getline(lines, line);) {
    ++count;
    if (line.find_first_not_of(" \r") == std::string::npos) continue;
    if (line.find("displacements") != std::string::npos) {  // of the next part of the load
      u.clear();
      in_block = true;
      continue;
    }
    if (!in_block) continue;
    std::istringstream words(line);
    std::size_t node = 0;
    std::array<std::string, 3> word;
    if (!(words >> node >> word[0] >> word[1] >> word[2]))
      fail(fmt::format("expected a node and three displacements, found '{}'", line));
    if (node != u.size() + 1) fail(fmt::format("expected node {}, found node {}", u.size() + 1, node));
    Vector3d d;
    for (std::size_t c = 0; c < 3; ++c) {
      char* end = nullptr;
      d[static_cast<Eigen::Index>(c)] = std::strtod(word[c].c_str(), &end);
      if (*end != '\0' || !std::isfinite(d[static_cast<Eigen::Index>(c)]))
        fail(fmt::format("expected a displacement, found '{}'", word[c]));
    }
    u.push_back(d);
  }
  if (u.size() != nodes) fail(fmt::format("expected the displacements of {} nodes, found {}", nodes, u.size()));
  return u;
}

}  // namespace dartboard
