#pragma once
// Relations between runs of one scene, or one scene written in two ways, that hold whatever the motion is: no truth is
// needed to judge it.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/scene/file/scene_file.h"
#include "validation/drawn/drawn_motion.h"

namespace dartboard {

/// A scene under judgement, with its own motion.
class JudgedScene {
 public:
  /// `folder` is where its mesh files are relative to; `scratch` an existing folder for files of runs, or empty: then
  /// relations of files do not apply.
  ///
  /// throws  InputError for a scene that is wrong, or has no step
  JudgedScene(nlohmann::ordered_json json, std::filesystem::path folder, std::filesystem::path scratch);

  const nlohmann::ordered_json& json() const { return json_; }
  const std::filesystem::path& folder() const { return folder_; }
  const std::filesystem::path& scratch() const { return scratch_; }
  const SceneFile& file() const { return file_; }
  const DrawnMotion& motion() const { return motion_; }
  /// 1 for chains; none where the dimension of the cells of bodies differs.
  std::optional<int> dimension() const { return dimension_; }
  const MotionScales& scales() const { return scales_; }
  bool is_implicit() const { return implicit_; }
  /// Are dampers taken one after the other?
  bool is_swept() const { return swept_; }
  /// Has a contact friction, or restitution below 1?
  bool has_losses() const;
  bool is_adaptive() const { return file_.integrator == "dormand-prince-54"; }
  /// Where the points of each body begin, and after the last of them their number.
  const std::vector<std::size_t>& first_points() const { return first_points_; }
  DrawnMotion run(const nlohmann::ordered_json& json, const DrawnRunOptions& options = {}) const;

 private:
  nlohmann::ordered_json json_;
  std::filesystem::path folder_, scratch_;
  SceneFile file_;
  DrawnMotion motion_;
  std::optional<int> dimension_;
  MotionScales scales_;
  std::vector<std::size_t> first_points_;
  bool implicit_ = false, swept_ = false;
};

enum class RelationOutcome { holds, breaks, does_not_apply };
struct RelationFound {
  RelationOutcome outcome = RelationOutcome::holds;
  std::string words;  // what differs, or why it does not apply
};

struct Relation {
  std::string_view name, sentence, bound;
  RelationFound (*judge)(const JudgedScene& scene);
};
std::span<const Relation> relations();

}  // namespace dartboard
