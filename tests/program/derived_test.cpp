// The files of a study, derived again by the program from what its processes measured.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "tests/support/folder_for_tests.h"
#include "tests/support/program_for_tests.h"

namespace dartboard::derived_test {
namespace {

namespace fs = std::filesystem;

/// The folder of a study that is complete.
class Derived : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    ASSERT_EQ(run("bench operations --quick --out '" + study() + "'", "2>/dev/null").status, 0);
  }
  std::string study() const { return (folder_ / "study").string(); }
  Answer check() const { return run("report --check '" + study() + "'", "2>&1"); }
};

TEST_F(Derived, FollowAllFromWhatWasMeasured) {
  const Answer sound = check();
  EXPECT_EQ(sound.status, 0) << sound.out;
  EXPECT_NE(sound.out.find("follow from what was measured"), std::string::npos) << sound.out;
}

TEST_F(Derived, DifferFromASampleThatWasChangedByHand) {
  std::string table = text("study/samples.jsonl");
  const std::size_t digit = table.find_last_of("123456789");
  ASSERT_NE(digit, std::string::npos);
  table[digit] = table[digit] == '9' ? '8' : '9';
  std::ofstream(folder_ / "study" / "samples.jsonl") << table;
  fs::remove(folder_ / "study" / "claims.json");
  const Answer changed = check();
  EXPECT_EQ(changed.status, 1) << changed.out;
  EXPECT_NE(changed.out.find("/study/samples.jsonl:"), std::string::npos) << changed.out;
  EXPECT_NE(changed.out.find("/study/claims.json: is missing"), std::string::npos) << changed.out;
  EXPECT_EQ(changed.out.find("follow from"), std::string::npos) << changed.out;
}

TEST_F(Derived, AreMadeAgainWithTheSamePageWhereOnlyWhatWasMeasuredIsLeft) {
  std::map<std::string, std::string> before;
  for (const auto& entry : fs::directory_iterator(folder_ / "study")) {
    const std::string name = entry.path().filename().string();
    if (name == "manifest.json" || name == "measured.jsonl.gz") continue;
    before[name] = contents(entry.path());
    fs::remove(entry.path());
  }
  ASSERT_TRUE(before.contains("report.html"));
  const Answer raw = check();
  EXPECT_EQ(raw.status, 0) << raw.out;
  EXPECT_NE(raw.out.find("can be derived; none of them is there"), std::string::npos) << raw.out;
  EXPECT_FALSE(fs::exists(folder_ / "study" / "findings.json"));
  const Answer again = run("report '" + study() + "'", "2>&1");
  EXPECT_EQ(again.status, 0) << again.out;
  for (const auto& [name, bytes] : before) EXPECT_TRUE(text("study/" + name) == bytes) << name;
}

TEST_F(Derived, AreRefusedWhereNothingWasMeasuredInProcesses) {
  fs::remove(folder_ / "study" / "measured.jsonl.gz");
  const Answer refused = check();
  EXPECT_EQ(refused.status, 3);
  EXPECT_NE(refused.out.find("holds no measured.jsonl.gz"), std::string::npos) << refused.out;
}

}  // namespace
}  // namespace dartboard::derived_test
