#pragma once
// What CalculiX is asked, beside our own answers.

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

namespace dartboard {

/// A beam that is bent, as a deck for CalculiX and as it bends by elements of ours.
struct CalculixQuestion {
  std::string what;  // "tetrahedra (C3D4), small displacements"
  bool large = false;
  std::string deck;
  std::vector<Eigen::Vector3d> ours;  // [m] the displacement of each node
};

/// Core's tetrahedra and hexahedra, and the reference's quadratic tetrahedra, under small loads; the former bent to 0.6
/// of their length, too. Of `across` cubes.
///
/// pre  across is 2 or 4
std::vector<CalculixQuestion> calculix_questions(int across);

/// The largest distance between our displacements and those that are printed, over the largest of these.
/// throws  IoError where they are not those of all nodes
double apart(const CalculixQuestion& question, std::string_view printed);

}  // namespace dartboard
