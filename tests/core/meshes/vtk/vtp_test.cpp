#include <gtest/gtest.h>

#include "tests/support/meshes/mesh_samples.h"
#include "tests/support/meshes/vtk_polygon_samples.h"

namespace dartboard::vtp_test {
namespace {

using namespace samples;

std::string refused(std::string_view text) { return refusal(text, MeshFormat::vtp); }

/// The triangle comes before the strip, as VTK counts its cells, though the file has them the other way round.
void expect_square(const LoadedMesh& loaded) {
  EXPECT_EQ(loaded.mesh.nodes, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(loaded.mesh.points, (std::vector<Eigen::Vector3d>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  ASSERT_EQ(loaded.tags.size(), 1u);
  EXPECT_EQ(loaded.tags[0].name, "material");
  EXPECT_EQ(loaded.tags[0].values, (std::vector<std::int32_t>{7, -3}));
  EXPECT_EQ(loaded.notices,
            (std::vector<std::string>{"skipped 1 edge, 1 point element: the body is made of its 2 polygons"}));
}

TEST(Vtp, ReadsTrianglesAndStripsWithTheNumbersThatVtkCountsForThem) {
  const LoadedMesh loaded = parse_mesh(vtp_ascii, MeshFormat::vtp, "file");
  expect_square(loaded);
  EXPECT_EQ(loaded.format, "VTP");
}

TEST(Vtp, ReadsToTheSameBitsInEveryEncoding) {
  for (const VtuVariant& v : vtu_variants()) {
    SCOPED_TRACE(v.encoding + " " + v.compressor + (v.wide ? " wide" : "") + (v.big_endian ? " big-endian" : ""));
    expect_square(parse_mesh(vtp(v), MeshFormat::vtp, "file"));
  }
}

TEST(Vtp, TurnsEveryOtherTriangleOfAStripAndGivesAllItsNumber) {
  std::string text = with(vtp_ascii, "format=\"ascii\">0 2 3<", "format=\"ascii\">1 0 2 3<");
  text = with(text, ">3</DataArray>\n      </Strips>", ">4</DataArray>\n      </Strips>");
  text = with(text, "NumberOfPolys=\"1\"", "NumberOfPolys=\"0\"");
  const LoadedMesh loaded = parse_mesh(with(text, ">1 2 7 -3<", ">1 2 7<"), MeshFormat::vtp, "file");
  EXPECT_EQ(loaded.mesh.nodes, (std::vector<std::uint32_t>{1, 0, 2, 2, 0, 3}));
  EXPECT_EQ(loaded.tags.at(0).values, (std::vector<std::int32_t>{7, 7}));
}

TEST(Vtp, MayLeaveOutTheListsThatItSaysNothingOf) {
  std::string text(vtp_ascii);
  for (const char* list : {"Verts", "Lines", "Strips"}) {
    const std::size_t begin = text.find("<" + std::string(list) + ">"),
                      end = text.find("</" + std::string(list) + ">") + 9;
    text.erase(begin, end - begin);
    text = with(text, " NumberOf" + std::string(list) + "=\"1\"", "");
  }
  text = with(with(text, ">0 1 2<", ">0 1 2 3<"), ">3</DataArray>\n      </Polys>", ">4</DataArray>\n      </Polys>");
  const LoadedMesh loaded = parse_mesh(with(text, ">1 2 7 -3<", ">5<"), MeshFormat::vtp, "file");
  EXPECT_EQ(loaded.mesh.kinds, std::vector{CellKind::quadrilateral});
  EXPECT_TRUE(loaded.notices.empty());
}

TEST(Vtp, RefusesWhatIsNotAsManyAsThePieceSays) {
  expect_part(refused(with(vtp_ascii, "NumberOfStrips=\"1\"", "NumberOfStrips=\"2\"")),
              "'offsets' has 1 values; expected 2");
  expect_part(refused(with(vtp_ascii, "NumberOfPoints=\"4\"", "NumberOfPoints=\"400000000000\"")), "has 12 values");
  expect_part(refused(with(vtp_ascii, ">1 2 7 -3<", ">1 2 7<")), "'material' has 3 values; expected 4");
  expect_part(refused(with(vtp_ascii, "NumberOfPolys=\"1\"", "NumberOfPolys=\"x\"")), "file:4: 'x' is not an integer");
}

TEST(Vtp, RefusesCellsThatItCannotHold) {
  expect_part(refused(with(vtp_ascii, ">0 2 3<", ">0 2 4<")), "cell 3 has the point 4; expected a number from 0 to");
  expect_part(refused(with(vtp_ascii, ">0 2 3<", ">0 2 2<")), "(triangle) has the point 2 twice");
  std::string text = with(vtp_ascii, ">0 1 2<", ">0 1 2 3 0<");
  text = with(text, ">3</DataArray>\n      </Polys>", ">5</DataArray>\n      </Polys>");
  expect_part(refused(text), "cell 2 is a polygon of 5 corners; expected triangles and quadrilaterals: split larger");
  text = with(vtp_ascii, ">0 2 3<", ">0 2<");
  text = with(text, ">3</DataArray>\n      </Strips>", ">2</DataArray>\n      </Strips>");
  expect_part(refused(text), "cell 3 is a triangle strip with 2 points; expected 3 points or more");
}

TEST(Vtp, RefusesCoordinatesThatAreNotFinite) {
  expect_part(refused(with(vtp_ascii, "0 0 0 1 0 0", "0 0 0 inf 0 0")), "'inf' is not finite");
}

TEST(Vtp, RefusesAFileWithoutPieces) {
  expect_part(refused("<VTKFile type=\"PolyData\"><PolyData/></VTKFile>"),
              "the file has no <Piece>; expected <PolyData> with a <Piece>");
}

}  // namespace
}  // namespace dartboard::vtp_test
