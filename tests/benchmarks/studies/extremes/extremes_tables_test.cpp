// Tables and files of `extremes`: every figure of studies whose figures all differ, in its own place.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "benchmarks/studies/extremes/extremes_figures.h"
#include "benchmarks/studies/extremes/extremes_report.h"
#include "tests/support/claims_for_tests.h"
#include "tests/support/tables_for_tests.h"

namespace dartboard::extremes_tables_test {
namespace {

using Json = nlohmann::ordered_json;

/// The table, and its heading.
const NamedTable& named(const std::vector<NamedTable>& tables, const std::string& name) {
  for (const NamedTable& t : tables)
    if (t.name == name) return t;
  throw std::out_of_range("no table " + name);
}
Table table_of(const ExtremesResults& results, const std::string& name) {
  return named(tables_of(results), name).table;
}

ExtremeCell cell(const std::string& axis, const std::string& integrator, ExtremeOutcome outcome) {
  ExtremeCell c;
  c.axis = axis;
  c.scene = "box";
  c.integrator = integrator;
  c.value = "1e3";
  c.outcome = outcome;
  if (outcome == ExtremeOutcome::diagnosed) c.diagnosis = {StepCode::unstable_step, Witness::vertex, 3, "speed", 1e30};
  return c;
}

/// A map with crossings that runs found, the second the farther one from theory, and one that they did not.
StabilityMap stability_map() {
  StabilityMap map;
  map.integrator = "rk4";
  map.theta = {1.0, 2.0, 3.0};
  map.zeta = {0.0, 0.01, 0.1, 1.0};
  map.growth.assign(12, 0.25);
  map.boundary = {{0.0, 2.0, 2.001}, {0.1, 4.0, 3.99}, {1.0, 5.0, 0.0}};
  map.theory = {{2.5, 0.0}, {2.75, 0.1}};
  return map;
}

AmplificationPoint amplification(double theta, double measured, double theory) {
  AmplificationPoint p;
  p.integrator = "rk4";
  p.theta = theta;
  p.measured = std::polar(measured, 1.25 * theta);
  p.theory = std::polar(theory, 1.5 * theta);
  p.tolerance = 1e-3;
  return p;
}

ExtremesResults results() {
  ExtremesResults r;
  r.limits = {{"chain", "rk4", 0.5, 2.0, 2.125, 0.001}, {"box", "verlet", 0.25, 4.0, 0.0, 0.005}};
  MeshBody mesh;
  mesh.name = "liver";
  mesh.body.x.resize(5);
  mesh.body.springs.resize(7);
  mesh.omega = 80.0;
  mesh.error = 3e-5;
  mesh.proven = true;
  mesh.lower = 79.0;
  mesh.upper = 82.0;
  mesh.rise = 1.5;
  r.meshes = {mesh};
  r.maps = {stability_map()};
  r.amplification = {amplification(0.1, 0.75, 0.5)};
  r.rounding = {{"verlet", 0.05, 32, {{1000, 2e-15}, {100000, 3e-14}}, 0.5625}};
  r.tiny = {{"verlet", 1e-18, 1000000, 0.5, 0.25, 0.125}};
  Detection d;
  d.body = "chain";
  d.integrator = "rk4";
  d.factor = 1.5;
  d.predicted = true;
  d.above = 11;
  d.passed = 21;
  d.detected = 31;
  r.detections = {d, d, d, d};
  r.detections[1].predicted = false;
  r.detections[1].passed.reset();
  r.detections[1].above = 12;
  r.detections[2].passed = 22;
  r.detections[2].detected = 32;
  r.detections[2].above = 1;
  r.detections[3].factor = 10.0;
  return r;
}

// ---- tables

TEST(ExtremesTables, CountTheOutcomesOfEachAxisAndOfEachIntegrator) {
  ExtremesResults r;
  std::vector<ExtremeCell> cells;
  const auto add = [&](const std::string& axis, const std::string& integrator, ExtremeOutcome outcome, int times) {
    for (int k = 0; k < times; ++k) cells.push_back(cell(axis, integrator, outcome));
  };
  add("stiffness", "rk4", ExtremeOutcome::ok, 1);
  add("stiffness", "rk4", ExtremeOutcome::degraded, 2);
  add("stiffness", "verlet", ExtremeOutcome::diagnosed, 3);
  add("mass", "verlet", ExtremeOutcome::silent, 4);
  add("mass", "verlet", ExtremeOutcome::crash, 5);
  cells[3].refused = cells[4].refused = true;
  cells[0].judged_by = JudgedBy::motion;
  cells[1].judged_by = cells[2].judged_by = JudgedBy::scheme;
  for (int k = 3; k < 6; ++k) cells[static_cast<std::size_t>(k)].judged_by = JudgedBy::diagnosis;
  for (const ExtremeCell& c : cells) r.cells.push_back(to_json(c));
  const NamedTable axes = named(tables_of(r), "extremes"), integrators = named(tables_of(r), "integrators");
  EXPECT_EQ(axes.heading,
            "Extremes, by axis; 15 runs: judged by the motion 6.7 %, by the scheme 13.3 %, by survival 60.0 %, "
            "diagnosed 20.0 %");
  EXPECT_EQ(integrators.heading, "Extremes, by integrator");
  EXPECT_EQ(alignment(axes.table), "lrrrrrrrrrrr");
  ASSERT_EQ(axes.table.rows().size(), 2u);
  EXPECT_EQ(labelled(axes.table, 0), (Row{"axis: stiffness", "OK: 1", "SCHEME: 0", "SURVIVED: 0", "DEGRADED: 2",
                                          "DIAGNOSED: 3", "of it refused: 2", "SILENT: 0", "CRASH: 0",
                                          "judged by motion: 1", "by scheme: 2", "by survival: 0"}));
  EXPECT_EQ(axes.table.rows()[1], (Row{"mass", "0", "0", "0", "0", "0", "0", "4", "5", "0", "0", "9"}));
  ASSERT_EQ(integrators.table.rows().size(), 2u);
  EXPECT_EQ(integrators.table.columns()[0].title, "integrator");
  EXPECT_EQ(integrators.table.rows()[0], (Row{"rk4", "1", "0", "0", "2", "0", "0", "0", "0", "1", "2", "0"}));
  EXPECT_EQ(integrators.table.rows()[1], (Row{"verlet", "0", "0", "0", "0", "3", "2", "4", "5", "0", "0", "9"}));
}

TEST(ExtremesTables, HaveALimitBesideItsTheory) {
  ExtremesResults r = results();
  r.limits.push_back({"chain", "rk4", 0.5, 2.0, 2.001, 0.001});
  const Table table = table_of(r, "limits");
  EXPECT_EQ(alignment(table), "llrrrrl");
  ASSERT_EQ(table.rows().size(), 3u);
  EXPECT_EQ(labelled(table, 0), (Row{"body: chain", "integrator: rk4", "damping ratio: 0.5", "theory: 2.00000",
                                     "measured: 2.12500", "difference: +6.250 %", "holds: NO"}));
  EXPECT_EQ(table.rows()[1], (Row{"box", "verlet", "0.25", "4.00000", "none near", "", "NO"}));
  EXPECT_EQ(table.rows()[2].back(), "yes");
}

TEST(ExtremesTables, HaveTheFrequencyOfAMeshAndItsEstimate) {
  ExtremesResults r = results();
  r.meshes.push_back(r.meshes[0]);
  r.meshes[1].proven = false;
  const Table table = table_of(r, "frequencies");
  EXPECT_EQ(alignment(table), "lrrrrlrrr");
  ASSERT_EQ(table.rows().size(), 2u);
  EXPECT_EQ(labelled(table, 0),
            (Row{"body: liver", "vertices: 5", "springs: 7", "omega_max / (1/s): 80.000000", "within: 3.0e-05",
                 "proven: yes", "before the cuts: +50.000 %", "estimate, lower: -1.250 %", "upper: +2.500 %"}));
  EXPECT_EQ(table.rows()[1][5], "NO");
}

TEST(ExtremesTables, HaveTheCrossingThatIsFarthestFromTheory) {
  ExtremesResults r = results();
  r.maps.push_back(stability_map());
  r.maps[1].boundary = {{1.0, 5.0, 0.0}};
  const Table table = table_of(r, "maps");
  EXPECT_EQ(alignment(table), "lrrrrrr");
  ASSERT_EQ(table.rows().size(), 2u);
  EXPECT_EQ(labelled(table, 0), (Row{"integrator: rk4", "runs in the map: 12", "crossings: 3", "found by runs: 2",
                                     "worst distance: 0.250 %", "at damping ratio: 0.1", "h omega: 4.00000"}));
  EXPECT_EQ(table.rows()[1], (Row{"rk4", "12", "1", "0", "", "", ""}));
}

// A step that turns the oscillation by 1.25 theta instead of theta and multiplies it by 0.75.
TEST(ExtremesTables, HaveAStepOfEachDecadeBesideItsTheory) {
  ExtremesResults r = results();
  r.amplification.push_back(amplification(0.2, 0.75, 0.5));  // between decades
  r.amplification.push_back(amplification(1.0, 0.75, 0.75));
  r.amplification.back().theory = r.amplification.back().measured;
  const Table table = table_of(r, "amplification");
  EXPECT_EQ(alignment(table), "lrrrrrrl");
  ASSERT_EQ(table.rows().size(), 2u);
  const double difference = std::abs(std::polar(0.75, 0.125) - std::polar(0.5, 0.15)) / 0.5;
  EXPECT_EQ(labelled(table, 0), (Row{"integrator: rk4", "h omega: 0.1", "amplitude: 0.75", "phase error: +2.500e-01",
                                     fmt::format("damping ratio: {:.3e}", -std::log(0.75) / 0.125),
                                     fmt::format("in theory: {:.3e}", -std::log(0.5) / 0.15),
                                     fmt::format("deviation: {:.1e}", difference), "holds: NO"}));
  EXPECT_EQ(table.rows()[1][1], "1");
  EXPECT_EQ(table.rows()[1][7], "yes");
}

TEST(ExtremesTables, HaveTheExponentOfRoundingInTheLastOfItsRows) {
  const Table table = table_of(results(), "rounding");
  EXPECT_EQ(alignment(table), "lrrrr");
  ASSERT_EQ(table.rows().size(), 2u);
  EXPECT_EQ(table.rows()[0], (Row{"verlet", "32", "1e+03", "2.00e-15", ""}));
  EXPECT_EQ(labelled(table, 1),
            (Row{"integrator: verlet", "starts: 32", "steps: 1e+05", "energy error: 3.00e-14", "exponent: 0.562"}));
}

TEST(ExtremesTables, HaveWhatTinyStepsLose) {
  const Table table = table_of(results(), "tiny");
  EXPECT_EQ(alignment(table), "lrrrrr");
  ASSERT_EQ(table.rows().size(), 1u);
  EXPECT_EQ(labelled(table, 0),
            (Row{"integrator: verlet", "step / s: 1e-18", "steps: 1000000", "displacement lost: 5.0e-01",
                 "cannot be read: 2.5e-01", "lost, all digits: 1.2e-01"}));
}

TEST(ExtremesTables, HaveTheLatestDetectionOfEachFactor) {
  const Table table = table_of(results(), "detection");
  EXPECT_EQ(alignment(table), "lrrrrrrr");
  ASSERT_EQ(table.rows().size(), 2u);
  EXPECT_EQ(labelled(table, 0),
            (Row{"integrator: rk4", "step / limit: 1.5", "runs: 3", "predicted: 2", "passed the bound: 2",
                 "at step, latest: 22", "detected at, latest: 32", "most steps above: 12"}));
  EXPECT_EQ(table.rows()[1], (Row{"rk4", "10", "1", "1", "1", "21", "31", "11"}));
}

TEST(ExtremesTables, StandUnderTheirHeadings) {
  ExtremesResults r = results();
  r.cells.push_back(to_json(cell("mass", "rk4", ExtremeOutcome::ok)));
  Row all;
  for (const NamedTable& t : tables_of(r)) all.push_back(t.study + ", " + t.name + ": " + t.heading);
  EXPECT_EQ(all,
            (Row{"matrix, extremes: Extremes, by axis; 1 runs: judged by the motion 0.0 %, by the scheme 0.0 %, by "
                 "survival 100.0 %, diagnosed 0.0 %",
                 "matrix, integrators: Extremes, by integrator",
                 "limits, limits: Longest stable step times omega_max, compared with theory",
                 "limits, frequencies: Highest frequencies of meshes, by Lanczos",
                 "maps, maps: Boundaries of stability, by runs and in theory",
                 "amplification, amplification: One step of an undamped oscillation",
                 "rounding, rounding: Energy error by rounding alone", "rounding, tiny: Tiny steps",
                 "detection, detection: Unstable steps: predicted, and detected"}));
}

// ---- claims

TEST(ExtremesClaimsInWords, SayWhatIsAskedWhatWasMeasuredAndWhatItRestsOn) {
  ExtremesResults r = results();
  ExtremeCell far = cell("offset", "rk4", ExtremeOutcome::ok), implicit = cell("offset", "bdf2", ExtremeOutcome::ok),
              nameless = cell("mass", "verlet", ExtremeOutcome::diagnosed);
  far.offset_error = 5.5;
  implicit.offset_error = 6.5;
  nameless.diagnosis = {StepCode::unstable_step, Witness::none, 0, "energy", std::numeric_limits<double>::quiet_NaN()};
  for (const ExtremeCell& c : {far, implicit, nameless, cell("mass", "rk4", ExtremeOutcome::silent)})
    r.cells.push_back(to_json(c));
  const auto claims = claims_of(r);
  expect_words(claims, "no-silent-run", "0", "1", "4 runs");
  expect_words(claims, "diagnoses-name-a-quantity", "0", "1",
               "1 diagnoses; mass box 1e3 with verlet: energy not a number");
  expect_words(claims, "offset-explicit", "<= 30 eps D", "5.5 eps D",
               "1 runs of 100 steps, explicit Euler left out; worst: rk4, box at D = 1e3");
  expect_words(claims, "offset-implicit", "<= 30 eps D", "6.5 eps D",
               "1 runs of 100 steps; worst: bdf2, box at D = 1e3");
  expect_words(claims, "limits-closed-forms", "<= 0.1 %", "6.250 %", "0 of 1 limits");
  expect_words(claims, "limits-meshes", "<= 0.5 %", "100.000 %", "0 of 1 limits");
  expect_words(claims, "estimate-meshes", "<= 10 %", "2.50 %", "omega_max proven by a Cholesky factor");
  expect_words(claims, "map-boundaries", "<= 0.1 %", "100.000 %", "3 places");
  expect_words(claims, "unstable-steps", "all; <= 64", "3 of 4; 12", "4 runs");
  expect_words(claims, "rounding-verlet", "0.5 +- 0.1", "0.562",
               "[0.562, 0.562], two standard errors; 32 starts, 1e+05 steps");
  expect_words(claims, "tiny-steps", "what can be read", "kept", "table of tiny steps");
  EXPECT_EQ(find_claim(claims, "amplification").bound_or_interval, "0 of 1 within rounding");
}

// ---- JSON

TEST(ExtremesJson, HoldsEveryFigureOfACell) {
  ExtremeCell c = cell("mass", "rk4", ExtremeOutcome::diagnosed);
  c.step = 17;
  c.warnings = {"A", "B"};
  c.note = "why";
  c.refused = true;
  c.offset_error = 2.5;
  c.judged_by = JudgedBy::diagnosis;
  c.scheme_excess = 0.25;
  c.motion_error = 0.5;
  EXPECT_EQ(to_json(c), Json::parse(R"({"axis": "mass", "scene": "box", "integrator": "rk4", "value": "1e3",
    "outcome": "DIAGNOSED", "judged_by": "diagnosis", "step": 17, "code": "UNSTABLE_DT", "vertex": 3, "quantity": "speed", "found": "1e+30",
    "warnings": ["A", "B"], "note": "why", "refused": true, "scheme_excess": 0.25, "motion_error": 0.5,
    "offset_error": 2.5})"));
  c.diagnosis.witness = Witness::edge;
  EXPECT_EQ(to_json(c).at("edge"), 3);
  EXPECT_FALSE(to_json(c).contains("vertex"));
  c.offset_error = std::numeric_limits<double>::infinity();
  EXPECT_EQ(to_json(c).at("offset_error"), "not finite");
  EXPECT_EQ(to_json(cell("mass", "rk4", ExtremeOutcome::ok)),
            Json::parse(R"({"axis": "mass", "scene": "box", "integrator": "rk4", "value": "1e3", "outcome": "OK",
              "judged_by": "survival", "step": 0})"));
}

TEST(ExtremesJson, HoldsEveryFigureOfTheStudies) {
  ExtremesResults r = results();
  r.cells = {to_json(cell("mass", "rk4", ExtremeOutcome::silent)), to_json(cell("mass", "rk4", ExtremeOutcome::ok))};
  r.detections.resize(2);
  r.detections[1].detected.reset();
  const Json json = to_json(r);
  EXPECT_EQ(json.at("cells"), 2);
  EXPECT_EQ(json.at("forbidden"), 1);
  EXPECT_EQ(json.at("matrix"), Json(r.cells));
  EXPECT_EQ(json.at("limits").at(0), Json::parse(R"({"body": "chain", "integrator": "rk4", "zeta": 0.5, "theory": 2.0,
    "measured": 2.125, "holds": false})"));
  EXPECT_EQ(json.at("boundary").at(1),
            Json::parse(R"({"integrator": "rk4", "zeta": 0.1, "theory": 4.0, "measured": 3.99})"));
  const AmplificationPoint& p = r.amplification[0];
  EXPECT_EQ(json.at("amplification"), Json::array({Json{{"integrator", "rk4"},
                                                        {"h_omega", 0.1},
                                                        {"amplitude", p.amplitude()},
                                                        {"phase", p.phase()},
                                                        {"damping_ratio", p.damping_ratio()},
                                                        {"deviation", p.deviation()},
                                                        {"tolerance", 1e-3}}}));
  EXPECT_EQ(json.at("rounding").at(1),
            Json::parse(R"({"integrator": "verlet", "steps": 100000, "energy_error": 3e-14})"));
  EXPECT_EQ(json.at("tiny"), Json::parse(R"([{"integrator": "verlet", "h": 1e-18, "steps": 1000000, "lost": 0.5,
    "cannot_be_read": 0.25, "lost_with_digits": 0.125}])"));
  EXPECT_EQ(json.at("detection"), Json::parse(R"([
    {"body": "chain", "integrator": "rk4", "factor": 1.5, "predicted": true, "passed": 21, "detected": 31},
    {"body": "chain", "integrator": "rk4", "factor": 1.5, "predicted": false}])"));
  EXPECT_EQ(json.at("claims"), Json(nlohmann::json(claims_of(r))));
}

}  // namespace
}  // namespace dartboard::extremes_tables_test
