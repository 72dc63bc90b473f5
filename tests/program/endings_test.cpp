// Endings of a run that is stopped, that cannot draw, or that meets another one: the real program, in real processes.

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/support/folder_for_tests.h"
#include "tests/support/program_for_tests.h"

namespace dartboard::endings_test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

const char* endless = R"({"name": "endless", "body": {"generate": {"chain": {"links": 1, "spacing": 1}}},
                          "step": 0.001, "duration": 1e8})";
const char* short_run = R"({"name": "short", "body": {"generate": {"chain": {"links": 1, "spacing": 1}}},
                            "step": 0.001, "duration": 0.003})";

class Endings : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    std::ofstream(folder_ / "endless.json") << endless;
    std::ofstream(folder_ / "short.json") << short_run;
  }

  /// The program in the folder of the test; its output goes into files there.
  pid_t start(std::vector<std::string> arguments, const std::string& path = "") const {
    const pid_t child = fork();
    if (child != 0) return child;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_DFL);
    if (!path.empty()) setenv("PATH", path.c_str(), 1);
    fs::current_path(folder_);
    (void)!freopen("printed.txt", "w", stdout);
    (void)!freopen("errors.txt", "w", stderr);
    std::vector<char*> argv{const_cast<char*>("dartboard")};
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    execv(program_path().c_str(), argv.data());
    _exit(127);
  }
  static int ended(pid_t child) {
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }
  /// Waits until the file is there; false if the process has ended before.
  bool waits_for(const std::string& file, pid_t child) const {
    while (!fs::exists(folder_ / file)) {
      siginfo_t info{};
      if (waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == child)
        return false;
      std::this_thread::sleep_for(1ms);
    }
    return true;
  }
};

TEST_F(Endings, AnySignalThatAsksPolitelyLeavesStateAndSummary) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const std::string out = "out" + std::to_string(signal);
    const pid_t child = start({"simulate", "endless.json", "--out", out});
    ASSERT_TRUE(waits_for(out + "/frames.pvd", child));
    kill(child, signal);
    EXPECT_EQ(ended(child), 128 + signal);
    const auto summary = nlohmann::json::parse(text(out + "/summary.json"));
    EXPECT_TRUE(summary.at("interrupted").get<bool>());
    EXPECT_EQ(summary.at("last").at("time").get<double>() > 0.0, summary.at("steps").get<int>() > 0);
    EXPECT_NE(text("printed.txt").find("Interrupted after"), std::string::npos);
    EXPECT_TRUE(nlohmann::json::parse(text(out + "/manifest.json")).contains("finished"));
  }
}

/// Processor time that a process has used [s].
double cpu_seconds(pid_t process) {
  clockid_t clock{};
  timespec used{};
  if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &used) != 0) return 0.0;
  return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

// Factoring takes some 5 s here: a block of n nodes takes about n^2 operations of 3 x 3 numbers, and this one has
// 30,000. Processor time shows it on a busy machine, too. A second is the guarantee; the work before the factorisation
// may take another one under sanitizers.
TEST_F(Endings, AFactorisationIsNotWaitedFor) {
  std::ofstream(folder_ / "stiff.json") << R"({"name": "stiff", "integrator": "backward-euler",
    "body": {"generate": {"box": {"cells": [30, 30, 30], "spacing": 0.01, "kind": "hexahedra"}}},
    "initial_velocity": {"linear": [[1, 0, 0], [0, -1, 0], [0, 0, 0]]},
    "step": 0.01, "duration": 1, "output": {"frames_every": 1}})";
  const pid_t child = start({"simulate", "stiff.json", "--out", "out"});
  ASSERT_TRUE(waits_for("out/frames.pvd", child));
  const double begun = cpu_seconds(child);
  while (cpu_seconds(child) < begun + 1.0) std::this_thread::sleep_for(5ms);
  const double asked = cpu_seconds(child);
  kill(child, SIGINT);
  int status = 0;
  rusage used{};
  wait4(child, &status, 0, &used);
  EXPECT_EQ(WIFEXITED(status) ? WEXITSTATUS(status) : -1, 130);
  const double ended = static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
                       1e-6 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
  EXPECT_LT(ended - asked, 2.0);
  const auto summary = nlohmann::json::parse(text("out/summary.json"));
  EXPECT_TRUE(summary.at("interrupted").get<bool>());
  EXPECT_EQ(summary.at("steps"), 0);
}

