// The file of a checkpoint: faults of it, or of its inputs, are reported before anything is done.

#include "core/scene/restart/checkpoint.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <string>

#include "core/meshes/generators/mesh_generators.h"
#include "core/meshes/mesh_io.h"
#include "core/plain/error.h"
#include "tests/support/folder_for_tests.h"
#include "tests/support/moving_box.h"

namespace dartboard::checkpoint_test {
namespace {

using namespace moving;

class CheckpointTest : public FolderTest {
 protected:
  std::filesystem::path file() const { return folder_ / "checkpoint"; }

  /// Leaves the checkpoint of a run of the scene after some steps.
  void leave(const SceneFile& scene, int steps = 3) const {
    Simulation simulation(scene);
    for (int n = 0; n < steps; ++n) ASSERT_FALSE(simulation.advance());
    RunProgress progress;
    progress.frame_time = 0.25;
    Checkpoint::write(file(), scene, simulation, progress, {.frame_bytes = {11, 22}}, "notes");
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  std::string scene_on_mesh() const {
    Json scene = with_events(moving_box(), R"([{"at": 0.002, "remove": {"random": {"count": 3}}}])");
    scene["body"] = {{"mesh", "box.mesh"}};
    return scene.dump();
  }
  std::string changed(const char* key, const Json& value) const {
    Json scene = Json::parse(scene_on_mesh());
    scene[key] = value;
    return scene.dump();
  }
  void write_mesh_file(double spacing) const { write_medit(folder_ / "box.mesh", kuhn_box(2, 2, 2, spacing)); }

  std::string complaint() const {
    try {
      Checkpoint checkpoint(file());
      Simulation simulation(checkpoint.scene());
      checkpoint.load_into(simulation);
      return "accepted";
    } catch (const IoError& error) {
      return std::string("IoError ") + error.what();
    } catch (const InputError& error) {
      return std::string("InputError ") + error.what();
    }
  }
  std::string after_here(const std::string& text) const {
    const std::string here = folder_.string() + "/";
    std::string rest = text;
    for (std::size_t at; (at = rest.find(here)) != std::string::npos;) rest.erase(at, here.size());
    return rest;
  }
};

TEST_F(CheckpointTest, HasWhatWasGivenIt) {
  const SceneFile scene = parse(moving_box());
  leave(scene);
  Checkpoint checkpoint(file());
  EXPECT_EQ(checkpoint.steps_done(), 3u);
  EXPECT_EQ(checkpoint.notes(), "notes");
  EXPECT_EQ(checkpoint.progress().frame_time, 0.25);
  EXPECT_EQ(checkpoint.output().frame_bytes, (std::vector<std::uint64_t>{11, 22}));
  Simulation left(scene), found(checkpoint.scene());
  for (int n = 0; n < 3; ++n) left.advance();
  checkpoint.load_into(found);
  EXPECT_EQ(found.steps_done(), 3u);
  EXPECT_EQ(found.body().state_hash(), left.body().state_hash());
}

TEST_F(CheckpointTest, ReplacesTheLast) {
  leave(parse(moving_box()), 3);
  leave(parse(moving_box()), 5);
  EXPECT_EQ(Checkpoint(file()).steps_done(), 5u);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 1);
}

TEST_F(CheckpointTest, KeepsSeedStepAndIntegratorThatTheSceneDoesNotSay) {
  Json json = with_events(moving_box(), R"([{"at": 0.002, "remove": {"random": {"count": 3, "seed": 4}}}])");
  json.erase("step");
  json["accuracy"] = 1e-3;
  SceneFile scene = parse(json);
  scene.step = 0.0005;
  scene.integrator = "verlet";
  reseed(scene, 38);
  leave(scene);
  const SceneFile found = Checkpoint(file()).scene();
  EXPECT_EQ(found.step, 0.0005);
  EXPECT_EQ(found.integrator, "verlet");
  EXPECT_EQ(std::get<RandomSelection>(std::get<Remove>(found.events[0].action).cells).seed, 42u);
}

TEST_F(CheckpointTest, ThatIsCutShortAnywhereIsRefused) {
  leave(parse(moving_box()));
  const std::string bytes = text("checkpoint");
  for (std::size_t length = 0; length < bytes.size(); length += length < 64 ? 1 : 97) {
    write("checkpoint", bytes.substr(0, length));
    const std::string what = complaint();
    EXPECT_EQ(what.find("IoError " + file().string() + ": is "), 0u) << length << ": " << what;
  }
  write("checkpoint", bytes + "!");
  EXPECT_NE(complaint().find("checkpoint: is too long"), std::string::npos) << complaint();
}

TEST_F(CheckpointTest, WithAnyBitChangedIsRefused) {
  leave(parse(moving_box()));
  const std::string bytes = text("checkpoint");
  for (std::size_t at = 0; at < bytes.size(); at += at < 64 ? 1 : 89) {
    std::string changed = bytes;
    changed[at] = static_cast<char>(changed[at] ^ 4);
    write("checkpoint", changed);
    EXPECT_EQ(complaint().find("IoError " + file().string() + ": "), 0u) << at;
  }
}

TEST_F(CheckpointTest, OfAnotherKindOrderOrFormatIsToldApart) {
  leave(parse(moving_box()));
  const std::string bytes = text("checkpoint");
  const std::size_t head = std::string("dartboard checkpoint\n").size();
  const auto with = [&bytes](std::size_t at, char byte) {
    std::string changed = bytes;
    changed[at] = byte;
    return changed;
  };
  write("checkpoint", "{\"name\": \"a scene\"}");
  EXPECT_EQ(after_here(complaint()),
            "IoError checkpoint: is no checkpoint; expected a file that a run of dartboard left");
  write("checkpoint", with(head, 1));  // the lowest byte of the order is 4
  EXPECT_EQ(after_here(complaint()),
            "IoError checkpoint: was written by a processor with another order of bytes; expected one of ours");
  write("checkpoint", with(head + 4, 77));
  EXPECT_EQ(after_here(complaint()), "IoError checkpoint: is of format 77; expected 22, which this program reads");
}

TEST_F(CheckpointTest, ThatIsNotThereOrNoFileIsAnIoError) {
  EXPECT_EQ(after_here(complaint()), "IoError checkpoint: there is no such file; expected the checkpoint of a run");
  std::filesystem::create_directory(file());
  EXPECT_EQ(after_here(complaint()), "IoError checkpoint: cannot be read; expected the checkpoint of a run");
}

// A whole file of a body with other columns than the scene makes.
TEST_F(CheckpointTest, OfAnotherBodyIsRefused) {
  leave(parse(moving_box()));
  Checkpoint checkpoint(file());
  Simulation other(parse(with_events(moving_box(), R"([{"at": 0.002, "remove": {"ids": [3]}}])")));
  EXPECT_THROW(checkpoint.load_into(other), IoError);
}

TEST_F(CheckpointTest, OfAMeshFileIsGoneOnWith) {
  write_mesh_file(0.125);
  write("scene.json", scene_on_mesh());
  leave(read_scene(folder_ / "scene.json"));
  EXPECT_EQ(complaint(), "accepted");
}

TEST_F(CheckpointTest, OfASceneThatHasChangedSinceIsRefused) {
  write_mesh_file(0.125);
  write("scene.json", scene_on_mesh());
  leave(read_scene(folder_ / "scene.json"));
  write("scene.json", scene_on_mesh() + "\n");  // the same content
  EXPECT_EQ(complaint(), "accepted");
  write("scene.json", changed("duration", 9.0));  // and with a longer duration
  EXPECT_EQ(complaint(), "accepted");
  EXPECT_EQ(Checkpoint(file()).scene().duration, 9.0);
  write("scene.json", changed("duration", 1e-3));
  EXPECT_NE(complaint().find("has changed since"), std::string::npos) << complaint();
  write("scene.json", changed("name", "another"));
  EXPECT_NE(after_here(complaint()).find("InputError scene.json: has changed since the run in"), std::string::npos)
      << complaint();
  // but not one that is gone: the checkpoint has a copy
  std::filesystem::remove(folder_ / "scene.json");
  EXPECT_EQ(complaint(), "accepted");
}

TEST_F(CheckpointTest, OfAMeshThatHasChangedSinceIsRefused) {
  write_mesh_file(0.125);
  write("scene.json", scene_on_mesh());
  leave(read_scene(folder_ / "scene.json"));
  std::filesystem::remove(folder_ / "box.mesh");
  write_mesh_file(0.126);
  EXPECT_NE(after_here(complaint()).find("InputError box.mesh: is another mesh than when the run in"),
            std::string::npos)
      << complaint();
  std::filesystem::remove(folder_ / "box.mesh");
  EXPECT_NE(complaint().find("box.mesh"), std::string::npos) << complaint();
}

}  // namespace
}  // namespace dartboard::checkpoint_test
