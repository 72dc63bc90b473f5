// The folder of a continued run: cut back to the checkpoint, or left alone if it is damaged.

#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <map>
#include <string>

#include "core/plain/error.h"
#include "core/scene/output/scene_output.h"
#include "tests/support/folder_for_tests.h"
#include "tests/support/meshes_for_tests.h"

namespace dartboard::continued_output_test {
namespace {

namespace fs = std::filesystem;

Frame frame_at(double time) {
  Frame frame;
  frame.time = time;
  frame.mesh = two_tetrahedra();
  frame.velocity.resize(frame.mesh.points.size(), Eigen::Vector3d(time, 0, 0));
  frame.mass.resize(frame.mesh.points.size(), 1.0);
  frame.mesh_cell = {0, 1};
  frame.component = {0, 0};
  return frame;
}

void write_at(SceneOutput& output, double time) {
  Diagnostics row;
  row.time = time;
  output.write(frame_at(time));
  output.write(row);
  output.write(ProbeRow{time, {VertexMotion{{time, 0, 0}, {0, 0, 0}}}});
}

class ContinuedOutput : public FolderTest {
 protected:
  fs::path run() const { return folder_ / "run"; }

  /// Two times, a checkpoint, and two times that are written again.
  OutputSoFar leave_run() const {
    SceneOutput output(run(), probes_);
    write_at(output, 0.0);
    write_at(output, 0.5);
    const OutputSoFar so_far = output.so_far();
    write_at(output, 0.625);
    write_at(output, 0.75);
    return so_far;
  }
  SceneOutput go_on(const OutputSoFar& so_far) const {
    return {FolderClaim::of_ended_run(run()), run(), so_far, probes_};
  }
  std::map<std::string, std::string> files() const {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::directory_iterator(run()))
      all[entry.path().filename().string()] = contents(entry.path());
    return all;
  }

  std::vector<Probe> probes_{{"tip, \"upper\"", std::uint32_t{0}, "/output/probes/0"}};
};

TEST_F(ContinuedOutput, IsThatOfOneRun) {
  const OutputSoFar so_far = leave_run();
  {
    SceneOutput output = go_on(so_far);
    EXPECT_EQ(output.frame_count(), 2u);
    write_at(output, 1.0);
  }
  const auto found = files();
  fs::remove_all(run());
  SceneOutput whole(run(), probes_);
  for (const double time : {0.0, 0.5, 1.0}) write_at(whole, time);
  EXPECT_EQ(found, files());
}

TEST_F(ContinuedOutput, CanBeGoneOnWithAgain) {
  const OutputSoFar so_far = leave_run();
  OutputSoFar later;
  {
    SceneOutput output = go_on(so_far);
    write_at(output, 1.0);
    later = output.so_far();
    write_at(output, 1.25);
  }
  SceneOutput output = go_on(later);
  EXPECT_EQ(output.frame_count(), 3u);
  EXPECT_EQ(text("run/diagnostics.csv").find("1.25"), std::string::npos);
  EXPECT_NE(text("run/frames.pvd").find("timestep=\"1\""), std::string::npos);
}

TEST_F(ContinuedOutput, IsHeldByOneRunAtATime) {
  const OutputSoFar so_far = leave_run();
  const SceneOutput first = go_on(so_far);
  try {
    go_on(so_far);
    FAIL() << "two runs in one folder";
  } catch (const IoError& error) {
    EXPECT_EQ(error.what(), run().string() + ": is in use by another run; expected the folder of a run that has ended");
  }
}

TEST_F(ContinuedOutput, OfNoFolderMakesNone) {
  EXPECT_THROW(FolderClaim::of_ended_run(run()), IoError);
  EXPECT_FALSE(fs::exists(run()));
}

TEST_F(ContinuedOutput, OfADamagedFolderIsRefusedAndNothingIsChanged) {
  const std::map<std::string, std::pair<std::function<void(const fs::path&)>, std::string>> damages{
      {"frame_000001.vtu",
       {[](const fs::path& file) { fs::remove(file); },
        "is missing; expected what the run left, so nothing has been changed"}},
      {"frame_000000.vtu", {[](const fs::path& file) { fs::resize_file(file, 100); }, "has 100 bytes, not "}},
      {"frames.pvd", {[](const fs::path& file) { fs::resize_file(file, 120); }, "has been shortened to 120 of "}},
      {"diagnostics.csv", {[](const fs::path& file) { fs::resize_file(file, 30); }, "has been shortened to 30 of "}},
      {"probes.csv",
       {[](const fs::path& file) { std::fstream(file, std::ios::in | std::ios::out) << "Time"; },
        "has been changed; expected what the run left"}}};
  for (const auto& [name, damage] : damages) {
    fs::remove_all(run());
    const OutputSoFar so_far = leave_run();
    damage.first(run() / name);
    const auto before = files();
    try {
      go_on(so_far);
      ADD_FAILURE() << name << " was accepted";
    } catch (const IoError& error) {
      EXPECT_EQ(std::string(error.what()).find((run() / name).string() + ": " + damage.second), 0u) << error.what();
    }
    EXPECT_EQ(files(), before) << name;
  }
}

}  // namespace
}  // namespace dartboard::continued_output_test
