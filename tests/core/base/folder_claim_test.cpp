#include "core/base/folder_claim.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <vector>

#include "core/plain/error.h"
#include "tests/support/folder_for_tests.h"
#include "tests/support/processes_for_tests.h"

namespace dartboard::folder_claim_test {
namespace {

namespace fs = std::filesystem;

class FolderClaimTest : public FolderTest {
 protected:
  static std::string refusal(const fs::path& folder) {
    try {
      const FolderClaim claim(folder);
    } catch (const IoError& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(FolderClaimTest, IsRefusedWhileAnotherHoldsIt) {
  const fs::path run = folder_ / "run";
  {
    const FolderClaim first(run);
    EXPECT_EQ(refusal(run),
              run.string() + ": is in use by another run; expected a new or empty folder for the results");
  }
  EXPECT_EQ(refusal(run), "");  // removed completely
}

TEST_F(FolderClaimTest, IsRefusedWhereAnotherHasWrittenAndGone) {
  const fs::path run = folder_ / "run";
  {
    const FolderClaim first(run);
    std::ofstream(run / "result") << "result";
  }
  EXPECT_EQ(refusal(run), run.string() + ": is not empty; expected a new or empty folder for the results");
}

TEST_F(FolderClaimTest, IsNotHeldByChildren) {
  const fs::path run = folder_ / "run";
  pid_t child = 0;
  {
    const FolderClaim claim(run);
    child = fork();
    if (child == 0) {
      execlp("sleep", "sleep", "60", nullptr);
      _exit(127);
    }
    // until it has become another program
    while (fs::read_symlink(fs::path("/proc") / std::to_string(child) / "exe").filename() != "sleep") usleep(1000);
  }
  EXPECT_EQ(refusal(run), "");
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
}

TEST_F(FolderClaimTest, GoesToOneOfTwoProcessesThatStartAtOnce) {
  for (int pair = 0; pair < 60; ++pair) {
    const fs::path run = folder_ / std::to_string(pair);
    if (pair % 2 == 1) fs::create_directories(run);  // an empty folder is treated like a missing one
    auto statuses = at_once(2, [&run](int) {
      try {
        const FolderClaim claim(run);
        std::ofstream(run / "result") << "result";
        return 0;
      } catch (const IoError&) {
        return 1;
      }
    });
    std::ranges::sort(statuses);
    EXPECT_EQ(statuses, (std::vector{0, 1})) << "pair " << pair;
  }
}

}  // namespace
}  // namespace dartboard::folder_claim_test
