// Files that a run writes, column by column: each value under its own name.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "core/mechanics/fracture/stress.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/meshes/text/base64.h"
#include "core/scene/output/scene_output.h"
#include "core/scene/output/write_vtu.h"
#include "tests/support/folder_for_tests.h"
#include "tests/support/meshes_for_tests.h"

namespace dartboard::simulation_output_test {
namespace {

/// The values of an array of a .vtu file, by its name.
template <class T>
std::vector<T> column(const std::string& vtu, const std::string& name, const std::string& type) {
  const auto tag = vtu.find("<DataArray type=\"" + type + "\" Name=\"" + name + "\"");
  if (tag == std::string::npos) {
    ADD_FAILURE() << "no array " << name << " of " << type;
    return {};
  }
  const auto begin = vtu.find('>', tag) + 1, end = vtu.find('<', begin);
  const std::string bytes = decode_base64(vtu.substr(begin, end - begin)).value();
  std::uint64_t length = 0;
  std::memcpy(&length, bytes.data(), 8);
  EXPECT_EQ(bytes.size(), 8 + length) << name;
  std::vector<T> values(length / sizeof(T));
  std::memcpy(values.data(), bytes.data() + 8, length);
  return values;
}
using Reals = std::vector<double>;
using Integers = std::vector<std::int64_t>;
using Bytes = std::vector<std::uint8_t>;

/// Two tetrahedra, with no two equal numbers.
Frame telling_frame() {
  Frame frame;
  frame.time = 0.1;
  frame.mesh = two_tetrahedra();
  for (std::size_t k = 0; k < frame.mesh.points.size(); ++k) {
    const auto n = static_cast<double>(k);
    frame.velocity.emplace_back(100 + n, 200 + n, 300 + n);
    frame.mass.push_back(0.5 + n);
  }
  frame.mesh_cell = {17, 11};
  frame.component = {1, 0};
  return frame;
}

Reals flat(const std::vector<Eigen::Vector3d>& vectors) {
  Reals all;
  for (const Eigen::Vector3d& v : vectors) all.insert(all.end(), v.data(), v.data() + 3);
  return all;
}

TEST(WriteVtu, PutsEveryColumnUnderItsName) {
  const Frame frame = telling_frame();
  const std::string vtu = to_vtu(frame);
  EXPECT_EQ(column<double>(vtu, "TimeValue", "Float64"), Reals{0.1});
  EXPECT_EQ(column<double>(vtu, "Points", "Float64"), flat(frame.mesh.points));
  EXPECT_EQ(column<double>(vtu, "velocity", "Float64"), flat(frame.velocity));
  EXPECT_EQ(column<double>(vtu, "mass", "Float64"), frame.mass);
  EXPECT_EQ(column<std::int64_t>(vtu, "mesh_cell", "Int64"), (Integers{17, 11}));
  EXPECT_EQ(column<std::int64_t>(vtu, "component", "Int64"), (Integers{1, 0}));
}

TEST(WriteVtu, SaysOfWhichSortAColumnIs) {
  const std::string vtu = to_vtu(telling_frame());
  const auto within = [&vtu](const char* section, const char* name) {
    const auto begin = vtu.find(std::string("<") + section), end = vtu.find(std::string("</") + section);
    return vtu.substr(begin, end - begin).find("Name=\"" + std::string(name) + "\"") != std::string::npos;
  };
  EXPECT_TRUE(within("FieldData", "TimeValue"));
  EXPECT_TRUE(within("PointData", "velocity"));
  EXPECT_TRUE(within("PointData", "mass"));
  EXPECT_TRUE(within("CellData", "mesh_cell"));
  EXPECT_TRUE(within("CellData", "component"));
  for (const char* vector : {"Points", "velocity"})
    EXPECT_NE(vtu.find("Name=\"" + std::string(vector) + "\" NumberOfComponents=\"3\""), std::string::npos);
  EXPECT_NE(vtu.find("Name=\"TimeValue\" NumberOfTuples=\"1\""), std::string::npos);
  EXPECT_NE(vtu.find("Name=\"mass\" NumberOfComponents=\"1\""), std::string::npos);
}

/// The same with all fields that a scene may request, and a spring.
Frame full_frame() {
  Frame frame = telling_frame();
  frame.fields = {.held = true, .stress = true, .displacement = true, .springs = true, .contact = true};
  frame.springs = {{3, 1}};
  frame.strain = {0.25};
  for (std::size_t k = 0; k < frame.mesh.points.size(); ++k) {
    const auto n = static_cast<double>(k);
    frame.held.push_back(static_cast<std::uint8_t>(k % 3));
    // of a pressure 2000 + n along x and tensions 1000 + n and 0 across
    frame.stress.emplace_back(Eigen::Vector3d(-2000 - n, 1000 + n, 0).asDiagonal());
    frame.displacement.emplace_back(400 + n, 500 + n, 600 + n);
    frame.contact_force.emplace_back(700 + n, 800 + n, 900 + n);
    frame.contact_depth.push_back(4000 + n);
  }
  frame.contact_pairs = {{.sample = {0, -1, -1, -1}, .obstacle = 4, .depth = 0.5},
                         {.sample = {0, 1, 2, -1}, .face = {3, 1, 2}, .depth = 0.25}};
  return frame;
}

TEST(WriteVtu, PutsEveryColumnThatIsAskedForUnderItsName) {
  const Frame frame = full_frame();
  const std::string vtu = to_vtu(frame),
                    points = vtu.substr(vtu.find("<PointData"), vtu.find("</PointData") - vtu.find("<PointData"));
  EXPECT_EQ(column<std::uint8_t>(points, "held", "UInt8"), frame.held);
  const auto expect_measure = [&](const char* name, double StressMeasures::*measure) {
    std::vector<double> expected;
    for (const Eigen::Matrix3d& stress : frame.stress) expected.push_back(measures_of(stress).*measure);
    EXPECT_EQ(column<double>(points, name, "Float64"), expected);
  };
  expect_measure("largest_principal_stress", &StressMeasures::largest_principal);
  expect_measure("largest_stress_magnitude", &StressMeasures::largest_magnitude);
  expect_measure("von_mises_stress", &StressMeasures::von_mises);
  EXPECT_EQ(column<double>(points, "displacement", "Float64"), flat(frame.displacement));
  EXPECT_EQ(column<double>(points, "contact_force", "Float64"), flat(frame.contact_force));
  EXPECT_EQ(column<double>(points, "contact_depth", "Float64"), frame.contact_depth);
  const std::string whole = vtu.substr(vtu.find("<FieldData"), vtu.find("</FieldData") - vtu.find("<FieldData"));
  EXPECT_EQ(column<std::int64_t>(whole, "contact_pair_sample", "Int64"), (Integers{0, -1, -1, -1, 0, 1, 2, -1}));
  EXPECT_EQ(column<std::int64_t>(whole, "contact_pair_face", "Int64"), (Integers{-1, -1, -1, 3, 1, 2}));
  EXPECT_EQ(column<std::int64_t>(whole, "contact_pair_obstacle", "Int64"), (Integers{4, -1}));
  EXPECT_EQ(column<double>(whole, "contact_pair_depth", "Float64"), (std::vector<double>{0.5, 0.25}));
  EXPECT_NE(whole.find("Name=\"contact_pair_face\" NumberOfComponents=\"3\" NumberOfTuples=\"2\""), std::string::npos);
  EXPECT_NE(points.find("Name=\"displacement\" NumberOfComponents=\"3\""), std::string::npos);
  EXPECT_EQ(vtu.find("\"tension\""), std::string::npos);
  const std::string bare = to_vtu(telling_frame());
  for (const char* name : {"held", "stress", "displacement", "tension", "strain", "contact"})
    EXPECT_EQ(bare.find(name), std::string::npos) << name;
}

TEST(WriteVtu, ListsSpringsAsLinesAfterTheCellsThatAreNoneOfThem) {
  const std::string vtu = to_vtu(full_frame());
  EXPECT_NE(vtu.find("NumberOfCells=\"3\""), std::string::npos);
  EXPECT_EQ(column<std::uint8_t>(vtu, "types", "UInt8"), (Bytes{10, 10, 3}));
  EXPECT_EQ(column<std::int64_t>(vtu, "offsets", "Int64"), (Integers{4, 8, 10}));
  const Integers ends = column<std::int64_t>(vtu, "connectivity", "Int64");
  EXPECT_EQ(Integers(ends.end() - 2, ends.end()), (Integers{3, 1}));
  EXPECT_EQ(column<std::int64_t>(vtu, "mesh_cell", "Int64"), (Integers{17, 11, -1}));
  EXPECT_EQ(column<std::int64_t>(vtu, "component", "Int64"), (Integers{1, 0, -1}));
  EXPECT_EQ(column<double>(vtu, "strain", "Float64"), (Reals{0, 0, 0.25}));
}

TEST(WriteVtu, GivesTheLinksOfAChainTheirTensionAndStrain) {
  Frame chain;
  chain.mesh.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  chain.velocity.assign(3, {0, 0, 0});
  chain.mass.assign(3, 1.0);
  chain.links = {{0, 1}, {1, 2}};
  chain.mesh_cell = {0, 1};
  chain.component = {0, 0};
  chain.fields = {.stress = true, .springs = true};
  chain.tension = {5, -6};
  chain.strain = {0.5, -0.25};
  const std::string vtu = to_vtu(chain), cells = vtu.substr(vtu.find("<CellData"));
  EXPECT_EQ(column<double>(cells, "tension", "Float64"), (Reals{5, -6}));
  EXPECT_EQ(column<double>(cells, "strain", "Float64"), (Reals{0.5, -0.25}));
  EXPECT_EQ(column<std::int64_t>(vtu, "mesh_cell", "Int64"), (Integers{0, 1}));
  EXPECT_EQ(vtu.find("_stress"), std::string::npos);
}

// The numbers of VTK's types, and its wedge: "a triangle whose normal points outward", where ours points inward.
TEST(WriteVtu, ListsCellsAsVtkDoes) {
  Frame frame;
  frame.mesh = mixed_cells();
  frame.velocity.assign(frame.mesh.points.size(), {0, 0, 0});
  frame.mass.assign(frame.mesh.points.size(), 1.0);
  frame.mesh_cell = {0, 1, 2, 3};
  frame.component = {0, 0, 0, 0};
  const std::string vtu = to_vtu(frame);
  EXPECT_EQ(column<std::uint8_t>(vtu, "types", "UInt8"), (Bytes{12, 14, 13, 10}));
  EXPECT_EQ(column<std::int64_t>(vtu, "offsets", "Int64"), (Integers{8, 13, 19, 23}));
  // prism 1 5 9, 2 6 10 (meshes_for_tests.h)
  EXPECT_EQ(column<std::int64_t>(vtu, "connectivity", "Int64"),
            (Integers{0, 1, 2, 3, 4, 5, 6, 7, 4, 5, 6, 7, 8, 1, 9, 5, 2, 10, 6, 1, 9, 5, 11}));
}

TEST(WriteVtu, ListsPolygonsAndLinksAsVtkDoes) {
  Frame surface;
  surface.mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}};
  surface.mesh.add_cell(CellKind::quadrilateral, std::array<std::uint32_t, 4>{0, 1, 2, 3});
  surface.mesh.add_cell(CellKind::triangle, std::array<std::uint32_t, 3>{1, 4, 2});
  surface.velocity.assign(5, {0, 0, 0});
  surface.mass.assign(5, 1.0);
  surface.mesh_cell = surface.component = {0, 0};
  EXPECT_EQ(column<std::uint8_t>(to_vtu(surface), "types", "UInt8"), (Bytes{9, 5}));

