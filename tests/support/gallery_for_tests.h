#pragma once
// Scenes of the gallery, and the ends that they expect.

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <stdexcept>
#include <string>

#include "benchmarks/checkout/source_folder.h"
#include "core/scene/file/scene_file.h"

namespace dartboard {

inline SceneFile gallery(const std::string& name) {
  return read_scene(source_folder() / "benchmarks" / "scenes" / (name + ".json"));
}

inline const ExpectedPlace& place_of(const SceneFile& scene, const std::string& probe, bool of_part = false) {
  for (const ExpectedPlace& place : scene.expect.places)
    if (scene.probes[place.probe].name == probe && place.of_part == of_part) return place;
  throw std::runtime_error(scene.name + " expects no place of " + probe);
}

inline void expect_place(const SceneFile& scene, const ExpectedPlace& place, const Eigen::Vector3d& derived) {
  EXPECT_LE((derived - place.position).norm(), place.within)
      << scene.name << ", " << scene.probes[place.probe].name << (place.of_part ? ", part" : "") << ": derived "
      << derived.transpose() << ", expected " << place.position.transpose();
  EXPECT_FALSE(place.why.empty()) << scene.name << ": the source of the place is missing";
}

}  // namespace dartboard
