#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "benchmarks/checkout/source_folder.h"
#include "tests/support/meshes/mesh_samples.h"

namespace dartboard::mesh_io_test {
namespace {

using namespace samples;
namespace fs = std::filesystem;

/// A folder of its own for every test, removed afterwards.
class MeshIo : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) / ("mesh_io_" + std::to_string(getpid()) + "_" + test->name());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, std::string_view text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  std::string refused(const fs::path& path) const {
    try {
      read_mesh_file(path);
    } catch (const IoError& error) {
      return error.what();
    }
    ADD_FAILURE() << "read without an error: " << path;
    return "";
  }

  fs::path folder_;
};

TEST_F(MeshIo, TellsTheFormatByTheExtension) {
  expect_two_tetrahedra(read_mesh_file(write("a.mesh", medit)));
  expect_two_tetrahedra(read_mesh_file(write("a.msh", gmsh4)));
  expect_two_tetrahedra(read_mesh_file(write("a.VTK", vtk4)));
  expect_two_tetrahedra(read_mesh_file(write("a.vtu", vtu_base64)));
}

TEST_F(MeshIo, FindsTheSecondFileOfTetGenFromEitherOneOrTheStem) {
  const fs::path node = write("two.1.node", tetgen_node), ele = write("two.1.ele", tetgen_ele);
  expect_two_tetrahedra(read_mesh_file(node));
  expect_two_tetrahedra(read_mesh_file(ele));
  expect_two_tetrahedra(read_mesh_file(folder_ / "two.1"));
  fs::remove(ele);
  EXPECT_EQ(refused(node),
            ele.string() + ": there is no such file; expected the TetGen cells that belong to the .node file");
}

TEST_F(MeshIo, NamesTheFileOfTetGenThatIsWrong) {
  const fs::path node = write("a.node", tetgen_node), ele = write("a.ele", with(tetgen_ele, "1 1 2 3 4", "1 1 2 3 9"));
  EXPECT_EQ(refused(node), ele.string() + ":3: a tetrahedron has the point 9; expected one of the 5 point numbers in " +
                               node.string());
}

TEST_F(MeshIo, RefusesWhatIsNotAFile) {
  expect_part(refused(folder_ / "missing.msh"), "missing.msh: there is no such file; expected a mesh file: .mesh");
  expect_part(refused(folder_), ": this is a directory; expected a mesh file");
  expect_part(refused("/dev/null.msh"), "there is no such file");
}

TEST_F(MeshIo, RefusesAnEmptyFile) {
  expect_part(refused(write("a.msh", "")), "a.msh:1: the file is empty");
  expect_part(refused(write("a.vtu", " \n\n")), "a.vtu:1: the file is empty");
}

TEST_F(MeshIo, ListsTheKnownExtensionsWhenOneIsUnknown) {
  expect_part(
      refused(write("a.step", medit)),
      "a.step: the extension '.step' is unknown; expected .mesh or .meshb (Medit), .node or .ele (TetGen), .msh (Gmsh), "
      ".vtk (legacy VTK), .vtu (VTK XML), .stl (STL), .obj (OBJ), .ply (PLY) or .off (OFF)");
  for (const char* name : {"a.vtp", "a.pvtu"})
    expect_part(refused(write(name, vtu_ascii)), "' is unknown; expected .mesh");
}

// The page for readers and the program's list are the same.
TEST_F(MeshIo, HasAPageOfItsFormatsThatIsTrue) {
  std::ifstream in(source_folder() / "core/meshes/README.md");
  const std::string page{std::istreambuf_iterator<char>(in), {}};
  for (const MeshFormatInfo& format : mesh_formats()) {
    std::string extensions;
    for (const std::string_view e : format.extensions)
      extensions += (extensions.empty() ? "`" : " `") + std::string(e) + "`";
    expect_part(page, "\n| " + std::string(format.name) + " | " + extensions + " | " + std::string(format.read) +
                          " | " + std::string(format.written) + " |\n");
  }
}

TEST_F(MeshIo, WritesMeditThatReadsBackWithTheSameBits) {
  Mesh mesh = parse_mesh(gmsh2, MeshFormat::gmsh, "file").mesh;
  for (auto& x : mesh.points) x = x * 0.1 + Eigen::Vector3d(1.0 / 3.0, 1e-17, -2.0 / 7.0);
  write_medit(folder_ / "a.mesh", mesh);
  const Mesh again = read_mesh(folder_ / "a.mesh");
  EXPECT_EQ(again.points, mesh.points);
  EXPECT_EQ(again.kinds, mesh.kinds);
  EXPECT_EQ(again.nodes, mesh.nodes);
}

TEST_F(MeshIo, NeverWritesOverAFile) {
  const fs::path path = write("a.mesh", "precious");
  EXPECT_THROW(write_medit(path, parse_mesh(medit, MeshFormat::medit, "file").mesh), IoError);
  EXPECT_EQ(fs::file_size(path), 8u);
  EXPECT_THROW(write_medit(folder_ / "no" / "a.mesh", Mesh{}), IoError);
}

}  // namespace
}  // namespace dartboard::mesh_io_test
