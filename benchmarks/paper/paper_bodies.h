#pragma once
// The bodies of the paper, shared by tests and benchmarks.

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "core/plain/problem.h"

namespace dartboard {

struct PaperBody {
  std::string name;
  std::string what;               // one line
  std::filesystem::path mesh;     // the file it reads; empty when it is generated
  std::function<Problem()> make;  // throws IoError if the mesh cannot be read
};

std::span<const PaperBody> paper_bodies();

/// throws  InputError that lists the known names
const PaperBody& paper_body(std::string_view name);

}  // namespace dartboard
