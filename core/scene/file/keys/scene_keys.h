#pragma once
// The one table that defines every key of a scene file; the parser (scene_check.h), the JSON Schema and the
// reference page (scene_pages.h) are made from it.

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dartboard {

/// The kinds of object that a scene file is made of.
enum class Shape {
  scene,
  body,
  one_body,
  generate,
  box_mesh,
  sheet_mesh,
  ball_mesh,
  chain_mesh,
  material,
  tissue,
  region,
  bending,
  damping,
  velocity,
  vertex_selection,
  held,
  driven,
  driven_place,
  driven_turn,
  driven_angle,
  force,
  force_factor,
  attachment,
  air,
  contact,
  contact_pair,
  obstacle,
  cell_selection,
  tag,
  box,
  plane,
  sphere,
  around,
  random,
  event,
  dissociate,
  within,
  blade,
  rotation,
  tear,
  stress,
  refine,
  sleep,
  output,
  cadence,
  probe,
  expect,
  expected_place,
};

struct ShapeHelp {
  Shape shape;
  std::string_view name, help;
};
std::span<const ShapeHelp> scene_shapes();
const ShapeHelp& help_of(Shape shape);

enum class ValueType {
  text,
  choice,
  choices,  // a list of choices, each at most once
  integer,
  integers,  // a list of integers
  real,
  point,    // three numbers
  points,   // a list of points
  matrix,   // three rows of three numbers
  object,   // of the shape `of`
  objects,  // a list of objects
  point_or_object,
  real_or_object,
  integer_pair,
  integer_triple,
  integer_lists,
};

/// The allowed range of a number: from `least` to `most`, excluding `least` itself where `above` is true.
struct Range {
  double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();
  bool above = false;
};

/// One key of one shape.
struct SceneKey {
  Shape shape{};
  std::string_view name{};
  ValueType type{};
  Shape of{};                          // of an object
  std::string_view unit{};             // empty without a unit
  Range range{};                       // of every number in the value
  std::size_t least_size = 0;          // of a list of points or words
  std::vector<std::string> choices{};  // of a choice or choices
  bool required = false;
  std::string_view standard{};  // the default as JSON; empty where a key that is left out has no value
  std::string_view help{};
};

std::span<const SceneKey> scene_keys();
/// The row of a key; null for a key that the shape does not have.
const SceneKey* find_key(Shape shape, std::string_view name);

/// The integrator of a scene that gives a step and does not name an integrator.
inline constexpr const char* standard_integrator = "rk4";

/// A rule about which keys of one object are given together. Rules that need values, or keys of other objects, are rows
/// of core/scene/file/scene_rules.cpp.
struct SceneRule {
  // excludes: the first key excludes the others; needs_object: if the first is given, the others are objects
  enum Kind { exactly_one, at_most_one, excludes, needs_object } kind;
  Shape shape;
  std::vector<std::string_view> keys;
};
std::span<const SceneRule> scene_rules();

/// Rows that are written beside what they are about.
struct KeyRows {
  std::vector<SceneKey> keys{};
  std::vector<ShapeHelp> shapes{};
  std::vector<SceneRule> rules{};
};
/// Those of the kinds of force (core/scene/forces).
KeyRows keys_of_forces();

/// "a number > 0 [kg/m^3]": what is expected of a value, in words.
std::string expectation(const SceneKey& key);

/// "'a', 'b'": words in quotes.
std::string quoted_list(const std::vector<std::string>& words, std::string_view between);

}  // namespace dartboard
