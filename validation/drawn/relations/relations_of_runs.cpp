// The same scene run again, in another way, or in parts: same bits.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/meshes/mesh_io.h"
#include "core/meshes/text/file_text.h"
#include "core/scene/file/load_mesh.h"
#include "core/scene/file/scene_problem.h"
#include "core/scene/plan/scene_plan.h"
#include "core/scene/recorded_run.h"
#include "validation/drawn/relations/comparison.h"

namespace dartboard {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

RelationFound judge_repeated(const JudgedScene& s) { return unless(different_bits(s.motion(), s.run(s.json()))); }
RelationFound judge_lanes(const JudgedScene& s) {
  return unless(different_bits(s.motion(), s.run(s.json(), {.lanes = false})));
}
RelationFound judge_threads(const JudgedScene& s) {
  return unless(different_bits(s.motion(), s.run(s.json(), {.threads = 3})));
}
RelationFound judge_continued(const JudgedScene& s) {
  return unless(different_bits(s.motion(), s.run(s.json(), {.continued = true})));
}

RelationFound judge_files(const JudgedScene& s) {
  if (s.scratch().empty()) return does_not_apply("there is no folder for files");
  const fs::path whole = s.scratch() / "whole", parts = s.scratch() / "parts";
  fs::remove_all(whole);
  fs::remove_all(parts);
  Json scene = s.json();
  // states that it can go on from
  if (!scene.contains("output")) scene["output"] = Json::object();
  if (!scene["output"].contains("checkpoint")) scene["output"]["checkpoint"] = 3.0 * s.file().step;
  const auto read = [&] {
    SceneFile file = parse_scene(scene.dump(), "scene", s.folder());
    load_mesh(file);
    return file;
  };
  RecordedRun(read(), {.folder = whole}).run();
  const auto half = static_cast<std::uint64_t>(std::max(1.0, std::floor(0.5 * s.file().duration / s.file().step)));
  bool goes_on = false;
  {
    RecordedRun begun(read(), {.folder = parts, .most_steps = half});
    begun.run();
    goes_on = begun.continues_after().has_value();
  }
  if (goes_on) RecordedRun::continued(parts).run();
  std::set<std::string> names;
  for (const fs::path& folder : {whole, parts})
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (entry.is_regular_file() && entry.path().filename() != checkpoint_name)
        names.insert(entry.path().lexically_relative(folder).string());
  for (const std::string& name : names)
    if (file_text(whole / name, "a file of the run") != file_text(parts / name, "that of the whole run"))
      return breaks(name + " has other bytes");
  return {};
}

/// The last frame of a run that has one.
std::optional<fs::path> last_frame(const fs::path& folder) {
  std::set<fs::path> frames;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".vtu") frames.insert(entry.path());
  return frames.empty() ? std::nullopt : std::optional(*frames.rbegin());
}

RelationFound judge_frames(const JudgedScene& s) {
  if (s.scratch().empty()) return does_not_apply("there is no folder for files");
  if (s.mesh().kinds.empty() || is_mixed(s.mesh()))
    return does_not_apply("meshes in files have cells of one dimension");
  if (!s.motion().end.empty()) return does_not_apply("the run ends early");
  const fs::path folder = s.scratch() / "frames";
  fs::remove_all(folder);
  RecordedRun(s.file(), {.folder = folder}).run();
  const auto frame = last_frame(folder);
  if (!frame) return does_not_apply("it has no frames");
  const std::vector<double>&places = last_named(s.motion(), "positions").values,
        &corners = last_named(s.motion(), "corners").values;
  if (corners.empty()) return does_not_apply("nothing is left of it");
  const Mesh read = read_mesh(*frame, {.keep_crossed = true});
  const auto is_same = [](double number, const double& coordinate) { return number == coordinate; };
  const std::span<const double> read_places(read.points.empty() ? nullptr : read.points[0].data(),
                                            3 * read.points.size());
  if (!std::ranges::equal(read_places, places, is_same)) return breaks("its points are not where they were");
  if (read.nodes.size() != corners.size()) return breaks("its cells have another number of corners");
  for (std::size_t c = 0; c < read.cell_count(); ++c) {
    // a cell that is inside out is turned where it is read
    const auto cell = read.cell(c);
    std::multiset<double> found(cell.begin(), cell.end());
    const auto begin = corners.begin() + read.first[c];
    if (found != std::multiset<double>(begin, begin + static_cast<std::ptrdiff_t>(cell.size())))
      return breaks(fmt::format("its cell {} has other corners", c));
  }
  return {};
}

RelationFound judge_plan(const JudgedScene& s) {
  for (const MemoryItem& item : plan_scene(s.file()).unplanned)
    return breaks(fmt::format("{} bytes of {} have no row", item.bytes, name(item.part)));
  return {};
}

}  // namespace

std::vector<Relation> relations_of_runs() {
  return {
      {"repeated", "run again", "same bits", judge_repeated},
      {"lanes", "one number at a time in place of four", "same bits", judge_lanes},
      {"threads", "three threads in place of one", "same bits", judge_threads},
      {"continued", "its state is written halfway, and another simulation goes on from it", "same bits",
       judge_continued},
      {"files", "stopped, and continued from its checkpoint: all files", "same bytes", judge_files},
      {"frames", "the last frame of its files, read as a mesh", "same bits of points, same corners of cells",
       judge_frames},
      {"plan", "what explain says: a row for every byte", "equal", judge_plan},
  };
}

}  // namespace dartboard
