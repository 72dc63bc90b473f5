#include "benchmarks/cli/scenes/simulation_json.h"

#include <gtest/gtest.h>

#include <limits>

namespace dartboard::simulation_json_test {
namespace {

const Diagnostics telling{.time = 1,
                          .kinetic = 2,
                          .elastic = 3,
                          .gravitational = 4,
                          .momentum = {5, 6, 7},
                          .angular_momentum = {8, 9, 10},
                          .mass = 11,
                          .counts = {.vertices = 12, .edges = 13, .faces = 14, .cells = 15, .components = 16},
                          .boundary = 17,
                          .largest_stress = 18,
                          .operations = 19};

TEST(SimulationJson, OfDiagnosticsHasEveryNumberUnderItsName) {
  EXPECT_EQ(nlohmann::json(to_json(telling, 3)),
            nlohmann::json::parse(R"({"time": 1.0, "kinetic": 2.0, "elastic": 3.0, "gravitational": 4.0, "mass": 11.0,
                                      "vertices": 12, "edges": 13, "faces": 14, "cells": 15, "components": 16,
                                      "boundary": 17.0, "largest_principal_stress": 18.0, "operations": 19})"));
}

TEST(SimulationJson, OfContactHasEveryNumberUnderItsName) {
  Diagnostics touching = telling;
  touching.contact = {.energy = 21, .damped = 22, .rubbed = 23, .supplied = 24, .contacts = 25, .deepest = 26};
  nlohmann::json more = to_json(touching, 3);
  const nlohmann::json known = to_json(telling, 3);
  for (const auto& [name, value] : known.items()) more.erase(name);
  EXPECT_EQ(more, nlohmann::json::parse(R"({"contact": 21.0, "lost_by_restitution": 22.0, "lost_by_friction": 23.0,
                                            "supplied_at_contacts": 24.0, "contacts": 25, "deepest_contact": 26.0})"));
}

TEST(SimulationJson, NamesTheStressOfASurfaceAsThatOfASolidAndTheTensionOfAChain) {
  EXPECT_EQ(to_json(telling, 2).at("largest_principal_stress"), 18.0);
  EXPECT_EQ(to_json(telling, 0).at("largest_tension"), 18.0);
  EXPECT_FALSE(to_json(telling, 0).contains("largest_principal_stress"));
}

TEST(SimulationJson, OfJumpsHasEveryNumberUnderItsName) {
  const EventJumps jumps{.events = 1, .mass = 2, .stiffness = 5, .momentum = 3, .energy = 4, .contact = 6};
  EXPECT_EQ(nlohmann::json(to_json(jumps)),
            nlohmann::json::parse(R"({"events": 1, "mass": 2.0, "stiffness": 5.0, "momentum": 3.0, "energy": 4.0,
                                      "contact": 6.0})"));
}

TEST(SimulationJson, HasNullForWhatIsNotFinite) {
  Diagnostics d = telling;
  d.kinetic = d.elastic = d.gravitational = d.boundary = std::numeric_limits<double>::quiet_NaN();
  d.largest_stress = std::numeric_limits<double>::infinity();
  for (const char* name : {"kinetic", "elastic", "gravitational", "boundary", "largest_principal_stress"})
    EXPECT_TRUE(to_json(d, 3).at(name).is_null()) << name;
}

}  // namespace
}  // namespace dartboard::simulation_json_test
