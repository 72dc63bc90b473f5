// Each function is read back by a reader of its language, or removes all that the language acts on.

#include "core/base/escape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>

#include "tests/hostile/hostile_names.h"

namespace dartboard::escape_test {
namespace {

constexpr std::size_t drawn = 3000;

/// The remaining bytes that are no UTF-8, or that a terminal acts on; empty if there are none.
std::string active_in(const std::string& text) {
  try {
    (void)nlohmann::json(text).dump();  // refuses invalid UTF-8
  } catch (const nlohmann::json::exception& error) {
    return error.what();
  }
  for (const char c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) return "a control character";
  for (std::size_t k = 0; k + 1 < text.size(); ++k)
    if (text[k] == '\xc2' && static_cast<unsigned char>(text[k + 1]) < 0xa0) return "a control character beyond ASCII";
  for (const char* mark : {"\xe2\x80\xa8", "\xe2\x80\xa9", "\xe2\x80\xaa", "\xe2\x80\xab", "\xe2\x80\xac",
                           "\xe2\x80\xad", "\xe2\x80\xae", "\xe2\x81\xa6", "\xe2\x81\xa9", "\xef\xbb\xbf"})
    if (text.find(mark) != std::string::npos) return "a mark of direction";
  return "";
}

TEST(TerminalText, SpellsOutWhatATerminalActsOn) {
  EXPECT_EQ(terminal_text("a\nb\tc\rd"), "a\\nb\\tc\\rd");
  EXPECT_EQ(terminal_text("\x1b[2J\x7f"), "\\x1b[2J\\x7f");
  EXPECT_EQ(terminal_text("\xc2\x9b\xe2\x80\xae"), "\\u{9b}\\u{202e}");
  EXPECT_EQ(terminal_text("\xff\xc3"), "\\xff\\xc3");
  EXPECT_EQ(terminal_lines("a\nb\x1b"), "a\nb\\x1b");
}

TEST(TerminalText, LeavesWordsOfEveryAlphabetAlone) {
  for (const std::string text : {"liver_cut", "\xc3\xa9t\xc3\xa9 \xe2\x82\xac", "\xf0\x9f\x98\x80", "a\\b `c` 100 %"})
    EXPECT_EQ(terminal_text(text), text);
}

TEST(TerminalText, LeavesNothingThatActsInAnyName) {
  for (const std::string& name : many_hostile_names(drawn)) {
    EXPECT_EQ(active_in(terminal_text(name)), "");
    EXPECT_EQ(terminal_text(terminal_text(name)), terminal_text(name));
    std::string lines = terminal_lines(name);
    EXPECT_EQ(std::ranges::count(lines, '\n'), std::ranges::count(name, '\n'));
    std::erase(lines, '\n');
    EXPECT_EQ(active_in(lines), "");
  }
}

TEST(GnuplotStringText, HasNoSingleQuoteOfItsOwn) {
  EXPECT_EQ(gnuplot_string("it's `here`"),
            "'it\xe2\x80\x99s `here`'");  // single quotes: backquotes have no effect in them
  for (const std::string& name : many_hostile_names(drawn)) {
    const std::string text = gnuplot_string(name);
    EXPECT_EQ(std::ranges::count(text, '\''), 2) << text;
    EXPECT_TRUE(text.front() == '\'' && text.back() == '\'') << text;
  }
}

TEST(GnuplotStringText, HasNoEndOfACharacterSectionWhichXmlForbids) {
  EXPECT_EQ(gnuplot_string("a]]>b ]> >"), "'a]] >b ]> >'");
}

TEST(ShellWord, IsQuotedWhereAShellWouldAct) {
  EXPECT_EQ(shell_word("results/disagreement-box-1.txt"), "results/disagreement-box-1.txt");
  EXPECT_EQ(shell_word("a b"), "'a b'");
  EXPECT_EQ(shell_word("$(touch canary)"), "'$(touch canary)'");
  EXPECT_EQ(shell_word("it's"), "'it'\\''s'");
  EXPECT_EQ(shell_word(""), "''");
}

TEST(XmlText, KnowsTheFiveThatAct) {
  EXPECT_EQ(xml_text("<a href=\"x\">'&'"), "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39;");
}

TEST(XmlText, IsReadBackEntityByEntity) {
  static const std::regex entity("&(amp|lt|gt|quot|#39);");
  for (const std::string& name : many_hostile_names(drawn)) {
    if (name.size() > 5000) continue;  // a regular expression of the standard library recurses
    const std::string text = xml_text(name), without = std::regex_replace(text, entity, "");
    EXPECT_EQ(without.find_first_of("<>&\"'"), std::string::npos) << text;
    std::string back = text;
    for (const auto& [from, to] :
         {std::pair("&lt;", "<"), {"&gt;", ">"}, {"&quot;", "\""}, {"&#39;", "'"}, {"&amp;", "&"}})
      for (std::size_t at = 0; (at = back.find(from, at)) != std::string::npos; ++at)
        back.replace(at, std::string_view(from).size(), to);
    EXPECT_EQ(back, terminal_text(name));
  }
}

/// RFC 4180: the fields of one row.
std::vector<std::string> fields_of(const std::string& row) {
  std::vector<std::string> fields(1);
  for (std::size_t k = 0; k < row.size();) {
    if (row[k] == ',') {
      fields.emplace_back();
      ++k;
    } else if (row[k] == '"' && fields.back().empty()) {
      for (++k; k < row.size(); ++k) {
        if (row[k] == '"' && (k + 1 == row.size() || row[k + 1] != '"')) break;
        if (row[k] == '"') ++k;
        fields.back() += row[k];
      }
      ++k;
    } else {
      fields.back() += row[k++];
    }
  }
  return fields;
}

TEST(CsvField, IsReadBackAndComputesNothing) {
  for (const std::string& name : many_hostile_names(drawn)) {
    const auto fields = fields_of("before," + csv_field(name) + ",after");
    ASSERT_EQ(fields.size(), 3u) << name;
    const bool formula = !name.empty() && std::string("=+-@").find(name[0]) != std::string::npos;
    EXPECT_EQ(fields[1], (formula ? "'" : "") + terminal_text(name));
    EXPECT_EQ(fields[2], "after");
  }
}

TEST(FileNameOf, IsAPlainNameWhateverTheName) {
  EXPECT_EQ(file_name_of("liver_cut-2.1"), "liver_cut-2.1");
  EXPECT_EQ(file_name_of("a b/c"), "a-b-c");
  EXPECT_EQ(file_name_of(".."), "_..");
  EXPECT_EQ(file_name_of("-e x"), "_-e-x");
  EXPECT_EQ(file_name_of(""), "_");
  EXPECT_EQ(file_name_of("br\xc3\xbc"
                         "cke"),
            "br\xc3\xbc"
            "cke");
  for (const std::string& name : many_hostile_names(drawn)) {
    const std::string file = file_name_of(name);
    EXPECT_EQ(active_in(file), "");
    EXPECT_EQ(file.find_first_of("/ `$(){}'\"\\<>|&;%@=*!#^,:"), std::string::npos) << file;
    EXPECT_LE(file.size(), 160u);
    EXPECT_TRUE(file[0] != '.' && file[0] != '-') << file;
  }
}

TEST(Shortened, CountsLettersAndCutsBetweenThem) {
  EXPECT_EQ(shortened("abcdef", 6), "abcdef");
  EXPECT_EQ(shortened("abcdefg", 6), "abc...");
  EXPECT_EQ(shortened("\xc3\xa9\xc3\xa9\xc3\xa9\xc3\xa9\xc3\xa9\xc3\xa9", 5), "\xc3\xa9\xc3\xa9...");
  EXPECT_EQ(shortened(std::string(100000, 'a'), 100).size(), 100u);
}

}  // namespace
}  // namespace dartboard::escape_test
