#include "benchmarks/report/publish.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/report/measured.h"
#include "benchmarks/report/report_page.h"
#include "core/plain/error.h"
#include "tests/support/folder_for_tests.h"

namespace dartboard::publish_test {
namespace {

Claim claim(const std::string& id, Verdict verdict) {
  return {.id = id, .text = "a sentence on " + id, .verdict = verdict};
}

/// The output of a publication of a study, and its exit status.
struct Published {
  int status;
  std::string out, err;
};
Published published(const Publication& how, const std::function<Report(StudyLog&)>& study) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  int status = -1;
  std::exception_ptr error;
  try {
    status = publish(how, study);
  } catch (...) {
    error = std::current_exception();
  }
  std::string err = testing::internal::GetCapturedStderr(), out = testing::internal::GetCapturedStdout();
  if (error) std::rethrow_exception(error);
  return {status, std::move(out), std::move(err)};
}
Published printed(const Report& report, bool json = false) {
  return published({.label = "test", .keeps_folder = false, .json = json}, [&](StudyLog&) { return report; });
}

class Publish : public FolderTest {
 protected:
  std::filesystem::path out() const { return folder_ / "run"; }
  static nlohmann::json json_of(const std::filesystem::path& file) { return nlohmann::json::parse(contents(file)); }
  Published kept(const std::function<Report(StudyLog&)>& study, bool quick = false) {
    return published({.label = "test", .quick = quick, .out = out().string()}, study);
  }
};

Table one_cell(const std::string& text) {
  Table table({{"title"}});
  table.add_row({text});
  return table;
}

TEST(PublishStatus, IsThatOfTheClaims) {
  EXPECT_EQ(printed({}).status, 0);
  EXPECT_EQ(printed({.claims = {claim("one", Verdict::holds)}}).status, 0);
  EXPECT_EQ(printed({.claims = {claim("one", Verdict::holds), claim("two", Verdict::falls_short)}}).status, 1);
}
TEST(PublishStatus, IsOneForADisagreementWhateverTheClaims) {
  EXPECT_EQ(printed({.claims = {claim("one", Verdict::holds)}, .disagreements = {"They differ."}}).status, 1);
}
TEST(PublishStatus, IsThreeForAMissingPictureWhereAllElseIsWell) {
  EXPECT_EQ(printed({.troubles = {"no gnuplot"}}).status, 3);
  EXPECT_EQ(printed({.disagreements = {"They differ."}, .troubles = {"no gnuplot"}}).status, 1);
}
TEST(PublishStatus, CountsPartsThatWereFinishedBefore) {
  const auto study = [](const Report& part) {
    return [part](StudyLog& log) {
      log.finished(part);
      log.finished({.claims = {claim("fine", Verdict::holds)}}, "");
      return Report{.claims = {claim("last", Verdict::holds)}};
    };
  };
  const Publication how{.label = "test", .keeps_folder = false};
  EXPECT_EQ(published(how, study({})).status, 0);
  EXPECT_EQ(published(how, study({.claims = {claim("one", Verdict::falls_short)}})).status, 1);
  EXPECT_EQ(published(how, study({.disagreements = {"They differ."}})).status, 1);
  EXPECT_EQ(published(how, study({.troubles = {"no gnuplot"}})).status, 3);
}

TEST(PublishText, HasWhatTheReportHoldsInItsOrder) {
  const Report report{.opening = "An opening.",
                      .tables = {{"t", "A heading", one_cell("a cell"), "A note."}},
                      .claims = {claim("one", Verdict::holds)},
                      .disagreements = {"They differ."}};
  const std::string text = printed(report).out;
  std::size_t last = 0;
  for (const char* piece :
       {"An opening.", "A heading", "a cell", "A note.", "a sentence on one", "They differ.", "1 claim holds."}) {
    const std::size_t at = text.find(piece, last);
    ASSERT_NE(at, std::string::npos) << piece << " in\n" << text;
    last = at;
  }
}
TEST(PublishText, EndsWithTheSentenceOfTheReportIfItHasOne) {
  const std::string text = printed({.claims = {claim("one", Verdict::holds)}, .sentence = "All is well."}).out;
  EXPECT_TRUE(text.ends_with("All is well.\n")) << text;
  EXPECT_EQ(text.find("1 claim holds"), std::string::npos);
}
TEST(PublishText, LeavesOutWhatIsSilent) {
  const auto [status, out, err] =
      printed({.silent = true, .opening = "An opening.", .claims = {claim("one", Verdict::falls_short)}});
  EXPECT_EQ(out.find("An opening."), std::string::npos);
  EXPECT_EQ(status, 1);
}

TEST(PublishJson, IsAloneOnStandardOutputWithNumbersAndClaims) {
  const Report report{.opening = "An opening.",
                      .claims = {claim("one", Verdict::holds)},
                      .numbers = {{"answer", 42}},
                      .sentence = "All is well."};
  const auto [status, out, err] = printed(report, true);
  const auto json = nlohmann::json::parse(out);
  EXPECT_EQ(json["answer"], 42);
  EXPECT_EQ(json["claims"][0]["id"], "one");
  EXPECT_NE(err.find("An opening."), std::string::npos);
  EXPECT_NE(err.find("All is well."), std::string::npos);
}

TEST_F(Publish, WritesManifestFindingsDataSamplesAndClaims) {
  const auto [status, text, err] = kept(
      [&](StudyLog& log) {
        EXPECT_TRUE(std::filesystem::exists(out() / "manifest.json")) << "from the start on";
        log.sample({{"k", 1}});
        EXPECT_EQ(contents(out() / "samples.jsonl"), "{\"k\":1}\n") << "at once";
        log.sample({{"k", 2}});
        return Report{.tables = {{"cells", "A heading", one_cell("a cell"), "A note."},
                                 {.name = "long", .table = one_cell("not for a terminal"), .on_page = true}},
                      .claims = {claim("one", Verdict::holds)},
                      .data_files = {{"numbers.json", {{"answer", 42}}}},
                      .facts = {{"cpu_s", 3}}};
      },
      true);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(contents(out() / "samples.jsonl"), "{\"k\":1}\n{\"k\":2}\n");
  const std::string page = contents(out() / "report.html");
  for (const char* piece : {"A heading", "a cell", "A note.", "not for a terminal"})
    EXPECT_NE(page.find(piece), std::string::npos) << piece;
  for (const char* piece : {"A heading", "a cell", "A note."}) EXPECT_NE(text.find(piece), std::string::npos) << text;
  EXPECT_EQ(text.find("not for a terminal"), std::string::npos) << text;
  EXPECT_EQ(json_of(out() / "numbers.json")["answer"], 42);
  EXPECT_EQ(json_of(out() / "claims.json").size(), 1u);
  const auto manifest = json_of(out() / "manifest.json");
  EXPECT_EQ(manifest["quick"], true);
  EXPECT_TRUE(manifest.contains("finished"));
  EXPECT_EQ(manifest["cpu_s"], 3);
  EXPECT_NE(text.find("This was a quick run. 1 claim holds."), std::string::npos) << text;
  EXPECT_NE(text.find("Written to " + out().string()), std::string::npos) << text;
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& file : std::filesystem::directory_iterator(out())) ++files;
  EXPECT_EQ(files, 6u);
}

