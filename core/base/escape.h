#pragma once
// Strings from outside (names in scenes, file names, arguments) as text without any special effect: one function for
// each language that the program writes.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace dartboard {

/// One line for a terminal. Line breaks and other control characters, characters that reverse the direction of writing,
/// and bytes that are not UTF-8 are spelt out: "\n", "\x1b", "\u{202e}". The functions below begin with it.
std::string terminal_text(std::string_view text);

/// The same line with "?" for each character that a font lacks.
std::string font_text(std::string_view text, bool (*has)(std::uint32_t code));

/// Several lines for a terminal: line breaks stay.
std::string terminal_lines(std::string_view text);

/// A string constant of gnuplot, with its single quotes: in double quotes gnuplot runs any text between backquotes.
/// Apostrophes become typographic ones: at the beginning of a string, and where there are two, gnuplot takes a doubled
/// quote for the end.
std::string gnuplot_string(std::string_view text);

/// One word of a command that a user may copy into a shell. The program starts no shell.
std::string shell_word(std::string_view text);

/// Text between tags, or the value of an attribute; also for HTML.
std::string xml_text(std::string_view text);

/// A field of text in a CSV file (RFC 4180), in quotes where it needs them. An apostrophe is put before text that a
/// spreadsheet would compute.
std::string csv_field(std::string_view text);

/// A plain file name made of a name: letters, digits, '.', '-' and '_' stay, all others become '-'. Two names may
/// become the same.
std::string file_name_of(std::string_view name);

/// At most so many letters, "..." in place of the rest.
std::string shortened(std::string_view text, std::size_t most);

}  // namespace dartboard
