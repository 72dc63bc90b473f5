#include "benchmarks/pages/player_page.h"

#include <nlohmann/json.hpp>

namespace dartboard {

nlohmann::json player_page(const RecordedFrames& frames, const PlayedRun& run) {
  // four letters of base64 for three bytes, next to 1.15 MB of libraries
  constexpr std::size_t most_bytes = 1'300'000;
  const auto numbers = [](const Eigen::Vector3d& x) { return nlohmann::json{x.x(), x.y(), x.z()}; };
  const PictureView& view = run.look.view;
  const Eigen::Vector3d towards(view.seen(Eigen::Vector3d::UnitX()).z(), view.seen(Eigen::Vector3d::UnitY()).z(),
                                view.seen(Eigen::Vector3d::UnitZ()).z());
  const Eigen::Vector3d& gravity = run.scene.gravity;
  const Eigen::Vector3d up = gravity.isZero(0.0) ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d(-gravity.normalized());
  return {{"format", "dartboard-player"},
          {"version", 1},
          {"program", DARTBOARD_VERSION},
          {"title", run.scene.name},
          {"about", run.scene.about},
          {"facts", run.facts},
          {"warnings", run.warnings},
          {"text", run.text},
          {"towards", numbers(towards)},
          {"up", numbers(up)},
          {"colours",
           {{"numbers", colours::numbers},
            {"shades", {shade_of(0.0), shade_of(0.25), shade_of(0.5), shade_of(0.75), shade_of(1.0)}},
            {"inside", colours::inside},
            {"held", colours::held},
            {"driven", colours::driven},
            {"held_in_part", colours::held_in_part},
            {"attached", colours::attached},
            {"obstacle", colours::obstacle}}},
          {"run", frames.json(most_bytes)}};
}

}  // namespace dartboard
