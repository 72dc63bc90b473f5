#pragma once
// Capitals and small letters of ASCII, independent of the locale.

#include <string>
#include <string_view>

namespace dartboard {

std::string upper(std::string_view text);
std::string lower(std::string_view text);
/// Are the two equal except for capitals?
bool same_letters(std::string_view a, std::string_view b);

}  // namespace dartboard
