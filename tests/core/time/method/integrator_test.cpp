#include "core/time/method/integrator.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace dartboard::integrator_test {
namespace {

TEST(StepCodes, HaveNamesOfTheirOwn) {
  std::set<std::string> names;
  for (int code = 0; code <= static_cast<int>(StepCode::budget); ++code) {
    const std::string name(to_string(static_cast<StepCode>(code)));
    EXPECT_GE(name.size(), 2u) << code;
    EXPECT_TRUE(names.insert(name).second) << name;
  }
}

}  // namespace
}  // namespace dartboard::integrator_test
