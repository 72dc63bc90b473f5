#pragma once
// Meshes as a command line names them: those of the project by name, all others by their file.

#include <string>
#include <vector>

#include "benchmarks/studies/topology/topology_study.h"

namespace dartboard {

/// Notices about a file are printed on standard error when it is read.
MeshSource find_mesh(const std::string& name);

/// The meshes that generators and CGAL make, and the files of benchmarks/meshes.
std::vector<MeshSource> all_meshes();

}  // namespace dartboard
