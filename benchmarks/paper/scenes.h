#pragma once
// The named scenes that tests and benchmarks share.

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "core/plain/problem.h"

namespace dartboard {

struct Scene {
  std::string name;
  std::string what;               // one line
  std::filesystem::path mesh;     // the file it reads; empty when it is generated
  std::function<Problem()> make;  // throws IoError if the mesh cannot be read
};

std::span<const Scene> scenes();

/// throws  InputError that lists the known names
const Scene& scene(std::string_view name);

}  // namespace dartboard
