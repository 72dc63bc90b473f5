#include "core/scene/body/memory.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace dartboard::memory_test {
namespace {

TEST(MemoryParts, HaveNamesOfTheirOwn) {
  std::set<std::string> names;
  for (int part = 0; part <= static_cast<int>(Part::diagnostics); ++part) {
    const std::string text(name(static_cast<Part>(part)));
    EXPECT_GE(text.size(), 3u) << part;
    EXPECT_TRUE(names.insert(text).second) << text;
  }
}

}  // namespace
}  // namespace dartboard::memory_test
