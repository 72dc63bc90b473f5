#include "benchmarks/figures/film.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "benchmarks/figures/album.h"
#include "tests/support/folder_for_tests.h"
#include "tests/support/moving_box.h"

namespace dartboard::film_test {
namespace {

using moving::Json;
using moving::moving_box;

std::vector<BodyPanel> film_of(const Json& scene, std::uint64_t steps) {
  Simulation simulation(moving::parse(scene));
  Album film(simulation, even_steps(steps, most_film_pictures), {});
  for (std::uint64_t k = 0; k < steps; ++k) {
    EXPECT_FALSE(simulation.advance());
    film.stepped(simulation);
  }
  film.ended(simulation);
  return film.pictures();
}

TEST(Film, OfFewStepsHasAFrameOfEach) {
  const auto film = film_of(moving_box(), 10);
  ASSERT_EQ(film.size(), 11u);
  for (std::size_t k = 0; k < 11; ++k) EXPECT_DOUBLE_EQ(film[k].time, 0.001 * static_cast<double>(k));
}

// 300 steps in 120 parts: every part is two or three steps
TEST(Film, OfManyStepsHasAHundredAndTwentyFramesAfterTheFirstAndTheLastIsTheEnd) {
  Json scene = moving_box();
  scene["duration"] = 0.3;
  const auto film = film_of(scene, 300);
  ASSERT_EQ(film.size(), 121u);
  EXPECT_EQ(film.front().time, 0.0);
  EXPECT_DOUBLE_EQ(film.back().time, 0.3);
  for (std::size_t k = 1; k < film.size(); ++k) {
    const double apart = film[k].time - film[k - 1].time;
    EXPECT_TRUE(apart > 0.0015 && apart < 0.0035) << k;
  }
}

TEST(Film, EndsWithTheLastGoodStateOfAMotionThatDiverges) {
  Json scene = moving_box();
  scene["step"] = 0.2;  // beyond the stable one: the second step diverges
  scene["duration"] = 20;
  Simulation simulation(moving::parse(scene));
  Album film(simulation, even_steps(100, most_film_pictures), {});
  while (!simulation.advance()) film.stepped(simulation);
  ASSERT_GT(film.pictures().back().time, simulation.time());  // the simulation was taken back
  film.ended(simulation);
  EXPECT_EQ(film.pictures().back().time, simulation.time());
}

std::vector<double> times_of(const std::vector<std::uint64_t>& steps, int taken) {
  Simulation simulation(moving::parse(moving_box()));
  Album album(simulation, steps, {});
  for (int k = 0; k < taken; ++k) {
    EXPECT_FALSE(simulation.advance());
    album.stepped(simulation);
  }
  album.ended(simulation);
  std::vector<double> times;
  for (const BodyPanel& panel : album.pictures()) times.push_back(panel.time);
  return times;
}

TEST(Album, OfThreePicturesHasTheFirstStepsAfterEachThirdOfTheRun) {
  EXPECT_EQ(times_of(even_steps(10, 3), 10), (std::vector{0.0, 0.004, 0.007, 0.01}));
}

TEST(Album, HasTheStepsAskedForAndTheLastOfARunThatEndsBeforeThem) {
  EXPECT_EQ(times_of({2, 5}, 10), (std::vector{0.002, 0.005}));
  EXPECT_EQ(times_of({2, 5}, 4), (std::vector{0.002, 0.004}));
  EXPECT_EQ(times_of({0, 5}, 5), (std::vector{0.0, 0.005}));
}

/// Data of a GIF file (specification, version 89a): the delay before each picture in hundredths of a second.
struct Gif {
  int width = 0, height = 0, pictures = 0;
  std::vector<int> delays{};
  bool ends = false;
};

Gif read_gif(const std::string& bytes) {
  const auto byte = [&bytes](std::size_t at) { return static_cast<int>(static_cast<unsigned char>(bytes.at(at))); };
  const auto word = [&byte](std::size_t at) { return byte(at) + 256 * byte(at + 1); };
  const auto colours = [](int flags) { return (flags & 0x80) != 0 ? 3u << ((flags & 7) + 1) : 0u; };
  EXPECT_EQ(bytes.substr(0, 6), "GIF89a");
  Gif gif;
  gif.width = word(6);
  gif.height = word(8);
  std::size_t at = 13 + colours(byte(10));
  while (byte(at) != 0x3B) {
    if (byte(at) == 0x21) {
      if (byte(at + 1) == 0xF9) gif.delays.push_back(word(at + 4));
      at += 2;
    } else {
      EXPECT_EQ(byte(at), 0x2C);
      ++gif.pictures;
      at += 11 + colours(byte(at + 9));  // and the minimal code size
    }
    while (byte(at) != 0) at += 1 + static_cast<std::size_t>(byte(at));
    ++at;
  }
  gif.ends = at + 1 == bytes.size();
  return gif;
}

class FilmFiles : public FolderTest {};

// 11 frames of a motion of 0.01 s, shown for 4 s: 400 / 11 = 36 hundredths each
TEST_F(FilmFiles, AreAGifOfAllFramesThatLastsFourSecondsAtLeast) {
  const auto film = film_of(moving_box(), 10);
  ASSERT_EQ(draw_film(film, {}, "box", folder_, "film"), "");
  const Gif gif = read_gif(text("film.gif"));
  EXPECT_TRUE(gif.ends);
  EXPECT_EQ(gif.pictures, 11);
  EXPECT_EQ(gif.delays, std::vector<int>(11, 36));
  EXPECT_TRUE(gif.width >= 320 && gif.width <= 640 && gif.height <= 560) << gif.width << " x " << gif.height;
}

TEST_F(FilmFiles, OfABodyOfWhichNothingIsLeftSaySo) {
  Json scene = moving::with_events(moving_box(),
                                   R"([{"at": 0.002, "remove": {"box": {"min": [-9, -9, -9], "max": [9, 9, 9]}}}])");
  const auto film = film_of(scene, 4);
  ASSERT_EQ(draw_film(film, {}, "box", folder_, "film"), "");
  EXPECT_EQ(read_gif(text("film.gif")).pictures, 5);
  ASSERT_NE(draw_film(film, {}, "box", folder_, "film", "false"), "");  // the script remains
  const std::string script = text("film.gnuplot");
  std::size_t empty = 0;
  for (auto at = script.find("nothing left"); at != std::string::npos; at = script.find("nothing left", at + 1))
    ++empty;
  EXPECT_EQ(empty, 3u);
}

TEST_F(FilmFiles, ShowEachFrameFromItsOwnData) {
  const auto film = film_of(moving_box(), 3);
  ASSERT_NE(draw_film(film, {}, "box", folder_, "film", "false"), "");
  const std::string script = text("film.gnuplot");
  std::size_t at = 0;
  for (const char* plotted : {"film.dat' index 0 ", "film.dat' index 1 ", "film.dat' index 2 ", "film.dat' index 3 "}) {
    at = script.find(plotted, at);
    EXPECT_NE(at, std::string::npos) << plotted;
  }
}

TEST_F(FilmFiles, AreOneFileOnceTheyAreDrawn) {
  const auto film = film_of(moving_box(), 3);
  ASSERT_EQ(draw_film(film, {}, "box", folder_, "film"), "");
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) EXPECT_EQ(entry.path().filename(), "film.gif");
}

TEST_F(FilmFiles, AreNotDrawnWithoutGnuplotAndTheReasonIsTold) {
  const auto film = film_of(moving_box(), 1);
  EXPECT_NE(draw_film(film, {}, "box", folder_, "film", "no-such-program").find("no-such-program"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "film.dat"));
}

}  // namespace
}  // namespace dartboard::film_test
