// The comparisons of lockstep: each answer of a carrier is made wrong in turn, and the comparison names it.

#include <gtest/gtest.h>

#include <algorithm>

#include "core/topology/sew.h"
#include "tests/support/lying_twin_for_tests.h"
#include "tests/support/meshes_for_tests.h"
#include "validation/topology/topology_fuzz.h"

namespace dartboard::lockstep_judge_test {
namespace {

/// Map3 twice, the second one with wrong answers.
MakeTwins with_a_liar(const Lies& lies) {
  return [lies](const Mesh& mesh, ScriptStorage) {
    std::vector<std::unique_ptr<MapTwin>> twins;
    twins.push_back(make_core_twin<Map3>(mesh));
    twins.push_back(std::make_unique<LyingTwin>(make_core_twin<Map3>(mesh), lies));
    return twins;
  };
}

/// Map3 with wrong answers, and no other map of ours.
MakeTwins only_a_liar(const Lies& lies) {
  return [lies](const Mesh& mesh, ScriptStorage) {
    std::vector<std::unique_ptr<MapTwin>> twins;
    twins.push_back(std::make_unique<LyingTwin>(make_core_twin<Map3>(mesh), lies));
    return twins;
  };
}

Dart sewn_dart(const Mesh& mesh) {
  const auto twin = make_core_twin<Map3>(mesh);
  for (const Dart d : twin->darts())
    if (twin->alpha(3, d) != d) return d;
  return no_dart;
}

/// The disagreement found after one operation on six tetrahedra with this lie; "nothing" if it goes unnoticed.
std::string seen(const Lies& lies, Operation operation) {
  const Mesh mesh = kuhn_grid(1, 1, 1, 1.0);
  if (operation.a == no_dart) operation.a = sewn_dart(mesh);
  Lockstep lockstep(mesh, ScriptStorage::general, ScriptOracles::none, with_a_liar(lies));
  const auto found = lockstep.apply(operation);
  if (!found) return "nothing";
  EXPECT_NE((found->ours + found->theirs).find("liar"), std::string::npos) << to_string(*found);
  return found->what;
}
const Operation unsew{.kind = Operation::Kind::unsew, .i = 3};
const Operation dissociate{.kind = Operation::Kind::dissociate};
const Operation removal{.kind = Operation::Kind::remove};

TEST(LockstepJudge, IsContentWithWhoTellsTheTruth) {
  for (const Operation& operation : {unsew, dissociate, removal}) EXPECT_EQ(seen({}, operation), "nothing");
}

TEST(LockstepJudge, NamesACellWhoseWalkMissesADart) {
  for (int i = 0; i < 3; ++i) {
    const Lies lies{.orbit = [i](Involutions set, std::vector<Dart>& darts) {
      if (set == cell_involutions(3, i) && darts.size() > 1) darts.pop_back();
    }};
    for (const Operation& operation : {unsew, dissociate, removal})
      EXPECT_EQ(seen(lies, operation).substr(0, 10), "the " + std::to_string(i) + "-cell") << i;
  }
}

TEST(LockstepJudge, NamesACellWhoseWalkBringsADartTwice) {
  const Lies lies{.orbit = [](Involutions set, std::vector<Dart>& darts) {
    if (set == cell_involutions(3, 0) && darts.size() > 1) darts.back() = darts.front();
  }};
  EXPECT_EQ(seen(lies, unsew).substr(0, 10), "the 0-cell");
}

TEST(LockstepJudge, NamesACellWhoseWalkStraysIntoAnother) {
  const Lies lies{.orbit = [](Involutions set, std::vector<Dart>& darts) {
    for (std::uint32_t k = 0; set == cell_involutions(3, 1); ++k) {
      if (std::ranges::find(darts, Dart{k}) != darts.end()) continue;
      darts.back() = {k};
      break;
    }
  }};
  EXPECT_EQ(seen(lies, unsew).substr(0, 10), "the 1-cell");
}

TEST(LockstepJudge, NamesAnAlphaThatDiffers) {
  const Dart d = sewn_dart(kuhn_grid(1, 1, 1, 1.0));
  for (int i = 0; i <= 3; ++i) {
    // d's are sewn everywhere, so that no alpha of it is d itself
    const Lies lies{.alpha = [i, d](int k, Dart of, Dart truth) { return k == i && of == d ? d : truth; }};
    EXPECT_EQ(seen(lies, dissociate), "alpha" + std::to_string(i) + "(" + to_string(d) + ")");
  }
}

TEST(LockstepJudge, NamesAVerdictThatDiffers) {
  const Mesh mesh = kuhn_grid(1, 1, 1, 1.0);
  const Lies lies{.can_sew = [](bool verdict) { return !verdict; }};
  EXPECT_EQ(seen(lies, {.kind = Operation::Kind::sew, .i = 3, .a = sewn_dart(mesh), .b = Dart{0}}),
            "whether it is legal");
}

TEST(LockstepJudge, NamesADissociationThatReportsAnotherSplit) {
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(seen({.dissociate = [i](SplitCounts& split) { ++split[i]; }}, dissociate), "what came apart") << i;
}

TEST(LockstepJudge, NamesADartThatOutlivesItsCell) {
  const Lies lies{.is_live = [](Dart, bool) { return true; }};
  EXPECT_NE(seen(lies, removal).find("is live"), std::string::npos);
}

TEST(LockstepJudge, NamesANumberOfDartsThatIsOff) {
  const Lies lies{.dart_count = [](std::size_t truth) { return truth + 1; }};
  EXPECT_EQ(seen(lies, removal), "darts");
}

TEST(LockstepJudge, NamesAMapThatIsNotValidWhereItWasTouched) {
  EXPECT_EQ(seen({.violation_near = [] { return std::string("broken"); }}, unsew), "validity");
}

// The requested face is apart, and so is one elsewhere that was not requested.
TEST(LockstepJudge, AddsUpWhatOperationsChange) {
  const Mesh mesh = kuhn_grid(3, 1, 1, 1.0);
  const auto twin = make_core_twin<Map3>(mesh);
  Dart first = sewn_dart(mesh), last = first;
  for (const Dart d : twin->darts())
    if (twin->alpha(3, d) != d) last = d;
  MapOperations<Map3> zealous;
  zealous.unsew = [last](Map3& map, int, Dart d) {
    dartboard::unsew<3>(map, d);
    if (!map.is_free<3>(last)) dartboard::unsew<3>(map, last);
  };
  const MakeTwins ours = [zealous](const Mesh& of, ScriptStorage) {
    std::vector<std::unique_ptr<MapTwin>> twins;
    twins.push_back(make_core_twin<Map3>(of, zealous));
    return twins;
  };
  Lockstep lockstep(mesh, ScriptStorage::general, ScriptOracles::none, ours);
  Operation operation = unsew;
  operation.a = first;
  EXPECT_FALSE(lockstep.apply(operation));
  const auto found = lockstep.compare_everything();
  ASSERT_TRUE(found);
  EXPECT_NE(found->theirs.find("by adding up"), std::string::npos) << to_string(*found);
  // a script of that one line shows it at its end
  const TopologyScript script{"mesh", ScriptStorage::general, ScriptOracles::none, {operation}};
  EXPECT_TRUE(replay_topology(mesh, script, ours).disagreement);
  EXPECT_FALSE(replay_topology(mesh, script).disagreement);
}

// Questions of the full comparison only: the report names the carrier of each answer.
TEST(LockstepJudge, NamesWhoAnswersTheFullComparisonDifferently) {
  const Mesh mesh = kuhn_grid(1, 1, 1, 1.0);
  const Lies lies{.is_orientable = [](std::optional<bool> truth) { return !*truth; }};
  const Lockstep lockstep(mesh, ScriptStorage::general, ScriptOracles::none, with_a_liar(lies));
  const auto found = lockstep.compare_everything();
  ASSERT_TRUE(found);
  EXPECT_EQ(found->what, "orientable");
  EXPECT_NE(found->ours.find("yes"), std::string::npos) << found->ours;
  EXPECT_NE(found->theirs.find("liar"), std::string::npos) << found->theirs;
  EXPECT_NE(found->theirs.find("no"), std::string::npos) << found->theirs;
}

// The carrier answers correctly until all rows have agreed, and then calls one face free: only isomorphism is checked
// after that.
TEST(LockstepJudge, AsksCgalForIsomorphism) {
  const Mesh mesh = kuhn_grid(1, 1, 1, 1.0);
  const auto honest = make_core_twin<Map3>(mesh);
  const Dart d = sewn_dart(mesh);
  const auto face = darts_touched(*honest, 3, d, honest->alpha(3, d));
  auto counted = std::make_shared<int>(0);  // at the start, among the rows, and after them
  const Lies lies{.alpha =
                      [=](int i, Dart of, Dart truth) {
                        const bool here = i == 3 && std::ranges::find(face, of) != face.end();
                        return *counted >= 3 && here ? of : truth;
                      },
                  .count_cells = [=](std::vector<std::size_t>&) { ++*counted; }};
  Lockstep lockstep(mesh, ScriptStorage::general, ScriptOracles::gmap, only_a_liar(lies));
  const auto found = lockstep.compare_everything();
  ASSERT_TRUE(found);
  EXPECT_EQ(found->what, "isomorphic to ours");
}

// ---- all questions on a map

/// The rows in which an honest twin and one with wrong answers disagree.
std::vector<std::string> rows_that_differ(const Lies& lies) {
  const Mesh mesh = kuhn_grid(1, 1, 1, 1.0);
  const auto honest = make_core_twin<Map3>(mesh);
  const LyingTwin liar(make_core_twin<Map3>(mesh), lies);
  const std::vector<const MapTwin*> twins{honest.get(), &liar};
  std::vector<std::string> differ;
  for (const AgreementRow& row : compare_twins(twins))
    if (!row.agrees) differ.push_back(row.what);
  return differ;
}

using Names = std::vector<std::string>;

TEST(CompareTwins, AgreeWhereNobodyLies) { EXPECT_EQ(rows_that_differ({}), Names{}); }

TEST(CompareTwins, NameTheCountThatIsOffByOne) {
  const Names names{"vertices", "edges", "faces", "volumes", "components"};
  for (std::size_t i = 0; i < names.size(); ++i)
    EXPECT_EQ(rows_that_differ({.count_cells = [i](std::vector<std::size_t>& counts) { ++counts[i]; }}),
              Names{names[i]});
  EXPECT_EQ(rows_that_differ({.dart_count = [](std::size_t n) { return n + 1; }}), Names{"darts"});
}

TEST(CompareTwins, NameValidityAndOrientability) {
  EXPECT_EQ(rows_that_differ({.violation = [] { return std::string("broken"); }}), Names{"valid"});
  EXPECT_EQ(rows_that_differ({.is_orientable = [](std::optional<bool> truth) { return !*truth; }}),
            Names{"orientable"});
}

TEST(CompareTwins, NameTheKindOfOrbitThatIsWalkedWrongly) {
  const Lies lies{.orbit = [](Involutions set, std::vector<Dart>& darts) {
    if (set == Involutions{0, 1} && darts.size() > 1) darts.resize(1);
  }};
  EXPECT_EQ(rows_that_differ(lies), Names{"orbits <0,1>"});
}

TEST(CompareTwins, NameOneAlphaOfOneDart) {
  const Names differ =
      rows_that_differ({.alpha = [](int i, Dart of, Dart truth) { return i == 2 && of == Dart{7} ? of : truth; }});
  EXPECT_NE(std::ranges::find(differ, "every alpha"), differ.end());
}

TEST(CompareIsomorphism, SaysNoOfATwinThatHasOneFaceMoreApart) {
  const Mesh mesh = kuhn_grid(1, 1, 1, 1.0);
  const AlphaList alphas = alphas_of(mesh);
  const auto ours = make_core_twin<Map3>(mesh), same = make_cgal_gmap_twin(alphas), cut = make_cgal_gmap_twin(alphas);
  cut->unsew(3, sewn_dart(mesh));
  const std::vector<const MapTwin*> good{ours.get(), same.get()}, bad{ours.get(), same.get(), cut.get()};
  EXPECT_TRUE(compare_isomorphism(good, 1, ours->alphas()).agrees);
  const AgreementRow row = compare_isomorphism(bad, 1, ours->alphas());
  EXPECT_FALSE(row.agrees);
  EXPECT_EQ(row.answers, (Names{"", "yes", "no"}));
}

}  // namespace
}  // namespace dartboard::lockstep_judge_test
