#pragma once
// Problems for CalculiX, with our own answers.

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

namespace dartboard {

/// A bent beam, as a deck for CalculiX and as the result of our elements.
struct CalculixQuestion {
  std::string what;  // "tetrahedra (C3D4), small displacements"
  bool large = false;
  std::string deck;
  std::vector<Eigen::Vector3d> ours;  // [m] the displacement of each node
};

/// Core's tetrahedra and hexahedra, and the reference's quadratic tetrahedra, under small loads; the former bent to 0.6
/// of their length, too. With `across` cubes.
///
/// pre  across is 2 or 4
std::vector<CalculixQuestion> calculix_questions(int across);

/// The largest distance between our displacements and the printed ones, over the largest of these.
/// throws  IoError if they are not those of all nodes
double apart(const CalculixQuestion& question, std::string_view printed);

}  // namespace dartboard