  Frame chain;
  chain.mesh.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  chain.velocity.assign(3, {0, 0, 0});
  chain.mass.assign(3, 1.0);
  chain.links = {{0, 1}, {1, 2}};
  chain.mesh_cell = {0, 1};
  chain.component = {0, 0};
  const std::string vtu = to_vtu(chain);
  EXPECT_EQ(column<std::uint8_t>(vtu, "types", "UInt8"), (Bytes{3, 3}));
  EXPECT_EQ(column<std::int64_t>(vtu, "connectivity", "Int64"), (Integers{0, 1, 1, 2}));
  EXPECT_EQ(column<std::int64_t>(vtu, "offsets", "Int64"), (Integers{2, 4}));
  EXPECT_EQ(column<std::int64_t>(vtu, "mesh_cell", "Int64"), (Integers{0, 1}));
  EXPECT_EQ(column<std::int64_t>(vtu, "component", "Int64"), (Integers{0, 0}));
}

TEST(WriteVtu, RefusesEachColumnOfAnotherLength) {
  const std::function<void(Frame&)> shortened[] = {
      [](Frame& f) { f.velocity.pop_back(); }, [](Frame& f) { f.mass.pop_back(); },
      [](Frame& f) { f.mesh_cell.pop_back(); }, [](Frame& f) { f.component.pop_back(); },
      [](Frame& f) { f.held.pop_back(); }, [](Frame& f) { f.stress.pop_back(); },
      [](Frame& f) { f.displacement.pop_back(); }, [](Frame& f) { f.springs.pop_back(); },
      [](Frame& f) { f.strain.pop_back(); }, [](Frame& f) { f.tension.push_back(1.0); },
      [](Frame& f) { f.contact_force.pop_back(); }, [](Frame& f) { f.contact_depth.pop_back(); },
      // columns that no field requests
      [](Frame& f) { f.fields.held = false; }, [](Frame& f) { f.fields.displacement = false; },
      [](Frame& f) { f.fields.contact = false; },
      [](Frame& f) {
        f.fields.contact = false;
        f.contact_force.clear();
        f.contact_depth.clear();
      }};
  EXPECT_NO_THROW(to_vtu(full_frame()));
  for (const auto& shorten : shortened) {
    Frame frame = full_frame();
    shorten(frame);
    EXPECT_ANY_THROW(to_vtu(frame));
  }
}

