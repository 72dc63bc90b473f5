#pragma once
// Capitals and small letters of ASCII, whatever the locale.

#include <string>
#include <string_view>

namespace dartboard {

std::string upper(std::string_view text);
std::string lower(std::string_view text);
/// Equal but for capitals.
bool same_letters(std::string_view a, std::string_view b);

}  // namespace dartboard
