#include "validation/contact/contact_scenes.h"

namespace dartboard {
namespace {

constexpr const char* collision = R"({"name": "collision", "step": 0.0002, "duration": 0.08, "integrator": "verlet",
  "bodies": [{"generate": {"box": {"cells": [2, 2, 2], "spacing": 0.05, "pattern": "kuhn"}}},
             {"generate": {"box": {"cells": [2, 2, 2], "spacing": 0.04, "pattern": "kuhn"}},
              "rotate": {"axis": [1, 2, 0.5], "degrees": 25}, "translate": [0.01, 0.02, 0.13],
              "initial_velocity": {"constant": [0.2, 0.1, -0.5], "linear": [[0, -2, 0], [2, 0, 0], [0, 0, 0]],
                                   "centre": [0.05, 0.05, 0.16]}}],
  "gravity": [0, 0, 0], "material": {"density": 1000, "young": 200000, "damping": 0, "viscosity": 0},
  "contact": {"pressure": 90000, "depth": 0.01, "bodies": "all"}})";

constexpr const char* cut = R"({"name": "cut", "step": 0.0002, "duration": 0.06, "integrator": "verlet",
  "body": {"generate": {"box": {"cells": [6, 3, 3], "spacing": 0.04, "pattern": "kuhn"}}, "translate": [-0.12, 0, 0]},
  "gravity": [0, 0, 0], "material": {"density": 1000, "young": 200000, "damping": 0, "viscosity": 0},
  "initial_velocity": {"linear": [[-3, 0, 0], [0, 0, 0], [0, 0, 0]]},
  "contact": {"pressure": 20000, "depth": 0.01, "bodies": "themselves"},
  "events": [{"at": 0.001, "dissociate": {"plane": {"point": [0, 0, 0], "normal": [1, 0, 0]}}}]})";

constexpr const char* stack = R"({"name": "stack", "step": 0.0002, "duration": 0.2, "integrator": "verlet",
  "bodies": [{"generate": {"box": {"cells": [2, 2, 2], "spacing": 0.05, "pattern": "kuhn"}}},
             {"generate": {"box": {"cells": [2, 2, 2], "spacing": 0.04, "pattern": "kuhn"}}, "translate": [0.01, 0.012, 0.102]},
             {"generate": {"box": {"cells": [1, 1, 1], "spacing": 0.06, "pattern": "kuhn"}}, "translate": [0.02, 0.024, 0.184]}],
  "material": {"density": 1000, "young": 200000, "damping": 0, "viscosity": 0},
  "contact": {"pressure": 20000, "depth": 0.01, "bodies": "others", "restitution": 0.3, "friction": 0.4,
              "obstacles": [{"plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}}]}})";

SceneFile parsed(const char* text) { return parse_scene(text, "scene of contact", ""); }

}  // namespace

SceneFile scene_of_collision() { return parsed(collision); }
SceneFile scene_of_cut() { return parsed(cut); }
std::vector<SceneFile> contact_scenes() { return {scene_of_collision(), scene_of_cut(), parsed(stack)}; }

}  // namespace dartboard
