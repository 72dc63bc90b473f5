#pragma once
// What the sources define at namespace scope, by its full name: read from the text, without compiling it.

#include <map>
#include <set>
#include <string>
#include <string_view>

namespace dartboard {

/// "dartboard::Mesh" and where it stands. Of functions the name ends with the types and names of their parameters.
using Definitions = std::map<std::string, std::set<std::string>>;

/// Adds the types, aliases, concepts, functions and inline variables that a source defines and that other sources could
/// define differently: those in unnamed namespaces and static ones are its own. What stands within a class is told from
/// others by the class.
///
/// pre  the text compiles, and macros open or close no braces
void add_definitions(std::string_view text, const std::string& file, Definitions& found);

}  // namespace dartboard