// ---- diagnostics.csv

std::vector<std::string> fields(const std::string& row) {
  std::vector<std::string> all;
  std::istringstream stream(row.substr(0, row.size() - 1));
  for (std::string field; std::getline(stream, field, ',');) all.push_back(field);
  return all;
}

std::map<std::string, double> named(const Diagnostics& d, int dimension) {
  const auto heads = fields(diagnostics_header(dimension, d.applied.has_value(), d.contact.has_value())),
             values = fields(diagnostics_row(d));
  std::map<std::string, double> all;
  EXPECT_EQ(heads.size(), values.size());
  for (std::size_t k = 0; k < std::min(heads.size(), values.size()); ++k) all[heads[k]] = std::stod(values[k]);
  return all;
}

TEST(Diagnostics, PutEveryNumberUnderItsName) {
  const Diagnostics d{.time = 1.25,
                      .kinetic = 2,
                      .elastic = 3,
                      .gravitational = -4,
                      .momentum = {5, 6, 7},
                      .angular_momentum = {8, 9, 10},
                      .mass = 11,
                      .counts = {.vertices = 12, .edges = 13, .faces = 14, .cells = 15, .components = 16},
                      .boundary = 17,
                      .largest_stress = 18,
                      .operations = 19};
  const std::map<std::string, double> expected{{"time [s]", 1.25},
                                               {"kinetic [J]", 2},
                                               {"elastic [J]", 3},
                                               {"gravitational [J]", -4},
                                               {"momentum x [kg m/s]", 5},
                                               {"momentum y [kg m/s]", 6},
                                               {"momentum z [kg m/s]", 7},
                                               {"angular momentum x [kg m^2/s]", 8},
                                               {"angular momentum y [kg m^2/s]", 9},
                                               {"angular momentum z [kg m^2/s]", 10},
                                               {"mass [kg]", 11},
                                               {"vertices", 12},
                                               {"edges", 13},
                                               {"faces", 14},
                                               {"cells", 15},
                                               {"components", 16},
                                               {"boundary [m^2]", 17},
                                               {"largest principal stress [Pa]", 18},
                                               {"operations", 19}};
  EXPECT_EQ(named(d, 3), expected);
  EXPECT_EQ(d.energy(), 2 + 3 - 4);
  Diagnostics pulled = d;
  pulled.applied = 20;
  auto with_applied = expected;
  with_applied["applied forces [J]"] = 20;
  EXPECT_EQ(named(pulled, 3), with_applied);
  EXPECT_EQ(pulled.energy(), 2 + 3 - 4 + 20);
  Diagnostics touching = d;
  touching.contact = {.energy = 21, .damped = 22, .rubbed = 23, .supplied = 24, .contacts = 25, .deepest = 26};
  auto with_contact = expected;
  with_contact.insert({{"contact [J]", 21},
                       {"lost by restitution [J]", 22},
                       {"lost by friction [J]", 23},
                       {"supplied at contacts [J]", 24},
                       {"contacts", 25},
                       {"deepest contact [m]", 26}});
  EXPECT_EQ(named(touching, 3), with_contact);
  EXPECT_EQ(touching.energy(), 2 + 3 - 4 + 21);
  touching.applied = 20;
  with_contact["applied forces [J]"] = 20;
  EXPECT_EQ(named(touching, 3), with_contact);
  for (double ContactDiagnostics::*number : {&ContactDiagnostics::energy, &ContactDiagnostics::damped,
                                             &ContactDiagnostics::rubbed, &ContactDiagnostics::supplied}) {
    Diagnostics wrong = touching;
    EXPECT_TRUE(is_finite(wrong));
    (*wrong.contact).*number = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(is_finite(wrong));
  }
}