TEST_F(Endings, APictureThatCannotBeDrawnIsAnIoErrorAndTheResultsStay) {
  fs::create_directories(folder_ / "no programs");
  const std::string path = (folder_ / "no programs").string();
  EXPECT_EQ(ended(start({"simulate", "short.json", "--out", "drawn", "--picture"}, path)), 3);
  EXPECT_NE(text("printed.txt").find("no picture"), std::string::npos) << text("printed.txt");
  EXPECT_NE(text("printed.txt").find("gnuplot"), std::string::npos) << text("printed.txt");
  EXPECT_EQ(nlohmann::json::parse(text("drawn/summary.json")).at("steps"), 3);
  EXPECT_TRUE(fs::exists(folder_ / "drawn" / "picture.gnuplot"));
  // also where standard output is for JSON
  EXPECT_EQ(ended(start({"simulate", "short.json", "--out", "json", "--picture", "--json"}, path)), 3);
  EXPECT_EQ(nlohmann::json::parse(text("printed.txt")).at("steps"), 3);
  EXPECT_NE(text("errors.txt").find("no picture"), std::string::npos) << text("errors.txt");
  EXPECT_EQ(ended(start({"simulate", "short.json", "--out", "with", "--picture"})), 0);
}

TEST_F(Endings, APictureOfAStudyThatCannotBeDrawnIsAnIoErrorToo) {
  fs::create_directories(folder_ / "no programs");
  EXPECT_EQ(ended(start({"extremes", "--axis", "amplification", "--quick", "--out", "out"},
                        (folder_ / "no programs").string())),
            3);
  EXPECT_NE(text("errors.txt").find("no picture of amplification"), std::string::npos) << text("errors.txt");
  EXPECT_TRUE(fs::exists(folder_ / "out" / "amplification.dat"));
}

TEST_F(Endings, OfAPictureAndAVerdictTheVerdictCounts) {
  fs::create_directories(folder_ / "no programs");
  nlohmann::json scene = nlohmann::json::parse(short_run);
  scene["expect"] = {{"vertices", 3}};
  std::ofstream(folder_ / "wrong.json") << scene;
  EXPECT_EQ(ended(start({"simulate", "wrong.json", "--out", "out", "--picture"}, (folder_ / "no programs").string())),
            1);
}

TEST_F(Endings, WithoutCalculixItSaysWhichPackageHasIt) {
  fs::create_directories(folder_ / "no programs");
  EXPECT_EQ(ended(start({"validate", "elements", "--quick", "--with", "calculix"}, (folder_ / "no programs").string())),
            3);
  EXPECT_NE(text("errors.txt").find("--with calculix: no `ccx`"), std::string::npos) << text("errors.txt");
  EXPECT_NE(text("errors.txt").find("Debian package calculix-ccx"), std::string::npos) << text("errors.txt");
  EXPECT_EQ(text("printed.txt"), "");
}

// A program of that name that reports a displacement of a metre for every node.
TEST_F(Endings, ACalculixThatDisagreesIsADisagreementAndLeavesNoFiles) {
  fs::create_directories(folder_ / "bin");
  fs::create_directories(folder_ / "scratch");
  std::ofstream(folder_ / "bin" / "ccx") << R"(#!/bin/sh
if [ "$1" = -v ]; then echo "This is Version 0.1"; exit 201; fi
n=0
{ echo " displacements (vx,vy,vz) for set ALL and time  0.1000000E+01"
  while read -r line; do
    case $line in
      "*ELEMENT"*) break ;;
      "*"*) ;;
      *) n=$((n + 1)); echo "$n 0.000000E+00 0.000000E+00 1.000000E+00" ;;
    esac
  done < beam.inp; } > beam.dat
)";
  fs::permissions(folder_ / "bin" / "ccx", fs::perms::owner_all);
  setenv("TMPDIR", (folder_ / "scratch").c_str(), 1);
  const pid_t child =
      start({"validate", "elements", "--quick", "--with", "calculix", "--out", "out"}, (folder_ / "bin").string());
  unsetenv("TMPDIR");
  EXPECT_EQ(ended(child), 1) << text("errors.txt");
  for (const auto& claim : nlohmann::json::parse(text("out/claims.json"))) {
    const std::string id = claim.at("id");
    EXPECT_EQ(claim.at("verdict"), id.starts_with("elements-calculix") ? "falls short" : "holds") << id;
  }
  EXPECT_NE(text("out/findings.json").find("tetrahedra (C3D4)"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(text("out/manifest.json")).at("calculix"), "0.1");
  EXPECT_TRUE(fs::is_empty(folder_ / "scratch"));
}

