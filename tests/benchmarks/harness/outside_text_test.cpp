// Strings from outside, written by the harness and read back by the programs that consume the files.

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "benchmarks/figures/gnuplot.h"
#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/processes.h"
#include "benchmarks/harness/table.h"
#include "core/base/escape.h"
#include "tests/hostile/hostile_names.h"
#include "tests/support/folder_for_tests.h"

namespace dartboard::outside_text_test {
namespace {

TEST(JsonText, IsAsciiAndParsesWhateverTheBytes) {
  for (const std::string& name : many_hostile_names(3000)) {
    const std::string text = json_text(nlohmann::json{{"name", name}});
    EXPECT_TRUE(std::ranges::all_of(text, [](char c) { return c >= 0x20 && c < 0x7f; }));
    const auto back = nlohmann::json::parse(text).at("name").get<std::string>();
    // valid UTF-8 is unchanged
    try {
      (void)nlohmann::json(name).dump();
      EXPECT_EQ(back, name);
    } catch (const nlohmann::json::exception&) {
    }
  }
}

class GnuplotString : public FolderTest {};

TEST_F(GnuplotString, IsReadBackByGnuplotWhichRunsNothing) {
  std::string script = "set print '-'\n", expected;
  std::size_t count = 0;
  for (const std::string& name : many_hostile_names(300)) {
    if (name.size() > 5000) continue;  // longer than gnuplot's lines; titles are shortened
    script += "print " + gnuplot_string(name) + "\n";
    std::string shown = terminal_text(name);
    for (std::size_t at; (at = shown.find("]]>")) != shown.npos;) shown.insert(at + 2, " ");
    for (const char c : shown) expected += c == '\'' ? std::string("\xe2\x80\x99") : std::string(1, c);
    expected += '\n';
    ++count;
  }
  write_plot_file(folder_ / "strings.gnuplot", script);
  std::string printed;
  run_program(
      "gnuplot", {"strings.gnuplot"}, [&](std::string_view line) { printed += std::string(line) + "\n"; },
      Stderr::discarded, folder_);
  EXPECT_EQ(printed, expected);
  EXPECT_GT(count, 300u);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "canary"));
}

TEST_F(GnuplotString, OfTitlesRunsNothingEither) {
  std::string script = "set encoding utf8\nset print '-'\n";
  const auto names = many_hostile_names(100);
  for (const std::string& name : names) script += "print strlen(" + quoted_title(name, 300, 10.0) + ")\n";
  write_plot_file(folder_ / "titles.gnuplot", script);
  std::vector<int> lengths;
  run_program(
      "gnuplot", {"titles.gnuplot"}, [&](std::string_view line) { lengths.push_back(std::stoi(std::string(line))); },
      Stderr::shown, folder_);
  ASSERT_EQ(lengths.size(), names.size());
  // three lines of 35 letters of 8 pixels, the breaks between them, and dots
  EXPECT_LE(*std::ranges::max_element(lengths), 3 * 35 + 2 + 4);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "canary"));
}

TEST(Table, ShowsAnyNameOnOneLine) {
  for (const std::string& name : many_hostile_names(300)) {
    Table table({{"name"}, {"after"}});
    table.add_row({name, "x"});
    const std::string text = to_text(table);
    EXPECT_EQ(std::ranges::count(text, '\n'), 3) << name;
    EXPECT_LT(text.size(), 10000u);
  }
}

}  // namespace
}  // namespace dartboard::outside_text_test