TEST_F(Publish, KeepsThePartsOfAFolderWithinAndCountsThemInTheWhole) {
  kept([](StudyLog& log) {
    log.finished({.claims = {claim("first", Verdict::holds)}});
    log.sample({{"k", 1}}, "runs.jsonl", "inner");
    log.finished({.tables = {{"cells", "A heading", one_cell("a cell")}}}, "inner");
    log.finished({.claims = {claim("second", Verdict::holds)}}, "inner");
    log.finished({.claims = {claim("third", Verdict::holds)}}, "inner");
    return Report{.claims = {claim("fourth", Verdict::holds)}};
  });
  std::vector<std::string> all, inner;
  for (const auto& c : json_of(out() / "claims.json")) all.push_back(c["id"]);
  for (const auto& c : json_of(out() / "inner/claims.json")) inner.push_back(c["id"]);
  EXPECT_EQ(all, (std::vector<std::string>{"first", "second", "third", "fourth"}));
  EXPECT_EQ(inner, (std::vector<std::string>{"second", "third"}));
  EXPECT_TRUE(std::filesystem::exists(out() / "inner/runs.jsonl"));
}

TEST_F(Publish, KeepsWhatWasFinishedWhenTheRestFails) {
  EXPECT_THROW(kept([](StudyLog& log) -> Report {
                 log.finished({.claims = {claim("first", Verdict::holds)}});
                 throw std::runtime_error("the rest");
               }),
               std::runtime_error);
  EXPECT_EQ(json_of(out() / "claims.json").size(), 1u);
}

