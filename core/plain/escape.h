#pragma once
// Strings from outside (names in scenes, file names, arguments) as text that nothing acts on: one function for each
// language that the program writes.

#include <cstddef>
#include <string>
#include <string_view>

namespace dartboard {

/// One line for a terminal. Line breaks and other control characters, characters that turn the direction of writing
/// around, and bytes that are no UTF-8 are spelt out: "\n", "\x1b", "\u{202e}". The functions below begin with it.
std::string terminal_text(std::string_view text);

/// The same of a text of several lines, whose line breaks stay.
std::string terminal_lines(std::string_view text);

/// A string constant of gnuplot, quotes included. They are single ones: in double quotes gnuplot runs what stands
/// between backquotes. Apostrophes become typographic ones: at the beginning of a string, and where there are two,
/// gnuplot takes a doubled quote for the end.
std::string gnuplot_string(std::string_view text);

/// One word of a command that somebody may copy into a shell. We start none.
std::string shell_word(std::string_view text);

/// Text between tags, or the value of an attribute; of HTML too.
std::string xml_text(std::string_view text);

/// A field of text in a CSV file (RFC 4180), in quotes where it needs them. An apostrophe goes before what a
/// spreadsheet would compute.
std::string csv_field(std::string_view text);

/// Text within a line or a cell of a table of GitHub's Markdown: no link, emphasis, code, formula, tag or bar.
std::string markdown_text(std::string_view text);

/// The same where it begins a line: no heading, quotation, list or rule either.
std::string markdown_line(std::string_view text);

/// Code within a line of Markdown, its backquotes included.
std::string markdown_code(std::string_view text);

/// A plain file name made of a name: letters, digits, '.', '-' and '_' stay, what else there is becomes '-'. Of two
/// names both may become the same.
std::string file_name_of(std::string_view name);

/// At most so many letters, "..." in place of the rest.
std::string shortened(std::string_view text, std::size_t most);

}  // namespace dartboard