TEST(Diagnostics, AreWrittenSoThatTheyAreReadBackWithEveryBit) {
  Diagnostics d;
  d.kinetic = 0.1;
  d.elastic = 1.0 / 3;
  d.largest_stress = 0x1.fffffffffffffp-1022;
  const auto read = named(d, 3);
  EXPECT_EQ(read.at("kinetic [J]"), 0.1);
  EXPECT_EQ(read.at("elastic [J]"), 1.0 / 3);
  EXPECT_EQ(read.at("largest principal stress [Pa]"), 0x1.fffffffffffffp-1022);
}

TEST(Diagnostics, AreFiniteOnlyIfEveryNumberIs) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const std::function<void(Diagnostics&)> spoilt[] = {[](Diagnostics& d) { d.time = infinite; },
                                                      [](Diagnostics& d) { d.kinetic = infinite; },
                                                      [](Diagnostics& d) { d.elastic = infinite; },
                                                      [](Diagnostics& d) { d.gravitational = -infinite; },
                                                      [](Diagnostics& d) { d.mass = infinite; },
                                                      [](Diagnostics& d) { d.boundary = infinite; },
                                                      [](Diagnostics& d) { d.largest_stress = infinite; },
                                                      [](Diagnostics& d) { d.momentum[1] = infinite; },
                                                      [](Diagnostics& d) { d.angular_momentum[2] = infinite; }};
  for (const auto& spoil : spoilt) {
    Diagnostics d;
    ASSERT_TRUE(is_finite(d));
    spoil(d);
    EXPECT_FALSE(is_finite(d)) << diagnostics_row(d);
  }
}

