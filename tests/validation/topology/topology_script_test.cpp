#include "validation/topology/topology_script.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "core/plain/error.h"

namespace dartboard::topology_script_test {
namespace {

const std::string header = "dartboard-topology-script 1\nmesh kuhn grid\nstorage tetrahedral\noracles both\n";

std::string message_of(const std::string& text) {
  try {
    parse_topology_script(text, "s.txt");
  } catch (const IoError& error) {
    return error.what();
  }
  return "no throw";
}

TEST(TopologyScript, ReadsEveryKindOfOperation) {
  const auto script = parse_topology_script(
      header + "sew 3 d17 d40\nunsew 2 d5\ndissociate d6\nremove d3\nadd prism d144\nadd tetrahedron\n", "s.txt");
  EXPECT_EQ(script.mesh, "kuhn grid");
  EXPECT_EQ(script.storage, ScriptStorage::tetrahedral);
  EXPECT_EQ(script.oracles, ScriptOracles::both);
  using Kind = Operation::Kind;
  ASSERT_EQ(script.operations.size(), 6u);
  EXPECT_EQ(script.operations[0], (Operation{.kind = Kind::sew, .i = 3, .a = Dart{17}, .b = Dart{40}}));
  EXPECT_EQ(script.operations[1], (Operation{.kind = Kind::unsew, .i = 2, .a = Dart{5}}));
  EXPECT_EQ(script.operations[2], (Operation{.kind = Kind::dissociate, .a = Dart{6}}));
  EXPECT_EQ(script.operations[3], (Operation{.kind = Kind::remove, .a = Dart{3}}));
  EXPECT_EQ(script.operations[4], (Operation{.kind = Kind::add, .cell = CellKind::prism, .a = Dart{144}}));
  EXPECT_EQ(script.operations[5], (Operation{.kind = Kind::add, .cell = CellKind::tetrahedron}));
}

TEST(TopologyScript, IsWrittenAsItIsRead) {
  const std::string text =
      header + "sew 0 d1 d2\nunsew 3 d5\ndissociate d6\nremove d3\nadd hexahedron d144\nadd triangle\n";
  EXPECT_EQ(to_string(parse_topology_script(text, "s.txt")), text);
}

TEST(TopologyScript, SkipsCommentsBlankLinesAndSpaces) {
  const auto script = parse_topology_script(
      "# seed 1\n\ndartboard-topology-script 1\r\n  mesh  m.mesh \nstorage general # all\n"
      "oracles none\n\n  remove\td7  # gone\n",
      "s.txt");
  EXPECT_EQ(script.mesh, "m.mesh");
  EXPECT_EQ(script.storage, ScriptStorage::general);
  EXPECT_EQ(script.oracles, ScriptOracles::none);
  ASSERT_EQ(script.operations.size(), 1u);
  EXPECT_EQ(to_string(script.operations[0]), "remove d7");
}

TEST(TopologyScript, NamesTheLineOfABadHeaderAndWhatWasExpected) {
  EXPECT_EQ(message_of(""), "s.txt:1: expected \"dartboard-topology-script 1\", found nothing");
  EXPECT_EQ(message_of("dartboard-topology-script 2\n"),
            "s.txt:1: expected \"dartboard-topology-script 1\", found \"dartboard-topology-script 2\"");
  EXPECT_EQ(message_of("dartboard-topology-script 1\nmeshes m\n"),
            "s.txt:2: expected \"mesh NAME\", found \"meshes m\"");
  EXPECT_EQ(message_of("dartboard-topology-script 1\nmesh\n"), "s.txt:2: expected \"mesh NAME\", found \"mesh\"");
  EXPECT_EQ(message_of("dartboard-topology-script 1\nmesh m\nstorage big\n"),
            "s.txt:3: expected one of general, tetrahedral, found \"big\"");
  EXPECT_EQ(message_of("dartboard-topology-script 1\nmesh m\nstorage general\n"),
            "s.txt:4: expected \"oracles none|gmap|both\", found nothing");
}

TEST(TopologyScript, NamesTheLineOfABadOperationAndWhatWasExpected) {
  const auto after_header = [](const std::string& line) { return message_of(header + "remove d1\n\n" + line + "\n"); };
  EXPECT_EQ(after_header("tear d1"), "s.txt:7: expected sew, unsew, dissociate, remove or add, found \"tear\"");
  EXPECT_EQ(after_header("sew d1 d2"), "s.txt:7: expected an involution, 0 to 3, found \"d1\"");
  EXPECT_EQ(after_header("sew 4 d1 d2"), "s.txt:7: expected an involution, 0 to 3, found \"4\"");
  EXPECT_EQ(after_header("sew 3 d1"), "s.txt:7: expected a dart such as d17, found nothing");
  EXPECT_EQ(after_header("sew 3 d1 7"), "s.txt:7: expected a dart such as d17, found \"7\"");
  EXPECT_EQ(after_header("remove d1x"), "s.txt:7: expected a dart d0 .. d268435455, found \"d1x\"");
  EXPECT_EQ(after_header("remove d-1"), "s.txt:7: expected a dart d0 .. d268435455, found \"d-1\"");
  EXPECT_EQ(after_header("remove d268435456"), "s.txt:7: expected a dart d0 .. d268435455, found \"d268435456\"");
  EXPECT_EQ(after_header("remove d99999999999999999999"),
            "s.txt:7: expected a dart d0 .. d268435455, found \"d99999999999999999999\"");
  EXPECT_EQ(after_header("remove d1 d2"), "s.txt:7: expected the end of the line, found \"d2\"");
  EXPECT_EQ(
      after_header("add cube"),
      "s.txt:7: expected a kind of cell: triangle, quadrilateral, tetrahedron, pyramid, prism or hexahedron, found "
      "\"cube\"");
}

TEST(TopologyScript, SurvivesAFile) {
  const auto path = std::filesystem::path(testing::TempDir()) / "topology_script_test.txt";
  const auto script = parse_topology_script(header + "sew 3 d1 d2\n", "s.txt");
  write_topology_script(path, script);
  EXPECT_EQ(to_string(read_topology_script(path)), to_string(script));
  std::filesystem::remove(path);
  EXPECT_THROW(read_topology_script(path), IoError);
  EXPECT_THROW(write_topology_script(path / "below" / "a file", script), IoError);
  EXPECT_THROW(read_topology_script(testing::TempDir()), IoError);  // a folder
}

}  // namespace
}  // namespace dartboard::topology_script_test
