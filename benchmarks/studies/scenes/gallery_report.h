#pragma once
// The report of `dartboard gallery` on the scenes that it ran.

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "benchmarks/harness/table.h"
#include "core/scene/file/scene_file.h"

namespace dartboard {

/// One scene, run and judged.
struct ShownScene {
  SceneFile scene;
  std::string file, map, hash, picture_trouble, divergence;
  std::uint64_t steps = 0;
  std::size_t operations = 0, expected = 0, held = 0;
  double cpu_s = 0.0;

  bool holds() const { return divergence.empty() && held == expected; }
};

/// A row for each scene.
Table gallery_table(const std::vector<ShownScene>& all);

/// What each scene shows, and why.
Table shown_table(const std::vector<ShownScene>& all);

nlohmann::ordered_json to_json(const ShownScene& shown);

}  // namespace dartboard
