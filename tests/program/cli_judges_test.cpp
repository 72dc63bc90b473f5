// Verbs that judge: their random choices depend on the seed alone.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "tests/support/program_for_tests.h"

namespace dartboard::cli_judges_test {
namespace {

/// The numbers of operations of each series that were applied, illegal, and not carried, or other marks of the choices.
std::string drawn(const std::string& arguments, const std::vector<std::string>& keys) {
  const Answer answer = run(arguments, "2>/dev/null");
  EXPECT_EQ(answer.status, 0) << answer.out;
  const auto json = nlohmann::json::parse(answer.out);
  std::string all;
  for (const auto& session : json.contains("meshes") ? json["meshes"][0]["sessions"] : json["sessions"])
    for (const std::string& key : keys) all += session.at(key).dump() + " ";
  return all;
}

TEST(ValidateTopology, DrawsOtherOperationsForAnotherSeedAndTheSameForTheSame) {
  const auto of = [](int seed) {
    return drawn("validate topology kuhn_box --operations 60 --json --seed " + std::to_string(seed),
                 {"applied", "illegal", "not_carried"});
  };
  const std::string first = of(1);
  EXPECT_EQ(of(1), first);
  EXPECT_EQ((std::set{first, of(4), of(7), of(10)}).size(), 4u);
}

TEST(ValidateConservation, DrawsOtherOperationsForAnotherSeedAndTheSameForTheSame) {
  const auto of = [](int seed) {
    return drawn("validate conservation kuhn_box --operations 60 --json --seed " + std::to_string(seed),
                 {"dissociations", "tears", "removals", "refinements"});
  };
  const std::string first = of(1);
  EXPECT_EQ(of(1), first);
  EXPECT_EQ((std::set{first, of(11), of(21), of(31)}).size(), 4u);
}

}  // namespace
}  // namespace dartboard::cli_judges_test
