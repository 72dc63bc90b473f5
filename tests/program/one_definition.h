#pragma once
// Definitions of the sources at namespace scope, by full name: read from the text, without compiling it.

#include <map>
#include <set>
#include <string>
#include <string_view>

namespace dartboard {

/// "dartboard::Mesh" and its place. The name of a function ends with the types and names of its parameters.
using Definitions = std::map<std::string, std::set<std::string>>;

/// Adds the types, aliases, concepts, functions and inline variables that a source defines and that other sources could
/// define differently: those in unnamed namespaces and static ones are its own. Members of a class are distinguished by
/// the name of the class.
///
/// pre  the text compiles, and macros open or close no braces
void add_definitions(std::string_view text, const std::string& file, Definitions& found);

}  // namespace dartboard
