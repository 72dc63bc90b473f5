#pragma once
// The result of testing a sentence of the paper.

#include <string>

namespace dartboard {

struct ClaimAnswer {
  bool holds;
  std::string measured;
};

}  // namespace dartboard
