#pragma once

#include <string>

#include "core/plain/error.h"
#include "validation/conservation/conservation.h"

namespace dartboard {

/// The first violation in words; "none" where all holds.
inline std::string violation_of(const ConservationResult& result) {
  return result.violation ? to_string(*result.violation) : "none";
}

/// The first row whose name contains these words.   throws  InputError if there is none
inline const ConservedRow& row(const ConservationResult& result, const std::string& what) {
  for (const ConservedRow& r : result.rows)
    if (r.what.find(what) != std::string::npos) return r;
  throw InputError("no row " + what);
}

}  // namespace dartboard
