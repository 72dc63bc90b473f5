#include "benchmarks/cli/verb_names.h"

#include <algorithm>

namespace dartboard {

bool is_of_harness(std::string_view word) {
  return word.starts_with("measure") ||
         std::ranges::any_of(verb_names, [&](const VerbName& verb) { return verb.name == word && !verb.in_both; });
}

}  // namespace dartboard
