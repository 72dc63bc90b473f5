#include "benchmarks/pages/recorded_frames.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>
#include <vector>

#include "core/meshes/text/base64.h"
#include "tests/support/moving_box.h"

namespace dartboard::recorded_frames_test {
namespace {

using moving::Json;
using moving::moving_box;

constexpr std::size_t enough = 10'000'000;

Json recorded(const Json& json, std::size_t most_bytes = enough) {
  const SceneFile scene = moving::parse(json);
  Simulation simulation(scene);
  RecordedFrames frames(simulation, even_steps(simulation.step_count(), 120), scene);
  while (simulation.steps_done() < simulation.step_count()) {
    EXPECT_FALSE(simulation.advance());
    frames.stepped(simulation);
  }
  frames.ended(simulation);
  return frames.json(most_bytes);
}

template <class T>
std::vector<T> column(const Json& text) {
  const std::string bytes = decode_base64(text.get<std::string>()).value();
  std::vector<T> numbers(bytes.size() / sizeof(T));
  std::memcpy(numbers.data(), bytes.data(), bytes.size());
  return numbers;
}

Json cut_box() {
  return moving::with_events(
      moving_box(), R"([{"at": 0.005, "dissociate": {"plane": {"point": [0.125, 0, 0], "normal": [1, 0, 0]}}}])");
}

TEST(RecordedFrames, HaveThePlacesOfTheirPointsToASixtyFiveThousandthOfTheReach) {
  const Json run = recorded(moving_box());
  Simulation simulation(moving::parse(moving_box()));
  moving::run(simulation);
  const Frame end = simulation.frame();
  ASSERT_EQ(run["frames"].size(), 11u);
  const auto number = column<std::int32_t>(run["shapes"][0]["number"]);
  const auto places = column<std::uint16_t>(run["frames"][10]["places"]);
  // one of the 27 points is inside, and not seen
  ASSERT_EQ(number.size(), 26u);
  ASSERT_EQ(places.size(), 3 * number.size());
  for (std::size_t k = 0; k < number.size(); ++k)
    for (int axis = 0; axis < 3; ++axis) {
      const double size = run["size"][static_cast<std::size_t>(axis)];
      const double low = run["low"][static_cast<std::size_t>(axis)];
      EXPECT_NEAR(low + size * places[3 * k + static_cast<std::size_t>(axis)] / 65535.0,
                  end.mesh.points[static_cast<std::size_t>(number[k])][axis], size / 65535.0);
    }
}

TEST(RecordedFrames, OfABodyThatIsCutHaveAnotherShapeFromThenOn) {
  const Json run = recorded(cut_box());
  ASSERT_EQ(run["shapes"].size(), 2u);
  const auto ones = [&run](std::size_t shape) {
    const auto flags = column<std::uint8_t>(run["shapes"][shape]["was_inside"]);
    return std::accumulate(flags.begin(), flags.end(), 0);
  };
  EXPECT_EQ(ones(0), 0);
  EXPECT_EQ(ones(1), 16) << "both sides of two triangles for each of four squares";
  for (std::size_t k = 0; k < 11; ++k) EXPECT_EQ(run["frames"][k]["shape"], k < 5 ? 0 : 1) << k;
  // the cut divides the nine vertices in its plane, of which one had been inside
  EXPECT_EQ(run["shapes"][0]["points"], 26);
  EXPECT_EQ(run["shapes"][1]["points"], 36);
}

TEST(RecordedFrames, AreFewerWhereTheyWouldTakeTooMuchAndTheLastStays) {
  const Json all = recorded(moving_box()), few = recorded(moving_box(), 2000), none = recorded(moving_box(), 1);
  EXPECT_EQ(all["frames"].size(), 11u);
  ASSERT_LT(few["frames"].size(), 11u);
  ASSERT_GE(few["frames"].size(), 3u);
  EXPECT_EQ(few["taken"], 11);
  EXPECT_EQ(few["frames"].back()["time"], all["frames"].back()["time"]);
  EXPECT_EQ(none["frames"].size(), 2u);
  // curves have a value for each all the same
  EXPECT_EQ(none["curves"][0]["times"].size(), 11u);
}

TEST(RecordedFrames, HaveValuesAsSharesOfTheLargest) {
  const Json run = recorded(moving_box());
  ASSERT_EQ(run["quantities"][0]["name"], "speed");
  EXPECT_EQ(run["quantities"][0]["unit"], "m/s");
  Simulation simulation(moving::parse(moving_box()));
  const Frame first = simulation.frame();
  const double largest = run["quantities"][0]["largest"];
  const auto number = column<std::int32_t>(run["shapes"][0]["number"]);
  const auto shares = column<std::uint8_t>(run["frames"][0]["values"]["speed"]);
  for (std::size_t k = 0; k < number.size(); ++k)
    EXPECT_NEAR((shares[k] - 1) / 254.0 * largest, first.velocity[static_cast<std::size_t>(number[k])].norm(),
                largest / 254.0);
  EXPECT_FALSE(run["frames"][0]["values"].contains("contact force")) << "the scene has no contact";
}

TEST(RecordedFrames, HaveTheForcesFromOutsideWhereTheyAct) {
  Json scene = moving_box();
  scene["forces"] =
      Json::parse(R"([{"box": {"min": [-9, -9, -9], "max": [9, 9, 9]}, "force": [0, 3, 0], "until": 0.005}])");
  const Json run = recorded(scene);
  const auto loads = column<float>(run["frames"][0]["loads"]);
  ASSERT_EQ(loads.size(), 6 * 27u) << "a place and a force for each point, the one inside too";
  double sum = 0.0;
  for (std::size_t k = 4; k < loads.size(); k += 6) sum += double{loads[k]};
  EXPECT_NEAR(sum, 3.0, 3.0 * 0x1p-23);
  EXPECT_EQ(run["frames"][10]["loads"], "");
}

// Of a cube of a quarter of a metre at rest.
Eigen::Vector3d sum_of_loads(const char* key, const char* value) {
  Json scene = moving_box();
  scene.erase("initial_velocity");
  scene[key] = Json::parse(value);
  const auto loads = column<float>(recorded(scene)["frames"][0]["loads"]);
  Eigen::Vector3d sum(0, 0, 0);
  for (std::size_t k = 0; k < loads.size(); k += 6) sum += Eigen::Vector3f(&loads[k + 3]).cast<double>();
  return sum;
}

TEST(RecordedFrames, HavePressuresThatFollowTheirFacesAndWind) {
  EXPECT_LT((sum_of_loads("forces", R"([{"plane": {"point": [0.24, 0, 0], "normal": [1, 0, 0]}, "pressure": 80,
                                         "normals": "current"}])") -
             Eigen::Vector3d(-5, 0, 0))
                .norm(),
            1e-5)
      << "80 Pa on a sixteenth of a square metre, inwards";
  EXPECT_LT((sum_of_loads("air", R"({"drag": 2, "velocity": [3, 0, 0]})") - Eigen::Vector3d(0.75, 0, 0)).norm(), 1e-6)
      << "two faces across the wind";
}

TEST(RecordedFrames, OfAChainHaveTheMeanTensionOfTheLinksAtEachPoint) {
  const Json run = recorded(Json::parse(R"({"name": "chain", "step": 0.001, "duration": 0.01,
    "body": {"generate": {"chain": {"links": 4, "spacing": 0.1}}},
    "material": {"density": 1, "stiffness": 10}, "gravity": [9.81, 0, 0], "fixed": [{"ids": [0]}]})"));
  EXPECT_EQ(run["quantities"][1]["unit"], "N");
  EXPECT_EQ(column<std::uint16_t>(run["shapes"][0]["links"]).size(), 8u);
  const auto first = column<std::uint8_t>(run["frames"][0]["values"]["stress"]);
  const auto last = column<std::uint8_t>(run["frames"].back()["values"]["stress"]);
  EXPECT_EQ(first, std::vector<std::uint8_t>(5, 1)) << "nothing has stretched";
  EXPECT_EQ(last[0], 255) << "the uppermost link carries most";
  EXPECT_GT(last[0], last[1]);
}

}  // namespace
}  // namespace dartboard::recorded_frames_test