TEST_F(Publish, DrawsThePictures) {
  Plot plot;
  plot.title = plot.x_axis = plot.y_axis = "a word";
  plot.series.resize(1);
  plot.series[0].points = {{2.0, 3.0}};
  plot.series[0].colour = "#000000";
  EXPECT_EQ(kept([&](StudyLog&) { return Report{.pictures = {{"diagram", plot}}}; }).status, 0);
  EXPECT_TRUE(std::filesystem::exists(out() / "diagram.png"));
}

// ---- interrupted studies

const std::vector<std::string> listing{"--gtest_list_tests", "--gtest_filter=PublishStatus.IsThatOfTheClaims"};

/// The lines of a process of its own; the study ends before its time if `fails`.
std::function<Report(StudyLog&)> listed(std::vector<std::string>& lines, bool fails = false) {
  return [&lines, fails](StudyLog& log) {
    log.run(listing, [&](std::string_view line) { lines.emplace_back(line); });
    if (fails) throw std::runtime_error("ended");
    return Report{};
  };
}

TEST_F(Publish, KeepsTheLinesOfFinishedProcessesAndPacksThemWhenTheStudyHasEnded) {
  std::vector<std::string> lines;
  EXPECT_THROW(kept(listed(lines, true)), std::runtime_error);
  ASSERT_FALSE(lines.empty());
  EXPECT_NE(text("run/measured.jsonl").find("PublishStatus."), std::string::npos);
  std::filesystem::remove_all(out());
  kept(listed(lines));
  EXPECT_FALSE(std::filesystem::exists(out() / "measured.jsonl"));
  EXPECT_TRUE(std::filesystem::exists(out() / packed_measured_name));
}

TEST_F(Publish, TakesFinishedProcessesFromAnInterruptedStudyAndRunsTheOthers) {
  std::vector<std::string> lines, again;
  EXPECT_THROW(kept(listed(lines, true)), std::runtime_error);
  const std::string file = (out() / "measured.jsonl").string(), found = text("run/measured.jsonl");
  std::string changed = found;
  changed.replace(changed.rfind("PublishStatus."), 14, "TakenFromThere");
  std::ofstream(file) << changed << R"({"arguments": ["tor)";  // the program was ended while it wrote
  const Publication how{.label = "test", .out = (folder_ / "second").string(), .continues = out().string()};
  const Published second = published(how, listed(again));
  EXPECT_NE(std::ranges::find(again, "TakenFromThere"), again.end());
  EXPECT_NE(second.out.find("1 finished process taken from "), std::string::npos) << second.out;
  EXPECT_EQ(json_of(folder_ / "second" / "manifest.json")["continues"]["processes"], 1);
  // arguments that are not there are run
  again.clear();
  changed.replace(changed.find("IsThatOf"), 8, "IsAnyOf.");
  std::ofstream(file) << changed;
  const Publication third{.label = "test", .out = (folder_ / "third").string(), .continues = out().string()};
  published(third, listed(again));
  EXPECT_EQ(again, lines);
}

