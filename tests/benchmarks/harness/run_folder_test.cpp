#include "benchmarks/harness/run_folder.h"

#include <gtest/gtest.h>

#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/plain/error.h"
#include "tests/support/folder_for_tests.h"
#include "tests/support/processes_for_tests.h"

namespace dartboard::run_folder_test {
namespace {

namespace fs = std::filesystem;

class RunFolderTest : public FolderTest {
 protected:
  static std::size_t files_in(const fs::path& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
  }
};

TEST_F(RunFolderTest, IsCreatedWithTheFoldersAboveIt) {
  const RunFolder run(folder_ / "results" / "first");
  EXPECT_TRUE(fs::is_directory(folder_ / "results" / "first"));
}

TEST_F(RunFolderTest, MayExistWhenEmpty) { EXPECT_NO_THROW(RunFolder{folder_}); }

TEST_F(RunFolderTest, IsRefusedByNameWhenItHoldsSomething) {
  std::ofstream(folder_ / "precious.txt") << "earlier results";
  try {
    const RunFolder run(folder_);
    FAIL() << "expected an IoError";
  } catch (const IoError& error) {
    EXPECT_NE(std::string(error.what()).find(folder_.string()), std::string::npos) << error.what();
  }
  EXPECT_EQ(contents(folder_ / "precious.txt"), "earlier results");
}

TEST_F(RunFolderTest, IsRefusedWhereAFileIs) {
  std::ofstream(folder_ / "file") << "";
  EXPECT_THROW(RunFolder(folder_ / "file"), IoError);
  EXPECT_THROW(RunFolder(folder_ / "file" / "below"), IoError);
}

TEST_F(RunFolderTest, ReplacesAFileWholeAndLeavesNothingBesideIt) {
  const RunFolder run(folder_);
  run.write("report.md", "first, long");
  run.write("report.md", "second");
  EXPECT_EQ(contents(folder_ / "report.md"), "second");
  EXPECT_EQ(files_in(folder_), 1u);
}

TEST_F(RunFolderTest, LeavesNoHalfWrittenFileWhenAWriteFails) {
  const RunFolder run(folder_);
  fs::create_directories(folder_ / "report.md" / "in the way");
  EXPECT_THROW(run.write("report.md", "text"), IoError);
  EXPECT_EQ(files_in(folder_), 1u);
}

TEST_F(RunFolderTest, WritesOnlyIntoItself) {
  const RunFolder run(folder_);
  for (const char* name : {"", ".", "..", "../escape", "/absolute/escape", "a/b"})
    EXPECT_THROW(run.write(name, "text"), InputError) << name;
}

TEST_F(RunFolderTest, HoldsManifestAndClaims) {
  const RunFolder run(folder_);
  run.write_manifest({{"dartboard", "0.1.0"}});
  run.write_claims(std::vector<Claim>{{.id = "arrays", .text = "as fast as arrays", .verdict = Verdict::holds}});
  EXPECT_EQ(nlohmann::json::parse(contents(folder_ / "manifest.json")).at("dartboard"), "0.1.0");
  EXPECT_EQ(nlohmann::json::parse(contents(folder_ / "claims.json")).at(0).at("verdict"), "holds");
}

TEST_F(RunFolderTest, KeepsEveryJsonLineAlreadyWritten) {
  const RunFolder run(folder_);
  JsonLines lines = run.json_lines("samples.jsonl");
  lines.append({{"round", 0}});
  EXPECT_EQ(contents(folder_ / "samples.jsonl"), "{\"round\":0}\n");  // while the file is still open
  lines.append({{"round", 1}});
  run.json_lines("samples.jsonl").append({{"round", 2}});
  EXPECT_EQ(contents(folder_ / "samples.jsonl"), "{\"round\":0}\n{\"round\":1}\n{\"round\":2}\n");
}

TEST_F(RunFolderTest, NamesTheNumberThatJsonCannotHold) {
  const RunFolder run(folder_);
  const nlohmann::json bad{{"errors", {1.0, std::numeric_limits<double>::quiet_NaN()}}};
  try {
    run.write_json("bad.json", bad);
    FAIL() << "expected an InputError";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "/errors/1: nan is not finite, JSON cannot hold it");
  }
  EXPECT_THROW(run.json_lines("bad.jsonl").append(bad), InputError);
}

TEST_F(RunFolderTest, NewRunPathsDoNotCollide) {
  const fs::path first = new_run_path(folder_, "reproduce");
  const fs::path second = new_run_path(folder_, "reproduce");
  EXPECT_NE(first, second);
  EXPECT_TRUE(fs::is_directory(first) && fs::is_directory(second));
  EXPECT_TRUE(second.filename().string().starts_with("reproduce-20")) << second;
}

TEST_F(RunFolderTest, NewRunPathsOfProcessesThatStartAtOnceDoNotCollide) {
  const auto statuses = at_once(20, [this](int) {
    try {
      const RunFolder run(new_run_path(folder_, "reproduce"));
      run.write("result.txt", "result");
      return 0;
    } catch (const IoError&) {
      return 1;
    }
  });
  EXPECT_EQ(statuses, std::vector<int>(20, 0));
  EXPECT_EQ(files_in(folder_), 20u);
}

}  // namespace
}  // namespace dartboard::run_folder_test
