// Steps in contact, counted by how often they take memory. This executable has an allocator of its own.

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdlib>
#include <new>
#include <string>

#include "core/scene/run/simulation.h"

namespace {
std::size_t allocations = 0;
}

// not inline, where a compiler would see one side of a pair alone
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace dartboard::contact_allocations_test {
namespace {

/// Two boxes that have come to rest on each other and on a floor, with friction.
SceneFile boxes_at_rest() {
  return parse_scene(R"({"name": "rest", "step": 2e-4, "duration": 10, "integrator": "verlet",
    "bodies": [{"generate": {"box": {"cells": [3, 3, 2], "spacing": 0.05}}},
               {"generate": {"box": {"cells": [2, 2, 2], "spacing": 0.04}}, "translate": [0.013, 0.021, 0.0985]}],
    "material": {"density": 1000, "young": 200000, "poisson": 0.3, "viscosity": 40},
    "contact": {"pressure": 20000, "depth": 0.01, "bodies": "all", "restitution": 0.3, "friction": 0.4,
                "obstacles": [{"plane": {"point": [0, 0, 0.001], "normal": [0, 0, 1]}}]}})",
                     "boxes at rest", "");
}

void run(Simulation& simulation, int steps) {
  for (int k = 0; k < steps; ++k) ASSERT_FALSE(simulation.advance());
}

TEST(ContactAllocations, AreCounted) {
  const std::size_t before = allocations;
  const std::string text(1000, 'x');
  EXPECT_EQ(allocations, before + 1) << text;
}

TEST(ContactAllocations, AreNotMadeInTheSteadyState) {
  Simulation simulation(boxes_at_rest());
  run(simulation, 1500);
  const ContactDiagnostics touching = *simulation.diagnostics().contact;
  ASSERT_GT(touching.contacts, 20u);
  ASSERT_GT(simulation.body().contacts().state_at(simulation.body().vertices().position).contacts, 10u);
  const std::size_t before = allocations;
  run(simulation, 200);
  EXPECT_EQ(allocations, before);
}

}  // namespace
}  // namespace dartboard::contact_allocations_test
