#include "core/base/lanes.h"

#include "core/base/avx2.h"

namespace dartboard {
namespace {

bool are_on = has_avx2();

}  // namespace

bool lanes_are_on() { return are_on; }

bool use_lanes(bool on) {
  const bool were_on = are_on;
  are_on = on && has_avx2();
  return were_on;
}

}  // namespace dartboard
