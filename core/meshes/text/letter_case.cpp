#include "core/meshes/text/letter_case.h"

#include <algorithm>

namespace dartboard {
namespace {

constexpr char to_upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }
constexpr char to_lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

std::string each(std::string_view text, char (*letter)(char)) {
  std::string out(text);
  std::ranges::transform(out, out.begin(), letter);
  return out;
}

}  // namespace

std::string upper(std::string_view text) { return each(text, to_upper); }
std::string lower(std::string_view text) { return each(text, to_lower); }

bool same_letters(std::string_view a, std::string_view b) { return std::ranges::equal(a, b, {}, to_upper, to_upper); }

}  // namespace dartboard
