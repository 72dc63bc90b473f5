#pragma once
// Reading text by tokens and lines, with errors that say where, what was found, and what was expected.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

namespace dartboard {

/// Throw IoError "FILE:LINE: found; expected expected"; a line of 0 is left out.
[[noreturn]] void fail_at(const std::string& file, std::size_t line, std::string_view found, std::string_view expected);

/// The same "FILE: byte PLACE: ..." for what is no text; bytes are counted from 0.
[[noreturn]] void fail_at_byte(const std::string& file, std::size_t byte, std::string_view found,
                               std::string_view expected);

/// A token as messages print it: in quotes, shortened, with unprintable bytes as \xNN.
std::string in_quotes(std::string_view token);

/// What a reader looks for next, put together only when it has to be printed: "a coordinate of vertex 12".
struct Wanted {
  static constexpr std::uint64_t no_number = std::numeric_limits<std::uint64_t>::max();
  std::string_view what;
  std::uint64_t number = no_number;

  Wanted(const char* text) : what(text) {}  // implicit, so that calls read like the message
  Wanted(std::string_view text, std::uint64_t n) : what(text), number(n) {}
  std::string text() const;
};

/// Whether words may be in capitals, in small letters, or a mixture.
enum class LetterCase { as_given, any };

/// A text as a sequence of tokens separated by white space; a comment runs from `comment` to the end of its line.
/// Views that it returns point into the text, which must outlive them.
///
/// throws  IoError from every function that takes something, when it is not there
class TextScanner {
 public:
  static constexpr char no_comment = '\0';

  TextScanner(std::string_view text, std::string file, char comment = no_comment, std::size_t first_line = 1);

  /// Only white space and comments are left.
  bool at_end();
  /// Something is left before the end of the line that the last token stands on.
  bool more_on_line();
  /// Nothing but white space is on this line, and no comment.
  bool at_line_of_blanks() const;
  /// The next token, which stays where it is; empty at the end.
  std::string_view peek();

  std::string_view token(Wanted wanted);
  /// The rest of the current line, without its end and the white space around it; then moves to the next line.
  std::string_view rest_of_line();
  /// A text in double quotes, without them, which ends in its line; without quotes the rest of the line.
  std::string_view quoted_or_line(Wanted wanted);
  /// A finite number; the letter of its exponent is E, or Fortran's D. One that is too small for a double is zero; one
  /// that is too large is an error.
  double real(Wanted wanted);
  std::int64_t integer(Wanted wanted);
  /// A number of things, or the number of a thing: an integer that is not negative.
  std::uint64_t count(Wanted wanted);
  /// This word.
  void keyword(std::string_view word, LetterCase letters = LetterCase::as_given);

  /// The end of the line that the last token stands on, after which bytes begin that are no text.
  void line_end();
  /// So many bytes from here on, whatever they are.
  std::string_view bytes(std::uint64_t size, Wanted wanted);
  /// Go to where this text begins next, or to the end.
  void skip_to(std::string_view text);

  /// How much to reserve for `declared` things of at least `characters` each: never more than the text can hold,
  /// so that a small file cannot ask for a large amount of memory.
  std::size_t plausible(std::uint64_t declared, std::size_t characters) const;

  const std::string& file() const { return file_; }
  /// The line of the token taken last.
  std::size_t line() const { return token_line_; }
  /// How many bytes lie behind, and how many are left.
  std::size_t place() const { return at_; }
  std::size_t left() const { return text_.size() - at_; }

  [[noreturn]] void fail(std::string_view found, std::string_view expected) const;

 private:
  void skip_blank();
  void advance(std::size_t to);
  std::size_t token_end() const;

  std::string_view text_;
  std::string file_;
  char comment_;
  std::size_t at_ = 0;
  std::size_t line_;
  std::size_t token_line_;
};

}  // namespace dartboard
