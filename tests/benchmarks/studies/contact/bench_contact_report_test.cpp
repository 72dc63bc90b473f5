// The conclusions of `bench contact` from its measurements: with one wrong figure, the claim about it falls short.

#include "benchmarks/studies/contact/bench_contact_report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>

#include "benchmarks/studies/contact/contact_costs.h"
#include "tests/support/claims_for_tests.h"
#include "tests/support/timings_for_tests.h"

namespace dartboard::bench_contact_report_test {
namespace {

using Ids = std::vector<std::string>;
constexpr std::size_t largest = 1'000'000;

void set_time(ContactCosts& c, const std::string& task, double ns) {
  for (Sample& s : c.samples)
    if (s.task == task) s.cpu_ns = s.wall_ns = std::llround(ns);
}

/// Steps of a millisecond; forces and lists that take as long for each tetrahedron, whatever the body.
ContactCosts good_costs() {
  ContactCosts c;
  c.largest = largest;
  std::vector<std::pair<std::string, double>> times;
  for (const std::string& situation : stepped_situations()) {
    times.emplace_back(situation + ": step", 1'010'000.0);
    times.emplace_back(situation + ": step without", 1'000'000.0);
    c.counts[situation] = {.situation = situation, .tetrahedra = 1000, .samples = 900};
  }
  for (const std::string& situation : asleep_situations()) {
    times.emplace_back(situation + ": step", 1'090'000.0);
    times.emplace_back(situation + ": step alone", 1'000'000.0);
    c.counts[situation] = {.situation = situation, .tetrahedra = 1000, .samples = 99};
  }
  std::vector<std::string> all = pressed_situations();
  const auto plates = plate_situations(largest);
  all.insert(all.end(), plates.begin(), plates.end());
  std::size_t tetrahedra = 100;
  for (const std::string& situation : all) {
    c.counts[situation] = {.situation = situation,
                           .tetrahedra = tetrahedra,
                           .samples = tetrahedra,
                           .candidates = 2 * tetrahedra,
                           .contacts = tetrahedra / 2,
                           .evaluations = static_cast<int>(100'000'000 / tetrahedra)};
    times.emplace_back(situation + ": contact", 0.9e9);
    times.emplace_back(situation + ": elements", 1e9);
    times.emplace_back(situation + ": list", 5e9);
    tetrahedra *= 10;
  }
  c.samples = timed_samples(times);
  for (const std::string& scene : factor_scenes())
    c.factors.push_back({.scene = scene,
                         .steps = 100,
                         .changing = 40,
                         .changes = 50,
                         .factorisations = 10,
                         .iterations = 1000,
                         .iterations_of_changing = 500});
  return c;
}

Ids short_with(const std::function<void(ContactCosts&)>& spoil) {
  ContactCosts c = good_costs();
  spoil(c);
  return ids_of(claims_of(c), Verdict::falls_short);
}

/// Growth as a power of the number of tetrahedra.
void grow(ContactCosts& c, const std::string& task, double exponent) {
  for (const std::string& situation : plate_situations(largest)) {
    const ContactCounts& n = c.counts.at(situation);
    set_time(c, situation + task, n.evaluations * std::pow(static_cast<double>(n.tetrahedra), exponent));
  }
}

TEST(BenchContactClaims, HoldWhenEverythingIsAsPromised) {
  const auto claims = claims_of(good_costs());
  EXPECT_EQ(ids_of(claims, Verdict::holds),
            (Ids{"contact-cost-agreement", "contact-idle-elements", "contact-idle-springs", "contact-after-cut",
                 "contact-asleep", "contact-kept-factor", "contact-growth-lists", "contact-growth-forces"}));
  expect_words(claims, "contact-kept-factor", "<= 0.1", "0.100 / 0.100 / 0.100",
               "12.5 and 8.3 / 12.5 and 8.3 / 12.5 and 8.3 iterations in steps with a change and without");
  expect_words(claims, "contact-after-cut", "<= 1", "0.900", "[0.9, 0.9] at 98.4 %");
}

TEST(BenchContactClaims, FallShortOfAnIdleContactThatTakesMoreThanTwoPercentOfAStep) {
  for (const std::string& situation : idle_situations()) {
    const bool springs = situation.starts_with("springs");
    EXPECT_EQ(short_with([&](auto& c) { set_time(c, situation + ": step", 1'021'000.0); }),
              Ids{springs ? "contact-idle-springs" : "contact-idle-elements"})
        << situation;
  }
}

TEST(BenchContactClaims, FallShortOfSleepersThatTakeMoreThanATenthOfAStep) {
  for (const std::string& situation : asleep_situations())
    EXPECT_EQ(short_with([&](auto& c) { set_time(c, situation + ": step", 1'110'000.0); }), Ids{"contact-asleep"})
        << situation;
}

TEST(BenchContactClaims, FallShortOfACutLiverWhoseContactTakesLongerThanItsElements) {
  EXPECT_EQ(short_with([](auto& c) { set_time(c, cut_situation() + ": contact", 1.01e9); }), Ids{"contact-after-cut"});
}

TEST(BenchContactClaims, FallShortOfFactorsThatAreNotKept) {
  const Ids id{"contact-kept-factor"};
  for (std::size_t k = 0; k < factor_scenes().size(); ++k) {
    EXPECT_EQ(short_with([k](auto& c) { c.factors[k].factorisations = 11; }), id);
    EXPECT_EQ(short_with([k](auto& c) { c.factors[k].changes = 0; }), id);
  }
  EXPECT_EQ(short_with([](auto& c) { c.factors.clear(); }), id);
}

TEST(ContactFactors, AreKeptWhileContactsComeAndGo) {
  const ContactFactors counts = count_factors("boxes_stacked", 0.1);
  EXPECT_EQ(counts.steps, 50u);
  EXPECT_GE(counts.changes, counts.changing);
  EXPECT_GT(counts.changing, 5u);
  EXPECT_LT(counts.changing, 45u);
  EXPECT_LE(counts.factorisations, 5u);
  EXPECT_GT(counts.iterations_of_changing, counts.changing);
  EXPECT_GT(counts.iterations, counts.iterations_of_changing);
}

TEST(BenchContactClaims, FallShortOfGrowthFasterThanNLogN) {
  EXPECT_EQ(short_with([](auto& c) { grow(c, ": list", 1.2); }), Ids{"contact-growth-lists"});
  EXPECT_EQ(short_with([](auto& c) { grow(c, ": contact", 1.2); }), Ids{"contact-growth-forces"});
}

TEST(BenchContactCosts, FitTheExponentOfEvaluations) {
  ContactCosts c = good_costs();
  grow(c, ": list", 1.5);
  EXPECT_NEAR(c.exponent(": list").median, 1.5, 1e-6);
  EXPECT_NEAR(c.exponent(": contact").median, 1.0, 1e-6);
  // between the exponents 1 + 1 / log n of the ends
  EXPECT_GT(c.exponent_of_n_log_n(), 1.0 + 1.0 / std::log(1e8));
  EXPECT_LT(c.exponent_of_n_log_n(), 1.0 + 1.0 / std::log(1e5));
}

TEST(BenchContactClaims, AreNotTestedWhereContactIsWrong) {
  const std::function<void(ContactCosts&)> wrongs[]{
      [](auto& c) { c.counts.at(cut_situation()).differing = 1; },
      [](auto& c) { c.counts.at(cut_situation()).unbalanced = 2e-13; },
      [](auto& c) { c.counts.at(cut_situation()).unbalanced = std::nan(""); }};
  for (const auto& wrong : wrongs) {
    ContactCosts c = good_costs();
    wrong(c);
    const auto claims = claims_of(c);
    EXPECT_EQ(ids_of(claims, Verdict::falls_short), Ids{"contact-cost-agreement"});
    EXPECT_EQ(ids_of(claims, Verdict::not_tested).size(), claims.size() - 1);
  }
}

// As in a quick run: three processes, all alike, cannot predict others.
TEST(BenchContactClaims, AreNotJudgedByThreeProcesses) {
  ContactCosts c = good_costs();
  std::erase_if(c.samples, [](const Sample& s) { return s.process >= 3; });
  const auto claims = claims_of(c);
  EXPECT_EQ(ids_of(claims, Verdict::undecided).size(), claims.size() - 2);  // the others are counts
  EXPECT_EQ(exit_code(claims), 0);
}

TEST(BenchContactTables, HaveARowForEachSituation) {
  const ContactCosts c = good_costs();
  EXPECT_EQ(contact_steps_table(c).rows().size(), stepped_situations().size());
  EXPECT_EQ(contact_forces_table(c).rows().size(), pressed_situations().size() + plate_situations(largest).size());
}

TEST(ContactCosts, AreMeasuredInEverySituationAndFoundToAgree) {
  std::set<std::string> counted, timed;
  std::size_t touching = 0;
  measure_contact_costs(
      {.rounds = 1, .steps = 1, .largest = 1'500, .across = 2},
      [&](const ContactCounts& n) {
        counted.insert(n.situation);
        EXPECT_GT(n.samples, 0u) << n.situation;
        EXPECT_EQ(n.differing, 0u) << n.situation;
        EXPECT_LT(n.unbalanced, 1e-13) << n.situation;
        touching += n.contacts > 100 ? 1 : 0;
      },
      [&](const Sample& s) { timed.insert(s.task); });
  EXPECT_EQ(touching, pressed_situations().size() + 1);
  EXPECT_EQ(counted.size(), idle_situations().size() + asleep_situations().size() + touching);
  for (const std::string& situation : stepped_situations()) {
    EXPECT_TRUE(timed.contains(situation + ": step")) << situation;
    EXPECT_TRUE(timed.contains(situation + ": step without")) << situation;
  }
  for (const std::string& situation : asleep_situations())
    EXPECT_TRUE(timed.contains(situation + ": step") && timed.contains(situation + ": step alone")) << situation;
  for (const std::string& situation : plate_situations(1'500)) EXPECT_TRUE(timed.contains(situation + ": list"));
}

}  // namespace
}  // namespace dartboard::bench_contact_report_test
