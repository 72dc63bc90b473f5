#include "benchmarks/harness/processes.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>

namespace {
std::vector<pid_t> killed;
}  // namespace

// This program's own definition precedes the C library's. Signals to processes that are no children are not sent.
extern "C" int kill(pid_t pid, int signal) noexcept {
  killed.push_back(pid);
  if (pid <= 1) return -1;
  return static_cast<int>(syscall(SYS_kill, pid, signal));
}

namespace dartboard::processes_test {
namespace {

std::vector<std::string> lines_of(const std::string& program, const std::vector<std::string>& arguments) {
  std::vector<std::string> lines;
  run_program(program, arguments, [&](std::string_view line) { lines.emplace_back(line); });
  return lines;
}

std::vector<std::string> lines_of_shell(const std::string& script) { return lines_of("sh", {"-c", script}); }

/// The message of a failing child.
std::string failure_of(const std::function<void()>& run) {
  try {
    run();
  } catch (const ProcessError& error) {
    return error.what();
  }
  return "no failure";
}

TEST(Processes, HandOverEachLineTheLastOneToo) {
  EXPECT_EQ(lines_of_shell("echo first; echo; printf last"), (std::vector<std::string>{"first", "", "last"}));
  EXPECT_TRUE(lines_of_shell(":").empty());
}

TEST(Processes, HandOverLinesLongerThanAnyBuffer) {
  const auto lines = lines_of_shell("printf '%0100000d\\n' 7; echo end");
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].size(), 100000u);
  EXPECT_EQ(lines[1], "end");
}

TEST(Processes, PassArgumentsUntouched) {
  const std::string odd = "two words; $HOME \"*\" '";
  EXPECT_EQ(lines_of("printf", {"%s", odd}), (std::vector<std::string>{odd}));
}

TEST(Processes, NameCommandAndStatusOfAFailure) {
  EXPECT_EQ(failure_of([] { lines_of_shell("exit 3"); }), "`sh -c exit 3` ended with status 3, expected 0");
}

TEST(Processes, NameTheSignalThatEndedAChild) {
  const std::string failure = failure_of([] { lines_of_shell("kill -9 $$"); });
  EXPECT_NE(failure.find("was killed by signal 9"), std::string::npos) << failure;
}

TEST(Processes, NameAProgramThatDoesNotExist) {
  const std::string failure = failure_of([] { lines_of("dartboard-no-such-program", {}); });
  EXPECT_NE(failure.find("cannot start `dartboard-no-such-program`"), std::string::npos) << failure;
}

TEST(Processes, DoNotOutliveASinkThatThrows) {
  // without the kill, this would wait an hour for the sleeping child
  const auto sink = [](std::string_view) { throw std::logic_error("sink"); };
  EXPECT_THROW(run_program("sh", {"-c", "echo line; exec sleep 3600"}, sink), std::logic_error);
}

TEST(Processes, AreKilledOnlyWhereTheirEndIsNotAwaited) {
  killed.clear();
  lines_of_shell("echo line");
  failure_of([] { lines_of_shell("exit 3"); });
  EXPECT_TRUE(killed.empty());
  pid_t child = 0;
  EXPECT_THROW(run_program("sh", {"-c", "echo $$; exec sleep 3600"},
                           [&](std::string_view line) {
                             child = static_cast<pid_t>(std::stol(std::string(line)));
                             throw std::logic_error("sink");
                           }),
               std::logic_error);
  EXPECT_EQ(killed, std::vector<pid_t>{child});
}

TEST(Processes, RunThisExecutableAgain) {
  std::vector<std::string> lines;
  run_self({"--gtest_list_tests", "--gtest_filter=Processes.*"},
           [&](std::string_view line) { lines.emplace_back(line); });
  EXPECT_NE(std::find(lines.begin(), lines.end(), "  RunThisExecutableAgain"), lines.end());
}

}  // namespace
}  // namespace dartboard::processes_test
