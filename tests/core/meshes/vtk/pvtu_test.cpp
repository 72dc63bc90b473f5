// Grids in several files, and the treatment of points that two of them share.

#include <gtest/gtest.h>

#include "tests/support/folder_for_tests.h"
#include "tests/support/meshes/mesh_samples.h"
#include "tests/support/meshes/pvtu_samples.h"

namespace dartboard::pvtu_test {
namespace {

using namespace samples;

class Pvtu : public FolderTest {
 protected:
  LoadedMesh read(const std::string& text = pvtu("a.vtu", "b.vtu")) const {
    std::ofstream(folder_ / "all.pvtu") << text;
    return read_mesh(folder_ / "all.pvtu");
  }
  std::string refused(const std::string& text = pvtu("a.vtu", "b.vtu")) const {
    try {
      read(text);
    } catch (const IoError& error) {
      return error.what();
    }
    ADD_FAILURE() << "read without an error";
    return "";
  }
};

// The second piece has -0 where the first has 0.
TEST_F(Pvtu, MakesEqualPointsOfTwoPiecesOne) {
  write_pieces(folder_, vtu_piece(first_points, cell_array("Int32", "material", "7")),
               vtu_piece(second_points, cell_array("Int32", "material", "-3")));
  const LoadedMesh loaded = read();
  expect_two_tetrahedra(loaded);
  EXPECT_EQ(loaded.format, "PVTU");
  EXPECT_EQ(loaded.notices,
            (std::vector<std::string>{"joined 3 points with equal points of other pieces, of 2 pieces"}));
  ASSERT_EQ(loaded.tags.size(), 1u);
  EXPECT_EQ(loaded.tags[0].values, (std::vector<std::int32_t>{7, -3}));
}

TEST_F(Pvtu, LooksForPiecesFromItsOwnFolder) {
  std::filesystem::create_directories(folder_ / "deep");
  write_pieces(folder_ / "deep");
  expect_two_tetrahedra(read(pvtu("deep/a.vtu", (folder_ / "deep/b.vtu").string())));
}

TEST_F(Pvtu, LeavesOutCopiesOfCellsThatAnotherPieceHas) {
  // under both names that VTK has used; 2 marks a refined cell, which is no copy
  const std::string both =
      with(with(with(vtu_piece("1 0 0 0 1 0 0 0 1 1 1 1 0 0 0"), "NumberOfCells=\"1\"", "NumberOfCells=\"2\""),
                "NumberOfPoints=\"4\"", "NumberOfPoints=\"5\""),
           "ascii\">0 1 2 3<", "ascii\">0 1 2 3 4 0 1 2<");
  const std::string piece = with(with(both, "ascii\">4<", "ascii\">4 8<"), "ascii\">10<", "ascii\">10 10<");
  for (const std::string& ghosts :
       {cell_array("UInt8", "vtkGhostType", "2 1"), cell_array("UInt8", "vtkGhostLevels", "0 1")}) {
    write_pieces(folder_, vtu_piece(first_points), with(piece, "<CellData>", "<CellData>" + ghosts));
    const LoadedMesh loaded = read();
    expect_two_tetrahedra(loaded);
    EXPECT_TRUE(loaded.tags.empty());
    ASSERT_EQ(loaded.notices.size(), 2u);
    EXPECT_EQ(loaded.notices[0], "left out 1 ghost cell: copies of cells of other pieces, or hidden ones");
  }
  write_pieces(folder_, vtu_piece(first_points), piece);
  expect_part(refused(), "all.pvtu: cell 2 (tetrahedron) has the same points as cell 0 (tetrahedron); expected every");
}

TEST_F(Pvtu, KeepsEqualPointsOfOnePieceApart) {
  // a tetrahedron without neighbours, twice in the second piece, as in a torn body
  const std::string apart = "5 0 0 6 0 0 5 1 0 5 0 1";
  const std::string torn =
      with(with(with(with(with(vtu_piece(apart + " " + apart), "NumberOfPoints=\"4\"", "NumberOfPoints=\"8\""),
                          "NumberOfCells=\"1\"", "NumberOfCells=\"2\""),
                     "ascii\">0 1 2 3<", "ascii\">0 1 2 3 4 5 6 7<"),
                "ascii\">4<", "ascii\">4 8<"),
           "ascii\">10<", "ascii\">10 10<");
  write_pieces(folder_, vtu_piece(first_points), torn);
  const LoadedMesh loaded = read();
  EXPECT_EQ(loaded.mesh.points.size(), 12u);
  ASSERT_EQ(loaded.notices.size(), 1u);
  expect_part(loaded.notices[0], "4 points coincide with another one");
}

TEST_F(Pvtu, RefusesToGuessWhichOfTwoPointsIsMeant) {
  write_pieces(folder_,
               with(vtu_piece("0 0 0 1 0 0 0 1 0 0 0 1 1 0 0"), "NumberOfPoints=\"4\"", "NumberOfPoints=\"5\""));
  EXPECT_EQ(refused(),
            (folder_ / "all.pvtu").string() +
                ": point 1 of 'a.vtu' and point 4 of 'a.vtu' are at the place of point 0 of 'b.vtu'; expected "
                "one point of each piece there: which points to join is ambiguous");
}

// The shortest edge is 1, the size of the mesh sqrt 3: nearer than 1.7e-6 is too near.
TEST_F(Pvtu, RefusesPointsThatAreNearlyEqual) {
  write_pieces(folder_, vtu_piece(first_points), vtu_piece("1.0000000000000002 0 0 0 1 0 0 0 1 1 1 1"));
  EXPECT_EQ(refused(),
            (folder_ / "all.pvtu").string() +
                ": point 0 of 'b.vtu' is 2.22e-16 from point 1 of 'a.vtu'; expected the same three numbers, so "
                "that they are one point, or more than 1.73e-06, or a distance to weld them at");
  write_pieces(folder_, vtu_piece(first_points), vtu_piece("1.0000017 0 0 0 1 0 0 0 1 1 1 1"));
  expect_part(refused(), "is 1.7e-06 from");
  write_pieces(folder_, vtu_piece(first_points), vtu_piece("1.0000018 0 0 0 1 0 0 0 1 1 1 1"));
  EXPECT_EQ(read().mesh.points.size(), 6u);
}

// As in a body that is torn and has begun to open; its shortest edge is 1e-4, so that 1e-7 is near.
TEST_F(Pvtu, TakesPointsAsTheyAreThatAreNearInOnePieceOrFarForTheirEdges) {
  write_pieces(folder_, vtu_piece(first_points), vtu_piece("0.5 5 0 0.5001 5 0 0.5 5.0001 0 0.5 5 0.0001"));
  EXPECT_EQ(read().mesh.points.size(), 8u);
  write_pieces(folder_, vtu_piece("0 0 0 1e-4 0 0 0 1e-4 0 0 0 1e-4"), vtu_piece("5e-7 0 0 1 0 0 0 1 0 0 0 1"));
  EXPECT_EQ(read().mesh.points.size(), 8u);
  const std::string apart =
      with(with(with(with(with(vtu_piece("5 0 0 6 0 0 5 1 0 5 0 1 5 0 1e-9 6 0 1e-9 5 1 1e-9 5 0 -1"),
                               "NumberOfPoints=\"4\"", "NumberOfPoints=\"8\""),
                          "NumberOfCells=\"1\"", "NumberOfCells=\"2\""),
                     "ascii\">0 1 2 3<", "ascii\">0 1 2 3 4 6 5 7<"),
                "ascii\">4<", "ascii\">4 8<"),
           "ascii\">10<", "ascii\">10 10<");
  write_pieces(folder_, vtu_piece(first_points), apart);
  EXPECT_EQ(read().mesh.points.size(), 12u);
}

// Wherever the two points lie: the search for near points uses boxes 64 times as wide as the distance called near. The
// mesh has the size 24 sqrt 3, so near is 4.2e-5 and a box 2.7e-3: steps of 2e-5 over one of them, of points 3e-5
// apart, visit every border.
TEST_F(Pvtu, RefusesPointsThatAreNearlyEqualWhereverTheyAre) {
  for (int k = 0; k < 140; ++k) {
    const auto piece = [k](double more, const char* apex) {
      return vtu_piece(std::to_string(10.0 + 2e-5 * k + more) + " 5 5 11 0 0 0 11 0 " + apex);
    };
    write_pieces(folder_, piece(0.0, "0 0 11"), piece(3e-5, "-13 -13 -13"));
    expect_part(refused(), "is 3e-05 from point 0 of 'a.vtu'; expected the same three numbers");
  }
}

TEST_F(Pvtu, NamesThePieceInWhichSomethingIsWrong) {
  write_pieces(folder_, vtu_piece(first_points), vtu_piece("1 0 0 0 nan 0 0 0 1 1 1 1"));
  expect_part(refused(), (folder_ / "b.vtu").string() + ":5: 'nan' is not finite");
  write_pieces(folder_, vtu_piece(first_points),
               with(vtu_piece(second_points), "ascii\">0 1 2 3<", "ascii\">0 1 2 4<"));
  expect_part(refused(), (folder_ / "b.vtu").string() + ":7: cell 0 has the point 4");
}

TEST_F(Pvtu, RefusesPiecesThatAreNotThereTwiceThereOrNoGrids) {
  write_pieces(folder_);
  const std::string place = (folder_ / "all.pvtu").string() + ":5: ";
  EXPECT_EQ(refused(pvtu("a.vtu", "none.vtu")), place + "the piece 'none.vtu' is no file; expected a .vtu file");
  EXPECT_EQ(refused(pvtu("a.vtu", ".")), place + "the piece '.' is no file; expected a .vtu file");
  EXPECT_EQ(refused(pvtu("a.vtu", "./a.vtu")), place + "found the piece './a.vtu' again; expected every piece once");
  EXPECT_EQ(refused(pvtu("a.vtu", "")), place + "<Piece> has no Source; expected <Piece Source=\"a .vtu file\">");
  expect_part(refused(pvtu("a.vtu", "all.pvtu")), "of type 'PUnstructuredGrid'; expected <VTKFile type=\"Unstructured");
}

}  // namespace
}  // namespace dartboard::pvtu_test
