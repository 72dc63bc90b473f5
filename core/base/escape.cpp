#include "core/base/escape.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace dartboard {
namespace {

constexpr std::uint32_t not_utf8 = 0xffffffff;

/// The character encoded by the bytes at a place, and their number.
struct Letter {
  std::uint32_t code;
  std::size_t bytes;
};

Letter letter_at(std::string_view text, std::size_t at) {
  const auto byte = [text](std::size_t k) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[k])); };
  const std::uint32_t first = byte(at);
  if (first < 0x80) return {first, 1};
  const std::size_t bytes = first >> 5 == 0x6 ? 2 : first >> 4 == 0xe ? 3 : first >> 3 == 0x1e ? 4 : 0;
  if (bytes == 0 || bytes > text.size() - at) return {not_utf8, 1};
  std::uint32_t code = first & (0x7fu >> bytes);
  for (std::size_t k = 1; k < bytes; ++k) {
    if (byte(at + k) >> 6 != 0x2) return {not_utf8, 1};
    code = code << 6 | (byte(at + k) & 0x3f);
  }
  // wrong are codes that are longer than necessary, halves of UTF-16 pairs, and codes beyond Unicode
  constexpr std::uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool good = code >= least[bytes] && (code < 0xd800 || code > 0xdfff) && code <= 0x10ffff;
  return good ? Letter{code, bytes} : Letter{not_utf8, 1};
}

/// Must it be spelt out? It is a control character, reverses the direction of writing, is a line break of Unicode, or
/// is refused by XML.
bool acts(std::uint32_t c) {
  return c < 0x20 || (c >= 0x7f && c < 0xa0) || c == 0x61c || c == 0x200e || c == 0x200f ||
         (c >= 0x2028 && c <= 0x202e) || (c >= 0x2066 && c <= 0x2069) || c == 0xfeff || c == 0xfffe || c == 0xffff;
}

std::string visible(std::string_view text, bool keep_line_breaks) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const auto [code, bytes] = letter_at(text, at);
    if (code == not_utf8)
      out += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[at]));
    else if (!acts(code) || (code == '\n' && keep_line_breaks))
      out += text.substr(at, bytes);
    else if (code == '\n' || code == '\r' || code == '\t')
      out += code == '\n' ? "\\n" : code == '\r' ? "\\r" : "\\t";
    else
      out += code < 0x80 ? fmt::format("\\x{:02x}", code) : fmt::format("\\u{{{:x}}}", code);
    at += bytes;
  }
  return out;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_ascii_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
/// A digit, an ASCII letter, or a byte of a character beyond ASCII.
bool is_word(char c) { return is_digit(c) || is_ascii_letter(c) || static_cast<unsigned char>(c) >= 0x80; }

}  // namespace

std::string terminal_text(std::string_view text) { return visible(text, false); }

std::string font_text(std::string_view text, bool (*has)(std::uint32_t code)) {
  const std::string line = terminal_text(text);
  std::string out;
  for (std::size_t at = 0; at < line.size();) {
    const auto [code, bytes] = letter_at(line, at);
    out += has(code) ? line.substr(at, bytes) : "?";
    at += bytes;
  }
  return out;
}

std::string terminal_lines(std::string_view text) { return visible(text, true); }

std::string gnuplot_string(std::string_view text) {
  std::string out = "'";
  for (const char c : terminal_text(text)) {
    if (c == '>' && out.ends_with("]]")) out += ' ';  // gnuplot copies it into its SVG, where XML forbids it
    out += c == '\'' ? std::string("\xe2\x80\x99") : std::string(1, c);
  }
  return out + "'";
}

std::string shell_word(std::string_view text) {
  std::string line = terminal_text(text);
  const auto plain = [](char c) {
    return is_word(c) || std::string_view("_./:=@%+,-").find(c) != std::string_view::npos;
  };
  if (!line.empty() && std::ranges::all_of(line, plain)) return line;
  std::string out = "'";
  for (const char c : line) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string xml_text(std::string_view text) {
  std::string out;
  for (const char c : terminal_text(text)) switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      case '\'': out += "&#39;"; break;
      default: out += c;
    }
  return out;
}

std::string csv_field(std::string_view text) {
  std::string field = terminal_text(text);
  if (!field.empty() && std::string_view("=+-@").find(field[0]) != std::string_view::npos) field.insert(0, 1, '\'');
  if (field.find_first_of(",;\"") == std::string::npos) return field;
  std::string out = "\"";
  for (const char c : field) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

std::string file_name_of(std::string_view name) {
  constexpr std::size_t most_bytes = 150;  // of 255, and endings follow
  std::string out;
  for (std::size_t at = 0; at < name.size() && out.size() < most_bytes;) {
    const auto [code, bytes] = letter_at(name, at);
    const bool stays = code == not_utf8 ? false
                       : code < 0x80    ? is_word(name[at]) || name[at] == '.' || name[at] == '-' || name[at] == '_'
                                        : !acts(code);
    out += stays ? std::string(name.substr(at, bytes)) : "-";
    at += bytes;
  }
  // no hidden file, no "..", no option
  if (out.empty() || out[0] == '.' || out[0] == '-') out.insert(0, 1, '_');
  return out;
}

std::string shortened(std::string_view text, std::size_t most) {
  std::size_t letters = 0, cut = 0;
  for (std::size_t at = 0; at < text.size(); ++letters) {
    if (letters + 3 == most) cut = at;
    if (letters == most) return std::string(text.substr(0, cut)) + "...";
    at += letter_at(text, at).bytes;
  }
  return std::string(text);
}

}  // namespace dartboard
