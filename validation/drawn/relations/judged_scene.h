#pragma once
// A scene that relations are tried on, with the runs that several of them need.

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "core/scene/file/scene_file.h"
#include "core/time/method/scheme.h"
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
  const Scheme& scheme() const { return scheme_; }
  /// Does the integrator choose its own steps?
  bool is_adaptive() const { return adaptive_; }
  /// At rest, all bodies one after another.
  const Mesh& mesh() const { return mesh_; }
  /// Where the points of each body begin, and after the last of them their number.
  const std::vector<std::size_t>& first_points() const { return first_points_; }
  /// 1 for chains; none where the dimension of the cells of bodies differs.
  std::optional<int> dimension() const { return dimension_; }
  const MotionScales& scales() const { return scales_; }
  bool is_damped() const;
  /// Are dampers, and the faces in the air, taken one after the other?
  bool is_swept() const { return scheme_.sweeps && (is_damped() || file_.air); }
  /// Does the integrator not step each component by itself: by one tolerance for all, or by dampers in one order?
  bool steps_all_as_one() const { return scheme_.implicit || adaptive_ || is_swept(); }
  /// Has a contact friction, or restitution below 1?
  bool has_losses() const;
  bool has_box_obstacle() const;
  /// Does an event choose cells from all bodies together, or tears from all places?
  bool chooses_from_all() const;

  // ---- runs, each made when it is first asked for

  const DrawnMotion& motion() const { return motion_; }
  /// With a whole number of steps to each of its own.
  const DrawnMotion& in_shorter_steps(int parts) const;
  /// Begun elsewhere, by far more than rounding: one way, or the other.
  const DrawnMotion& disturbed(bool other_way) const;
  DrawnMotion run(const nlohmann::ordered_json& json, const DrawnRunOptions& options = {}) const;

 private:
  nlohmann::ordered_json json_;
  std::filesystem::path folder_, scratch_;
  SceneFile file_;
  Scheme scheme_;
  Mesh mesh_;
  std::vector<std::size_t> first_points_;
  std::optional<int> dimension_;
  MotionScales scales_;
  bool adaptive_ = false;
  DrawnMotion motion_;
  mutable std::map<int, DrawnMotion> shorter_;
  mutable std::map<bool, DrawnMotion> disturbed_;
};

}  // namespace dartboard
