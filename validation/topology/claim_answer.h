#pragma once
// What was found when a sentence of the paper was tried out.

#include <string>

namespace dartboard {

struct ClaimAnswer {
  bool holds;
  std::string measured;
};

}  // namespace dartboard