TEST_F(Publish, ContinuesOnlyTheSameStudyOfTheSameBuildThatHasNotEnded) {
  std::vector<std::string> lines;
  EXPECT_THROW(kept(listed(lines, true)), std::runtime_error);
  const std::string file = (out() / "measured.jsonl").string();
  const std::string kept_before = text("run/measured.jsonl");
  std::string changed = kept_before;
  char& digit = changed[changed.find("fnv1a64:") + 8];
  digit = digit == '0' ? '1' : '0';
  std::ofstream(file) << changed;
  const Publication how{.label = "test", .keeps_folder = false, .continues = out().string()};
  EXPECT_THROW(published(how, listed(lines)), IoError);
  std::ofstream(file) << kept_before;
  Publication other = how;
  other.quick = true;
  EXPECT_THROW(published(other, listed(lines)), IoError);
  other = how;
  other.label = "other";
  EXPECT_THROW(published(other, listed(lines)), IoError);
  EXPECT_EQ(published(how, listed(lines)).status, 0);
  std::filesystem::remove(file);
  EXPECT_THROW(published(how, listed(lines)), IoError);
}

// ---- studies derived again

/// Measures a value that is another one each time, and a process that fails.
struct Measuring {
  int found = 0;
  Report operator()(StudyLog& log) {
    Table table({{"value"}, {"failure"}});
    const int value = log.once("a value", [this] { return ++found; });
    std::string failure = "none";
    try {
      log.run({"--gtest_filter=-*", "--gtest_fail_if_no_test_linked", "--gtest_shuffle", "--gtest_nonsense"},
              [](std::string_view) {});
    } catch (const ProcessError& error) {
      failure = error.what();
    }
    log.sample({{"value", value}});
    table.add_row({std::to_string(value), failure});
    return {.tables = {{"t", "A value", table}}};
  }
};

TEST_F(Publish, DerivesAStudyAgainFromWhatItHadMeasured) {
  Measuring study;
  kept(std::ref(study));
  const Publication how{.label = "test", .out = (folder_ / "again").string(), .derives = out().string()};
  published(how, std::ref(study));
  EXPECT_EQ(study.found, 1);
  for (const char* file : {"samples.jsonl", "findings.json", packed_measured_name})
    EXPECT_EQ(text(std::string("again/") + file), text(std::string("run/") + file)) << file;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "again" / report_name))
      << "a page has links, and is made in its place";
}

TEST_F(Publish, DerivesNothingFromOutputsThatAreNotThoseOfTheStudy) {
  kept([](StudyLog& log) {
    log.once("a value", [] { return 1; });
    return Report{};
  });
  const Publication how{.label = "test", .out = (folder_ / "again").string(), .derives = out().string()};
  const auto refusal = [&](const std::function<Report(StudyLog&)>& study) -> std::string {
    std::filesystem::remove_all(folder_ / "again");
    try {
      published(how, study);
      return "none";
    } catch (const IoError& error) {
      return error.what();
    }
  };
  const auto asks = [](const char* what) {
    return [what](StudyLog& log) {
      log.once(what, [] { return 1; });
      return Report{};
    };
  };
  EXPECT_EQ(refusal(asks("a value")), "none");
  EXPECT_NE(refusal(asks("another")).find("has no output of `another`"), std::string::npos);
  EXPECT_NE(refusal([](StudyLog&) { return Report{}; }).find("has 1 output that"), std::string::npos);
  // cut off
  std::filesystem::resize_file(out() / packed_measured_name,
                               std::filesystem::file_size(out() / packed_measured_name) - 9);
  EXPECT_NE(refusal(asks("a value")).find("measured.jsonl.gz: is cut off or damaged after line "), std::string::npos);
  std::ofstream(out() / packed_measured_name) << R"({"study": {"label": "test", "quick": false, "seeds": {}}})"
                                              << "\n{\"arguments\": 3}\n";
  EXPECT_NE(refusal(asks("a value")).find("measured.jsonl.gz:2: is no output of a process"), std::string::npos);
}

}  // namespace
}  // namespace dartboard::publish_test