// ---- the folder

using SceneOutputTest = FolderTest;

TEST_F(SceneOutputTest, ListsEachFrameWithItsTimeUnderItsNumber) {
  SceneOutput output(folder_ / "run");
  Frame frame = telling_frame();
  for (const double time : {0.0, 0.1, 0.3}) {
    frame.time = time;
    output.write(frame);
  }
  EXPECT_EQ(output.frame_count(), 3u);
  const std::string list = text("run/frames.pvd");
  for (const char* entry : {"timestep=\"0\" part=\"0\" file=\"frame_000000.vtu\"",
                            "timestep=\"0.10000000000000001\" part=\"0\" file=\"frame_000001.vtu\"",
                            "timestep=\"0.29999999999999999\" part=\"0\" file=\"frame_000002.vtu\""})
    EXPECT_NE(list.find(entry), std::string::npos) << list;
  EXPECT_EQ(column<double>(text("run/frame_000002.vtu"), "TimeValue", "Float64"), Reals{0.3});
}

TEST_F(SceneOutputTest, PutsRowsOfDiagnosticsAndOfProbesInFilesOfTheirOwnInTheirOrder) {
  const std::vector<Probe> probes{{"a", 0u, ""}};
  SceneOutput output(folder_ / "run", probes, 2);
  Diagnostics first, second;
  first.time = 1;
  second.time = 2;
  output.write(first);
  output.write(ProbeRow{0.5, {VertexMotion{{1, 2, 3}, {4, 5, 6}}}});
  output.write(second);
  EXPECT_EQ(text("run/diagnostics.csv"), diagnostics_header(2) + diagnostics_row(first) + diagnostics_row(second));
  EXPECT_EQ(text("run/probes.csv"), probes_header(probes) + "0.5,1,2,3,4,5,6\n");
}

}  // namespace
}  // namespace dartboard::simulation_output_test
