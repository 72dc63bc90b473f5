// Surfaces of STL, OBJ, PLY and OFF.

#include <gtest/gtest.h>

#include "tests/support/meshes/binary_mesh_samples.h"
#include "tests/support/meshes/mesh_samples.h"

namespace dartboard::surfaces_test {
namespace {

using namespace samples;

LoadedMesh expect_square(std::string_view text, MeshFormat format) {
  const LoadedMesh loaded = parse_mesh(text, format, "file");
  EXPECT_EQ(loaded.mesh.kinds, (std::vector{CellKind::triangle, CellKind::triangle}));
  EXPECT_EQ(loaded.mesh.nodes, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(loaded.mesh.points, (std::vector<Eigen::Vector3d>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  return loaded;
}

// ---- STL

TEST(Stl, MakesEqualCornersOnePointWhateverTheirSignOfZero) {
  EXPECT_EQ(expect_square(stl_text, MeshFormat::stl).format, "STL");
  EXPECT_EQ(expect_square(stl_binary(), MeshFormat::stl).format, "STL binary");
}

TEST(Stl, KeepsCornersApartThatDifferInTheLastBit) {
  const std::string text = with(stl_text, "vertex 0 -0.0 0", "vertex 0 4.9406564584124654e-324 0");
  EXPECT_EQ(parse_mesh(text, MeshFormat::stl, "file").mesh.points.size(), 5u);
}

TEST(Stl, NumbersItsSolidsAndKeepsTheirNames) {
  const auto tags = parse_mesh(stl_text, MeshFormat::stl, "file").tags.at(0);
  EXPECT_EQ(tags.name, "solid");
  EXPECT_EQ(tags.values, (std::vector<std::int32_t>{1, 2}));
  EXPECT_EQ(tags.names.at(1), "lower half");
}

TEST(Stl, RefusesAnotherNumberOfFacetsThanThereIsRoomFor) {
  std::string more = stl_binary();
  more.replace(0, 5, "other");
  more[80] = 3;
  EXPECT_EQ(refusal(more, MeshFormat::stl), "file: byte 80: 3 facets in 100 bytes; expected 50 bytes for each");
  more[83] = '\x7f';
  expect_part(refusal(more, MeshFormat::stl), " facets in 100 bytes");
}

TEST(Stl, RefusesACornerThatIsNotFinite) {
  std::string text = stl_binary();
  text.replace(84 + 12, 4, bytes_of<float>({std::numeric_limits<float>::infinity()}));
  EXPECT_EQ(refusal(text, MeshFormat::stl), "file: byte 96: inf is not finite; expected a coordinate of facet 0");
  expect_part(refusal(with(stl_text, "vertex 1 0 0", "vertex nan 0 0"), MeshFormat::stl),
              "file:5: 'nan' is not finite");
}

TEST(Stl, RefusesAFileThatEndsWithinASolid) {
  expect_part(refusal(stl_text.substr(0, stl_text.size() - 9), MeshFormat::stl),
              "the text ends here; expected facet or");
}

// ---- OBJ

TEST(Obj, CountsCornersFromTheFirstPointOrBackFromTheLast) {
  const auto loaded = expect_square(obj, MeshFormat::obj);
  EXPECT_EQ(loaded.notices, (std::vector<std::string>{"skipped 1 edge: the body is made of its 2 polygons"}));
}

TEST(Obj, KeepsGroupsAndMaterialsByName) {
  const auto tags = parse_mesh(obj, MeshFormat::obj, "file").tags;
  ASSERT_EQ(tags.size(), 2u);
  EXPECT_EQ(tags[0].names.at(tags[0].values.at(1)), "left side");
  EXPECT_EQ(tags[1].names.at(tags[1].values.at(0)), "wood");
  EXPECT_EQ(tags[1].names.at(tags[1].values.at(1)), "steel");
}

TEST(Obj, RefusesCornersThatAreNoPoints) {
  expect_part(refusal(with(obj, "f -4", "f -5"), MeshFormat::obj), "file:13: corner -5; expected at least -4");
  expect_part(refusal(with(obj, "f 1/1/1", "f 0/1/1"), MeshFormat::obj), "file:11: '0/1/1' is no corner");
  expect_part(refusal(with(obj, "f 1/1/1", "f 9/1/1"), MeshFormat::obj), "file:11: a triangle has the point 9");
}

TEST(Obj, RefusesPolygonsOfFiveCorners) {
  const std::string text = with(obj, "f -4 \\\n  -2 -1", "f 1 2 3 4 4");
  EXPECT_EQ(refusal(text, MeshFormat::obj),
            "file:13: cell 1 is a polygon of 5 corners; expected triangles and quadrilaterals: split larger polygons");
}

TEST(Obj, RefusesWhatIsNoLineOfIt) {
  expect_part(refusal(with(obj, "vn 0", "bn 0"), MeshFormat::obj), "file:7: found 'bn'");
}

// ---- PLY

TEST(Ply, ReadsTextAndBytesOfEitherOrderPassingOverOtherProperties) {
  EXPECT_EQ(expect_square(ply_text, MeshFormat::ply).format, "PLY");
  EXPECT_EQ(expect_square(ply_binary(false), MeshFormat::ply).format, "PLY binary_little");
  EXPECT_EQ(expect_square(ply_binary(true), MeshFormat::ply).format, "PLY binary_big");
}

TEST(Ply, RefusesMoreElementsThanTheFileHolds) {
  for (const auto& text : {std::string(ply_text), ply_binary(false)}) {
    expect_part(refusal(with(text, "element vertex 4", "element vertex 1000000000000000000"), MeshFormat::ply),
                "expected");
    expect_part(refusal(with(text, "element face 2", "element face 1000000000000000000"), MeshFormat::ply), "expected");
  }
  expect_part(refusal(with(ply_text, "element face 2", "element face 1"), MeshFormat::ply),
              "expected as many elements");
  expect_part(refusal(ply_binary(true) + "x", MeshFormat::ply), "'x' follows the last element");
}

TEST(Ply, RefusesAListLongerThanTheFile) {
  std::string text = ply_binary(false);
  text[text.size() - 14] = '\xff', text[text.size() - 13] = '\xff';
  expect_part(refusal(text, MeshFormat::ply), " bytes are left; expected a corner of face 1");
}

TEST(Ply, RefusesVerticesWithoutOnePropertyForEachCoordinate) {
  for (const auto& [axis, other] : {std::pair{"float y", "float w"},
                                    {"float x", "float w"},
                                    {"float y", "float x"},
                                    {"float z", "float x"},
                                    {"float z", "list uchar float z"}})
    expect_part(refusal(with(ply_text, axis, other), MeshFormat::ply), "vertices without one property each");
}

// ---- OFF

TEST(Off, ReadsPointsAndPolygonsPassingOverColours) { expect_square(off, MeshFormat::off); }

TEST(Off, ReadsBytesWithWhatEachWordSaysOfPoints) {
  EXPECT_EQ(expect_square(off_binary(), MeshFormat::off).format, "OFF binary");
  expect_square(off_binary("OFF"), MeshFormat::off);
  expect_square(off_binary("OFF") + "\n", MeshFormat::off);
}

TEST(Off, ReadsBytesOfPointsInThePlane) {
  const std::string text = "nOFF BINARY\n" + bytes_of(std::vector<std::int32_t>{2, 3, 1, 0}, true) +
                           bytes_of(std::vector<float>{0, 0, 1, 0, 0, 1}, true) +
                           bytes_of(std::vector<std::int32_t>{3, 0, 1, 2, 0}, true);
  const LoadedMesh loaded = parse_mesh(text, MeshFormat::off, "file");
  EXPECT_EQ(loaded.mesh.points, (std::vector<Eigen::Vector3d>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(loaded.notices, (std::vector<std::string>{"put 3 points of two coordinates in the plane z = 0"}));
}

TEST(Off, RefusesBytesThatAreTooFewOrTooMany) {
  const std::string text = off_binary("OFF");
  const auto put = [&text](std::size_t at, std::vector<std::int32_t> value) {
    std::string bad = text;
    return bad.replace(11 + at, 4, bytes_of(value, true));
  };
  expect_part(refusal(text.substr(0, text.size() - 1), MeshFormat::off), "expected the colour of a polygon");
  expect_part(refusal(text + "x", MeshFormat::off), "'x' follows the last polygon");
  expect_part(refusal(put(0, {5}), MeshFormat::off), "expected");
  expect_part(refusal(put(0, {0x7fffffff}), MeshFormat::off), "bytes are left; expected a coordinate of point");
  expect_part(refusal(put(4, {3}), MeshFormat::off), "0 bytes are left; expected the number of corners of polygon 2");
  expect_part(refusal(put(60, {-3}), MeshFormat::off), "-3 is negative; expected the number of corners of polygon 0");
  expect_part(refusal(put(60 + 12, {4}), MeshFormat::off), "a triangle has the point 4");
  expect_part(refusal(put(12, {0x7f800000}), MeshFormat::off), "file: byte 23: inf is not finite");
}

TEST(Off, RefusesMoreOrFewerPolygonsThanAnnounced) {
  expect_part(refusal(with(off, "4 2 0", "4 1 0"), MeshFormat::off), "file:9: '3' follows the last polygon");
  expect_part(refusal(with(off, "4 2 0", "4 3 0"), MeshFormat::off), "the text ends here");
  expect_part(refusal(with(off, "3 0 2 3", "3 0 2 4"), MeshFormat::off), "file:9: a triangle has the point 4");
}

}  // namespace
}  // namespace dartboard::surfaces_test
