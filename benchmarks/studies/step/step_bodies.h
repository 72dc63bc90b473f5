#pragma once
// The bodies that `bench step` steps: the paper's, boxes of cubes, and those of files.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/plain/problem.h"
#include "core/plain/random.h"

namespace dartboard {

struct StepBody {
  std::string name;
  std::size_t about;  // tetrahedra
  std::function<Problem()> make;
};

/// The paper's body with and without damping.
std::string paper_step_body(bool damped);
/// The box of about so many tetrahedra, a power of ten from 10^3 to 10^6, its points and cells along the grid or
/// shuffled.
std::string step_box(std::size_t tetrahedra, bool shuffled);
/// Both bodies of the paper, and boxes of up to so many tetrahedra; `seed` is that of shuffled meshes and velocities.
std::vector<StepBody> make_step_bodies(std::size_t largest, std::uint64_t seed);
/// Their names.
std::vector<std::string> step_bodies(std::size_t largest);
/// The names of the bodies of these files.
/// throws  InputError where two have the same
std::vector<std::string> step_meshes(const std::vector<std::filesystem::path>& meshes);
/// The bodies of files, each cut finer until it has so many tetrahedra.
std::vector<StepBody> make_bodies_of_files(const std::vector<std::filesystem::path>& meshes, std::size_t least,
                                           std::uint64_t seed);
/// throws  InputError if no body of the paper and no box has this name
StepBody find_step_body(const std::string& name, std::uint64_t seed);

template <class T>
void shuffle(std::vector<T>& column, SplitMix64& random) {
  for (std::size_t k = column.size(); k > 1; --k) std::swap(column[k - 1], column[random.below(k)]);
}

}  // namespace dartboard
