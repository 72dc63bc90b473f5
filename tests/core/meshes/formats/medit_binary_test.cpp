#include <gtest/gtest.h>

#include <limits>

#include "tests/support/meshes/mesh_samples.h"
#include "tests/support/meshes/meshb_samples.h"

namespace dartboard::medit_binary_test {
namespace {

using namespace samples;

LoadedMesh parse(std::string_view text) { return parse_mesh(text, MeshFormat::medit, "file"); }
std::string refused(std::string_view text) { return refusal(text, MeshFormat::medit); }

/// A mesh of a single section after the vertices of a unit tetrahedron.
std::string with_section(std::int32_t code, std::int64_t count, const std::vector<std::int64_t>& values) {
  MeshbWriter file(2, false);
  file.section(4, file.integers({4}) + file.reals({0, 0, 0}) + file.integers({0}) + file.reals({1, 0, 0}) +
                      file.integers({0}) + file.reals({0, 1, 0}) + file.integers({0}) + file.reals({0, 0, 1}) +
                      file.integers({0}));
  file.lines(code, count, values);
  return file.finish();
}

TEST(MeditBinary, ReadsToTheSameBitsInEveryVersionAndByteOrder) {
  for (const int version : {1, 2, 3, 4})
    for (const bool big_endian : {false, true}) {
      SCOPED_TRACE(std::to_string(version) + (big_endian ? " big-endian" : ""));
      const LoadedMesh loaded = parse(meshb(version, big_endian));
      expect_two_tetrahedra(loaded);
      EXPECT_EQ(loaded.format, "Medit " + std::to_string(version) + " binary");
      EXPECT_EQ(loaded.notices,
                (std::vector<std::string>{"skipped the section of code 13: only points and cells are read",
                                          "skipped 1 triangle, 1 edge: the body is made of its 2 volumes"}));
      ASSERT_EQ(loaded.tags.size(), 1u);
      EXPECT_EQ(loaded.tags[0].values, (std::vector<std::int32_t>{7, -3}));
    }
}

TEST(MeditBinary, ReadsASurfaceInThePlaneWithZeroHeight) {
  MeshbWriter file(1, false);
  std::string text = file.finish();
  text[file.finish().size() - 12] = 2;  // the dimension, before the section End
  text.resize(text.size() - 8);
  const auto add = [&](std::int32_t code, const std::string& content) {
    text += file.word(code) + file.place(text.size() + 8 + content.size()) + content;
  };
  add(4, file.integers({3}) + file.reals({0, 0}) + file.integers({1}) + file.reals({1, 0}) + file.integers({1}) +
             file.reals({0, 1}) + file.integers({1}));
  add(6, file.integers({1, 1, 2, 3, 5}));
  const LoadedMesh loaded = parse(text + file.word(54) + file.place(0));
  EXPECT_EQ(loaded.mesh.points, (std::vector<Eigen::Vector3d>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(loaded.mesh.kinds, std::vector{CellKind::triangle});
}

// A file of version 2 may state that its real numbers have 32 bits nevertheless.
TEST(MeditBinary, ReadsRealNumbersOfTheSizeThatTheFileNames) {
  MeshbWriter file(2, false);
  file.section(155, file.integers({32}));
  std::string vertices = file.integers({4});
  for (const std::vector<float>& x : {std::vector<float>{0, 0, 0}, std::vector<float>{1, 0, 0},
                                      std::vector<float>{0, 1, 0}, std::vector<float>{0, 0, 1}})
    vertices += bytes_of(x) + file.integers({0});
  file.section(4, vertices);
  file.lines(8, 1, {1, 2, 3, 4, 0});
  EXPECT_DOUBLE_EQ(signed_measure(parse(file.finish()).mesh, 0), 1.0 / 6.0);
}

TEST(MeditBinary, TakesCellsOfSecondOrderByTheirCorners) {
  const LoadedMesh loaded = parse(with_section(30, 1, {1, 2, 3, 4, 1, 1, 1, 1, 1, 1, 0}));
  EXPECT_EQ(loaded.mesh.nodes, (std::vector<std::uint32_t>{0, 1, 2, 3}));
  EXPECT_EQ(loaded.notices,
            (std::vector<std::string>{"took 1 10-node tetrahedron by their corners: edges of a body are straight"}));
}

TEST(MeditBinary, NamesTheCodesOfSectionsThatWereSkipped) {
  MeshbWriter file(2, false);
  file.section(4, file.integers({3}) + file.reals({0, 0, 0}) + file.integers({0}) + file.reals({1, 0, 0}) +
                      file.integers({0}) + file.reals({0, 1, 0}) + file.integers({0}));
  for (const std::int32_t code : {14, 120, 62, 14}) file.lines(code, 1, {1, 1, 1, 1});
  file.lines(6, 1, {1, 2, 3, 0});
  EXPECT_EQ(parse(file.finish()).notices,
            (std::vector<std::string>{
                "skipped the sections of code 14, of code 120, of code 62: only points and cells are read"}));
}

TEST(MeditBinary, RefusesASectionThatMayHoldCellsInsteadOfLosingThem) {
  for (const std::int32_t code : {1, 46, 47, 88, 91, 96, 103, 200, 203, 208, 241})
    expect_part(refused(with_section(code, 1, {1, 2, 3, 4, 0})),
                "section " + std::to_string(code) + " is not one of a mesh that can be held");
}

TEST(MeditBinary, RefusesCountsThatDoNotFillTheirSections) {
  for (const std::int64_t count : {std::int64_t{1}, std::int64_t{3}, std::int64_t{1} << 60, std::int64_t{-1}}) {
    MeshbWriter file(4, false);
    file.lines(8, count, {1, 2, 3, 4, 7, 2, 3, 4, 5, -3});
    expect_part(refused(file.finish()),
                count < 0 ? "-1 is negative" : "Tetrahedra has " + std::to_string(count) + " lines");
  }
  MeshbWriter file(2, false);
  file.section(4, file.integers({5}) + file.reals({0, 0, 0}) + file.integers({0}));
  EXPECT_EQ(refused(file.finish()), "file: byte 28: Vertices has 5 lines in 28 bytes; expected 28 bytes for each");
}

TEST(MeditBinary, RefusesPlacesThatGoBackOrBeyondTheFile) {
  const std::string text = meshb(3);
  // the first section, Dimension, has 24 bytes before it ends
  for (const auto& [place, says] : {std::pair{std::int64_t{0}, "next one at byte 0"},
                                    {16, "next one at byte 16"},
                                    {1 << 20, "next one at byte 1048576"},
                                    {25, "section 3 ends at byte 24; expected 25"}}) {
    std::string bad = text;
    bad.replace(12, 8, bytes_of<std::int64_t>({place}));
    expect_part(refused(bad), says);
  }
  expect_part(refused(text.substr(0, text.size() - 12)), "0 bytes are left; expected the code of a section");
  expect_part(refused(text.substr(0, text.size() - 13)), " has the next one at byte ");
}

TEST(MeditBinary, RefusesOtherVersionsAndDimensions) {
  for (const auto& [at, value, says] : {std::tuple{4u, '\5', "byte 4: version 5; expected version 1, 2, 3 or 4"},
                                        {8u, '\4', "the first section is 4; expected 3, the dimension"},
                                        {16u, '\4', "byte 16: dimension 4; expected dimension 2 or 3"}}) {
    std::string bad = meshb(2);
    bad[at] = value;
    expect_part(refused(bad), says);
  }
}

TEST(MeditBinary, NamesTheByteOfACoordinateThatIsNotFinite) {
  std::string bad = meshb(2);
  bad.replace(32, 8, bytes_of<double>({std::numeric_limits<double>::quiet_NaN()}));
  EXPECT_EQ(refused(bad), "file: byte 32: nan is not finite; expected a coordinate of vertex 1");
}

TEST(MeditBinary, RefusesPointsThatAreNotThereOrTwiceInACell) {
  expect_part(refused(with_section(8, 1, {1, 2, 3, 5, 0})), "a tetrahedron has the point 5; expected one of the 4");
  expect_part(refused(with_section(8, 1, {1, 2, 3, 0, 0})), "a tetrahedron has the point 0; expected one of the 4");
  expect_part(refused(with_section(8, 1, {1, 2, 3, 3, 0})), "has the point 2 twice");
  MeshbWriter twice(2, false);
  twice.lines(4, 0, {});
  twice.lines(4, 0, {});
  expect_part(refused(twice.finish()), "found Vertices again");
}

}  // namespace
}  // namespace dartboard::medit_binary_test