TEST_F(Endings, WithoutIpctkItSaysWhatWasTriedAndWhatIsExpected) {
  fs::create_directories(folder_ / "bin");
  const std::vector<std::string> arguments{"validate", "contact", "--quick", "--with", "ipctk"};
  EXPECT_EQ(ended(start(arguments, (folder_ / "bin").string())), 3);
  EXPECT_NE(text("errors.txt").find("--with ipctk: no `python3` answers with its version (cannot start `python3 "),
            std::string::npos)
      << text("errors.txt");
  EXPECT_EQ(text("printed.txt"), "");
  // one without the module
  std::ofstream(folder_ / "bin" / "python3") << "#!/bin/sh\necho \"No module named 'ipctk'\" >&2\nexit 1\n";
  fs::permissions(folder_ / "bin" / "python3", fs::perms::owner_all);
  EXPECT_EQ(ended(start(arguments, (folder_ / "bin").string())), 3);
  for (const char* words : {"reference/ipctk/certify.py --version` ended with status 1, expected 0: No module named "
                            "'ipctk')",
                            "expected one on the PATH that imports ipctk (pip install ipctk)"})
    EXPECT_NE(text("errors.txt").find(words), std::string::npos) << text("errors.txt");
  EXPECT_EQ(text("printed.txt"), "");
}

TEST_F(Endings, AnIpctkThatAnswersNothingIsAnIoErrorAndLeavesNoFiles) {
  fs::create_directories(folder_ / "bin");
  fs::create_directories(folder_ / "scratch");
  std::ofstream(folder_ / "bin" / "python3") << R"(#!/bin/sh
if [ "$3" = --version ]; then echo "ipctk 0.1"; exit 0; fi
[ "$1 ${2##*/} $3 $4" = "-B certify.py questions.json answers.json" ] && [ -s "$3" ] && echo "{}" > "$4"
)";
  fs::permissions(folder_ / "bin" / "python3", fs::perms::owner_all);
  setenv("TMPDIR", (folder_ / "scratch").c_str(), 1);
  const pid_t child = start({"validate", "contact", "--quick", "--with", "ipctk"}, (folder_ / "bin").string());
  unsetenv("TMPDIR");
  EXPECT_EQ(ended(child), 3);
  EXPECT_NE(text("errors.txt").find("ipctk: its answers: no \"answers\"; expected 1 in a list"), std::string::npos)
      << text("errors.txt");
  EXPECT_TRUE(fs::is_empty(folder_ / "scratch"));
}

TEST_F(Endings, AnUnknownWitnessOfContactIsRefused) {
  EXPECT_EQ(ended(start({"validate", "contact", "--quick", "--with", "calculix"})), 2);
  EXPECT_NE(text("errors.txt").find("--with"), std::string::npos) << text("errors.txt");
}

TEST_F(Endings, WithoutAFolderResultsAreLeftWhereOneStands) {
  EXPECT_EQ(ended(start({"validate", "solvers", "--quick", "--only", "accuracy"})), 0) << text("errors.txt");
  const fs::path results = folder_ / "dartboard-results";
  ASSERT_TRUE(fs::is_directory(results));
  const fs::path run = fs::directory_iterator(results)->path();
  EXPECT_TRUE(run.filename().string().starts_with("solvers-")) << run;
  EXPECT_TRUE(fs::exists(run / "manifest.json"));
  std::vector<std::string> tables;
  const auto findings = nlohmann::json::parse(contents(run / "findings.json"));
  for (const auto& table : findings.at("parts").at(0).at("tables")) tables.push_back(table.at("name"));
  EXPECT_EQ(tables, (std::vector<std::string>{"accuracy", "indefinite"}));
  EXPECT_NE(text("printed.txt").find("Written to dartboard-results/solvers-"), std::string::npos);
}

TEST_F(Endings, OfTwoRunsInOneFolderOneGoesOn) {
  for (int pair = 0; pair < 10; ++pair) {
    const std::string out = "pair" + std::to_string(pair);
    const pid_t first = start({"simulate", "short.json", "--out", out});
    const pid_t second = start({"simulate", "short.json", "--out", out});
    std::vector<int> statuses{ended(first), ended(second)};
    std::ranges::sort(statuses);
    EXPECT_EQ(statuses, (std::vector{0, 3})) << out;
    EXPECT_EQ(nlohmann::json::parse(text(out + "/summary.json")).at("steps"), 3);
  }
}

}  // namespace
}  // namespace dartboard::endings_test
