#include "core/meshes/text/text_scanner.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>

#include "core/meshes/text/letter_case.h"
#include "core/plain/error.h"

namespace dartboard {
namespace {

// not std::isspace: that one depends on the locale
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f'; }

// from_chars takes no leading plus, which some writers print
std::string_view without_plus(std::string_view token) {
  if (token.size() > 1 && token[0] == '+' && token[1] != '-' && token[1] != '+') token.remove_prefix(1);
  return token;
}

// Fortran marks the exponent of a double by a D: 1.0D+00
std::string_view with_e(std::string_view digits, std::string& copy) {
  const auto d = digits.find_first_of("dD");
  if (d == digits.npos || d == 0 || !(digits[d - 1] == '.' || (digits[d - 1] >= '0' && digits[d - 1] <= '9')))
    return digits;
  copy = digits;
  copy[d] = 'e';
  return copy;
}

// from_chars reports "out of range" both for 1e999 and for 1e-999
bool is_tiny(std::string_view number) {
  const auto e = number.find_first_of("eEdD");
  return e != number.npos && e + 1 < number.size() && number[e + 1] == '-';
}

}  // namespace

void fail_at(const std::string& file, std::size_t line, std::string_view found, std::string_view expected) {
  const std::string place = line == 0 ? file : fmt::format("{}:{}", file, line);
  throw IoError(fmt::format("{}: {}; expected {}", place, found, expected));
}

void fail_at_byte(const std::string& file, std::size_t byte, std::string_view found, std::string_view expected) {
  throw IoError(fmt::format("{}: byte {}: {}; expected {}", file, byte, found, expected));
}

std::string in_quotes(std::string_view token) {
  constexpr std::size_t longest = 40;
  std::string out = "'";
  for (char c : token.substr(0, longest)) {
    if (c >= ' ' && c <= '~')
      out += c;
    else
      out += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
  }
  return out + (token.size() > longest ? "...'" : "'");
}

std::string Wanted::text() const {
  return number == no_number ? std::string(what) : fmt::format("{} {}", what, number);
}

TextScanner::TextScanner(std::string_view text, std::string file, char comment, std::size_t first_line)
    : text_(text), file_(std::move(file)), comment_(comment), line_(first_line), token_line_(first_line) {
  if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;  // a byte order mark
}

void TextScanner::skip_blank() {
  for (; at_ < text_.size(); ++at_) {
    if (comment_ != no_comment && text_[at_] == comment_) at_ = std::min(text_.find('\n', at_), text_.size());
    if (at_ == text_.size() || !is_blank(text_[at_])) return;
    if (text_[at_] == '\n') ++line_;
  }
}

std::size_t TextScanner::token_end() const {
  std::size_t end = at_;
  while (end < text_.size() && !is_blank(text_[end]) && (comment_ == no_comment || text_[end] != comment_)) ++end;
  return end;
}

bool TextScanner::at_end() {
  skip_blank();
  return at_ == text_.size();
}

bool TextScanner::more_on_line() {
  while (at_ < text_.size() && text_[at_] != '\n' && is_blank(text_[at_])) ++at_;
  return at_ < text_.size() && text_[at_] != '\n' && (comment_ == no_comment || text_[at_] != comment_);
}

bool TextScanner::at_line_of_blanks() const {
  std::size_t at = at_;
  while (at < text_.size() && text_[at] != '\n' && is_blank(text_[at])) ++at;
  return at == text_.size() || text_[at] == '\n';
}

std::string_view TextScanner::peek() {
  skip_blank();
  return text_.substr(at_, token_end() - at_);
}

std::string_view TextScanner::token(Wanted wanted) {
  const std::string_view found = peek();
  // at the end the line stays that of the last token, which the missing one should follow
  if (found.empty()) fail("the text ends here", wanted.text());
  token_line_ = line_;
  at_ += found.size();
  return found;
}

std::string_view TextScanner::rest_of_line() {
  const std::size_t end = std::min(text_.find('\n', at_), text_.size());
  std::string_view found = text_.substr(at_, end - at_);
  while (!found.empty() && is_blank(found.front())) found.remove_prefix(1);
  while (!found.empty() && is_blank(found.back())) found.remove_suffix(1);
  token_line_ = line_;
  at_ = end;
  if (at_ < text_.size()) {
    ++at_;
    ++line_;
  }
  return found;
}

double TextScanner::real(Wanted wanted) {
  const std::string_view found = token(wanted);
  std::string copy;
  const std::string_view digits = with_e(without_plus(found), copy);
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool whole = end == digits.data() + digits.size();
  if (whole && error == std::errc::result_out_of_range && is_tiny(digits)) return 0.0;
  if (whole && error == std::errc::result_out_of_range)
    fail(fmt::format("{} is too large for a double", in_quotes(found)), wanted.text());
  if (!whole || error != std::errc{}) fail(fmt::format("{} is not a number", in_quotes(found)), wanted.text());
  if (!std::isfinite(value)) fail(fmt::format("{} is not finite", in_quotes(found)), wanted.text());
  return value;
}

std::int64_t TextScanner::integer(Wanted wanted) {
  const std::string_view found = token(wanted);
  const std::string_view digits = without_plus(found);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool whole = end == digits.data() + digits.size();
  if (whole && error == std::errc::result_out_of_range)
    fail(fmt::format("{} is out of the range of integers", in_quotes(found)), wanted.text());
  if (!whole || error != std::errc{}) fail(fmt::format("{} is not an integer", in_quotes(found)), wanted.text());
  return value;
}

std::uint64_t TextScanner::count(Wanted wanted) {
  const std::int64_t value = integer(wanted);
  if (value < 0) fail(fmt::format("{} is negative", value), wanted.text());
  return static_cast<std::uint64_t>(value);
}

std::string_view TextScanner::quoted_or_line(Wanted wanted) {
  if (at_end()) fail("the text ends here", wanted.text());
  token_line_ = line_;
  if (text_[at_] != '"') return rest_of_line();
  const std::size_t end = text_.find_first_of("\"\n", at_ + 1);
  if (end == text_.npos || text_[end] == '\n') fail("a text in quotes has no end in its line", "a quote after it");
  const std::string_view found = text_.substr(at_ + 1, end - at_ - 1);
  at_ = end + 1;
  return found;
}

void TextScanner::keyword(std::string_view word, LetterCase letters) {
  const std::string wanted = fmt::format("the word {}", word);
  const std::string_view found = token(wanted.c_str());
  if (letters == LetterCase::any ? !same_letters(found, word) : found != word)
    fail(fmt::format("found {}", in_quotes(found)), wanted);
}

void TextScanner::line_end() {
  while (at_ < text_.size() && text_[at_] != '\n' && is_blank(text_[at_])) ++at_;
  if (at_ == text_.size() || text_[at_] != '\n')
    fail(fmt::format("{} follows", in_quotes(text_.substr(at_, 1))), "the end of the line, and binary data after it");
  advance(at_ + 1);
}

std::string_view TextScanner::bytes(std::uint64_t size, Wanted wanted) {
  if (size > left()) fail_at_byte(file_, at_, fmt::format("{} bytes are left", left()), wanted.text());
  const std::string_view found = text_.substr(at_, static_cast<std::size_t>(size));
  advance(at_ + found.size());
  return found;
}

void TextScanner::skip_to(std::string_view text) { advance(std::min(text_.find(text, at_), text_.size())); }

// editors count the line ends among bytes too
void TextScanner::advance(std::size_t to) {
  line_ += static_cast<std::size_t>(std::ranges::count(text_.substr(at_, to - at_), '\n'));
  at_ = to;
}

std::size_t TextScanner::plausible(std::uint64_t declared, std::size_t characters) const {
  const std::size_t most = (text_.size() - at_) / characters + 1;
  return static_cast<std::size_t>(std::min<std::uint64_t>(declared, most));
}

void TextScanner::fail(std::string_view found, std::string_view expected) const {
  fail_at(file_, token_line_, found, expected);
}

}  // namespace dartboard
