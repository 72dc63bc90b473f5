#pragma once
// A scanner of text by tokens and lines; its errors give the place, what was found, and what was expected.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

namespace dartboard {

/// Throw IoError "FILE:LINE: found; expected expected"; a line of 0 is left out.
[[noreturn]] void fail_at(const std::string& file, std::size_t line, std::string_view found, std::string_view expected);

/// Throw IoError "FILE: byte PLACE: ..." for binary data; bytes are counted from 0.
[[noreturn]] void fail_at_byte(const std::string& file, std::size_t byte, std::string_view found,
                               std::string_view expected);

/// A token as messages print it: in quotes, shortened, with unprintable bytes as \xNN.
std::string in_quotes(std::string_view token);

/// What a reader expects next, put together only when it has to be printed: "a coordinate of vertex 12".
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
/// throws  IoError from every function that takes something, when it does not follow
class TextScanner {
 public:
  static constexpr char no_comment = '\0';

  TextScanner(std::string_view text, std::string file, char comment = no_comment, std::size_t first_line = 1);

  /// Are only white space and comments left?
  bool at_end();
  /// Is a token left on the line of the last token?
  bool more_on_line();
  /// Is nothing but white space on this line, and no comment?
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
  /// A count, or the number of an item: an integer that is not negative.
  std::uint64_t count(Wanted wanted);
  /// Take this word.
  void keyword(std::string_view word, LetterCase letters = LetterCase::as_given);

  /// Take the end of the line of the last token, after which binary data begin.
  void line_end();
  /// The next `size` bytes, whatever their values.
  std::string_view bytes(std::uint64_t size, Wanted wanted);
  /// Go to the next occurrence of this text, or to the end.
  void skip_to(std::string_view text);

  /// The number of elements to reserve for `declared` ones of at least `characters` each: at most what the text can
  /// hold, so that a small file cannot ask for a large amount of memory.
  std::size_t plausible(std::uint64_t declared, std::size_t characters) const;

  const std::string& file() const { return file_; }
  /// The line of the token taken last.
  std::size_t line() const { return token_line_; }
  /// The numbers of bytes already read, and of those left.
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
