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

constexpr std::string_view square_of_ply = R"(ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
)";
constexpr std::string_view corners_of_square = "end_header 0 0 0 1 0 0 1 1 0 0 1 0 ";

std::string ply_of(std::string_view elements, std::string_view values) {
  return std::string(square_of_ply) + std::string(elements) + std::string(corners_of_square) + std::string(values);
}

TEST(Ply, TakesCornersFromTheOnlyListOfIntegersWhateverItsName) {
  for (const char* name : {"vertex_ids", "v", "vertex_index"})
    expect_square(
        ply_of(std::string("element face 2 property list uchar int ") + name + " property list uchar float texcoord ",
               "3 0 1 2 0  3 0 2 3 2 0.5 0.5"),
        MeshFormat::ply);
}

TEST(Ply, TakesAmongSeveralListsOfIntegersTheOneOfAUsualName) {
  const std::string_view faces = "element face 2 property list uchar int first property list uchar int ";
  const std::string_view values = "1 3 3 0 1 2  2 0 1 3 0 2 3";
  expect_square(ply_of(std::string(faces) + "vertex_indices ", values), MeshFormat::ply);
  expect_part(
      refusal(ply_of(std::string(faces) + "second ", values), MeshFormat::ply),
      "elements 'face' with 2 lists of integers; expected one with the numbers of points, or several of which one "
      "is named vertex_indices or vertex_index");
  expect_part(refusal(ply_of("element face 1 property int a ", "1"), MeshFormat::ply),
              "elements 'face' with 0 lists of integers");
}

// The square by the points 0 1 2 3 0: of the strip 1 2 0 3 its second triangle is turned.
TEST(Ply, ReadsStripsThatEndByMinusOne) {
  const auto triangles = [](std::string_view strips, std::string_view elements) {
    return parse_mesh(ply_of(elements, strips), MeshFormat::ply, "file").mesh.nodes;
  };
  const std::string_view one = "element tristrips 1 property list int int vertex_indices ";
  EXPECT_EQ(triangles("4 1 2 0 3", one), (std::vector<std::uint32_t>{1, 2, 0, 0, 2, 3}));
  EXPECT_EQ(triangles("8 0 1 2 -1 0 2 3 -1", one), (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(triangles("7 0 1 2 -1 0 2 3", one), (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(triangles("3 0 1 2 3 0 2 3", "element tristrips 2 property list int int vertex_indices "),
            (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
  // next to faces, in the order of the header
  EXPECT_EQ(triangles("3 0 1 2  3 0 2 3",
                      "element face 1 property list uchar int vertex_indices "
                      "element tristrips 1 property list int int vertex_indices "),
            (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
}

// The third point is twice in the strip 0 1 2 2 3 0 for the triangles 0 1 2 and 2 3 0 to become one strip.
TEST(Ply, LeavesOutTheTrianglesWithoutAreaThatJoinStrips) {
  const std::string text = ply_of("element tristrips 1 property list int int vertex_indices ", "6 0 1 2 2 3 0");
  EXPECT_EQ(parse_mesh(text, MeshFormat::ply, "file").mesh.nodes, (std::vector<std::uint32_t>{0, 1, 2, 3, 2, 0}));
}

TEST(Ply, RefusesStripsThatAreTooShort) {
  const std::string_view one = "element tristrips 1 property list int int vertex_indices ";
  expect_part(refusal(ply_of(one, "6 0 1 2 -1 0 2"), MeshFormat::ply), "a triangle strip with 2 points; expected 3");
  expect_part(refusal(ply_of(one, "5 0 -1 0 1 2"), MeshFormat::ply), "a triangle strip with 1 point; expected 3");
  expect_part(refusal(ply_of(one, "3 0 1 4"), MeshFormat::ply), "a triangle has the point 4");
}

TEST(Ply, SaysWhatElementsItLeavesOut) {
  EXPECT_EQ(parse_mesh(ply_text, MeshFormat::ply, "file").notices,
            (std::vector<std::string>{"skipped 1 edge: the body is made of its 2 polygons"}));
  const std::string text =
      ply_of("element face 2 property list uchar int v element tetra 2 property list uchar int vertex_indices ",
             "3 0 1 2 3 0 2 3 4 0 1 2 3 4 0 1 2 3");
  EXPECT_EQ(
      expect_square(text, MeshFormat::ply).notices,
      (std::vector<std::string>{"left out 2 elements of name 'tetra': only vertex, face and tristrips are read"}));
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
