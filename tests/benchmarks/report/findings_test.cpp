#include "benchmarks/report/findings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>

#include "benchmarks/report/publish.h"
#include "benchmarks/report/report_page.h"
#include "core/plain/error.h"
#include "tests/support/folder_for_tests.h"

namespace dartboard::findings_test {
namespace {

class Findings : public FolderTest {
 protected:
  std::filesystem::path run() const { return folder_ / "run"; }
  void publish_quietly(const std::function<Report(StudyLog&)>& study) const {
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    try {
      publish({.label = "test", .out = run().string()}, study);
    } catch (const std::runtime_error&) {  // of a study that ends before its time
    }
    testing::internal::GetCapturedStdout();
    testing::internal::GetCapturedStderr();
  }
  void replace(const std::string& what, const std::string& by) const {
    std::string all = text("run/findings.json");
    const std::size_t at = all.find(what);
    ASSERT_NE(at, std::string::npos) << what;
    all.replace(at, what.size(), by);
    std::ofstream(run() / findings_name) << all;
  }
  std::string refusal() const {
    try {
      read_run(run());
      return "accepted";
    } catch (const IoError& error) {
      return error.what();
    }
  }
};

Report some_report() {
  Table table({{"body"}, {"value", Align::right}});
  table.add_row({"a <b> & c", "1.25"});
  Plot plot;
  plot.title = "A plot";
  plot.series = {{.title = "measured", .points = {{1.0, 2.0, "here"}, {3.0, NAN}}, .colour = "#123456"}};
  return {.opening = "An opening.",
          .tables = {{"t", "A heading", table, "A note.\n\n- one\n- two"}},
          .claims = {{.id = "one", .text = "a claim", .verdict = Verdict::holds},
                     {.id = "two", .text = "another", .verdict = Verdict::undecided, .reason = "too few"}},
          .limits = {"No body is round."},
          .pictures = {{"plot", plot}}};
}

TEST_F(Findings, HaveWhatTheTablesClaimsAndDiagramsOfAStudyShow) {
  publish_quietly([](StudyLog&) { return some_report(); });
  const nlohmann::json found = read_run(run());
  EXPECT_EQ(found["findings"]["label"], "test");
  EXPECT_EQ(found["manifest"]["quick"], false);
  const nlohmann::json& part = found["findings"]["parts"].at(0);
  EXPECT_EQ(part["tables"][0]["rows"], nlohmann::json::parse(R"([["a <b> & c", "1.25"]])"));
  EXPECT_EQ(part["tables"][0]["columns"][1]["right"], true);
  EXPECT_EQ(part["claims"][1]["reason"], "too few");
  EXPECT_EQ(part["diagrams"][0]["series"][0]["x"], nlohmann::json::parse("[1.0, 3.0]"));
  EXPECT_EQ(part["diagrams"][0]["series"][0]["y"], nlohmann::json::parse("[2.0, null]")) << "no number is no number";
}

TEST_F(Findings, AreShownByThePageOfTheRunWhichCanBeMadeAgain) {
  publish_quietly([](StudyLog&) { return some_report(); });
  const std::string page = text("run/report.html");
  for (const char* part :
       {"<td>a &lt;b&gt; &amp; c</td>", "<td class=right>1.25</td>", "An opening.", "<li>two</li>", "<code>two</code>",
        "too few", "<li>No body is round.</li>", "<figcaption>A plot</figcaption>"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  EXPECT_EQ(page.find("not come to its end"), std::string::npos);
  std::filesystem::remove(run() / report_name);
  ASSERT_EQ(write_report({run()}, run() / report_name), "");
  EXPECT_EQ(text("run/report.html"), page);
}

TEST_F(Findings, OfAStudyThatWasInterruptedAreItsCompleteParts) {
  publish_quietly([](StudyLog& log) -> Report {
    log.finished(some_report(), "first");
    throw std::runtime_error("interrupted");
  });
  const nlohmann::json found = read_run(run());
  ASSERT_EQ(found["findings"]["parts"].size(), 1u);
  EXPECT_EQ(found["findings"]["parts"][0]["folder"], "first");
  ASSERT_EQ(write_report({run()}, folder_ / "page.html"), "");
  EXPECT_NE(text("page.html").find("not come to its end"), std::string::npos);
  EXPECT_NE(text("page.html").find("href=\"run/first/claims.json\""), std::string::npos) << "from where the page is";
}

TEST_F(Findings, ThatAreDamagedAreNamedWithTheirLine) {
  publish_quietly([](StudyLog&) { return some_report(); });
  const std::string whole = text("run/findings.json");
  const std::size_t third = whole.find('\n', whole.find('\n') + 1) + 1;
  std::ofstream(run() / findings_name) << whole.substr(0, third + 8);
  EXPECT_NE(refusal().find("findings.json: line 3: "), std::string::npos) << refusal();
  std::ofstream(run() / findings_name) << whole;
  replace("\"version\": 1", "\"version\": 7");
  EXPECT_NE(refusal().find("has version 7 of its format, and this program reads 1"), std::string::npos) << refusal();
  std::ofstream(run() / findings_name) << whole;
  replace("\"version\": 1", "\"version\": [\"x\"]");
  EXPECT_NE(refusal().find("has version [\"x\"] of its format"), std::string::npos) << refusal();
  std::ofstream(run() / findings_name) << whole;
  replace("\"columns\"", "\"pillars\"");
  EXPECT_NE(write_report({run()}, folder_ / "page.html").find("its data are damaged"), std::string::npos);
  std::ofstream(run() / findings_name) << whole;
  replace("\"diagrams\"", "\"drawings\"");
  EXPECT_NE(refusal().find("diagrams"), std::string::npos) << refusal();
  std::filesystem::remove(run() / findings_name);
  EXPECT_NE(refusal().find("findings.json: is missing"), std::string::npos) << refusal();
}

}  // namespace
}  // namespace dartboard::findings_test
