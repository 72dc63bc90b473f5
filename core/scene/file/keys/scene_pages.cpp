#include "core/scene/file/keys/scene_pages.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <vector>

#include "core/plain/error.h"
#include "core/scene/file/keys/scene_keys.h"

namespace dartboard {
namespace {

using Json = nlohmann::ordered_json;

Json reference_to(Shape shape) { return {{"$ref", fmt::format("#/$defs/{}", help_of(shape).name)}}; }

Json number_schema(const SceneKey& key, const char* type) {
  Json schema{{"type", type}};
  // counts are written in full digits
  const auto put = [&schema, type](const char* name, double value) {
    if (std::string_view(type) == "integer")
      schema[name] = static_cast<std::int64_t>(value);
    else
      schema[name] = value;
  };
  if (std::isfinite(key.range.least)) put(key.range.above ? "exclusiveMinimum" : "minimum", key.range.least);
  if (std::isfinite(key.range.most)) put("maximum", key.range.most);
  return schema;
}

Json list_schema(Json items, std::size_t least, std::optional<std::size_t> most) {
  Json schema{{"type", "array"}, {"items", std::move(items)}};
  if (least > 0) schema["minItems"] = least;
  if (most) schema["maxItems"] = *most;
  return schema;
}

Json value_schema(const SceneKey& key) {
  const auto integer = [&key] { return number_schema(key, "integer"); };
  const auto point = [&key] { return list_schema(number_schema(key, "number"), 3, 3); };
  switch (key.type) {
    case ValueType::text: return {{"type", "string"}};
    case ValueType::choice: return {{"enum", key.choices}};
    case ValueType::choices: {
      Json schema = list_schema({{"enum", key.choices}}, 0, {});
      schema["uniqueItems"] = true;
      return schema;
    }
    case ValueType::integer: return integer();
    case ValueType::integers: return list_schema(integer(), 1, {});
    case ValueType::real: return number_schema(key, "number");
    case ValueType::point: return point();
    case ValueType::points: return list_schema(point(), key.least_size, {});
    case ValueType::matrix: return list_schema(point(), 3, 3);
    case ValueType::object: return reference_to(key.of);
    case ValueType::objects: return list_schema(reference_to(key.of), 0, {});
    case ValueType::point_or_object: return {{"anyOf", {point(), reference_to(key.of)}}};
    case ValueType::real_or_object: return {{"anyOf", {number_schema(key, "number"), reference_to(key.of)}}};
    case ValueType::integer_pair: return list_schema(integer(), 2, 2);
    case ValueType::integer_triple: return list_schema(integer(), 3, 3);
    case ValueType::integer_lists: break;
  }
  return list_schema(list_schema(integer(), 2, 3), 1, {});
}

std::string help_with_unit(const SceneKey& key) {
  return key.unit.empty() ? std::string(key.help) : fmt::format("{} [{}]", key.help, key.unit);
}

Json required(std::string_view key) { return {{"required", {key}}}; }

void add_rule(Json& schema, const SceneRule& rule) {
  Json any = Json::array();
  for (const auto key : rule.keys) any.push_back(required(key));
  if (rule.kind == SceneRule::exactly_one) schema["oneOf"] = any;
  if (rule.kind == SceneRule::at_most_one) schema["allOf"].push_back({{"not", {{"required", rule.keys}}}});
  if (rule.kind == SceneRule::excludes) {
    any.erase(any.begin());
    schema["dependentSchemas"][std::string(rule.keys[0])] = {{"not", {{"anyOf", any}}}};
  }
  if (rule.kind == SceneRule::needs_object)
    for (std::size_t k = 1; k < rule.keys.size(); ++k)
      schema["dependentSchemas"][std::string(rule.keys[0])]["properties"][std::string(rule.keys[k])] = {
          {"type", "object"}};
}

Json shape_schema(const ShapeHelp& shape) {
  Json schema{{"type", "object"}, {"description", shape.help}, {"additionalProperties", false}};
  Json properties = Json::object(), needed = Json::array();
  for (const SceneKey& key : scene_keys()) {
    if (key.shape != shape.shape) continue;
    Json property = value_schema(key);
    property["description"] = help_with_unit(key);
    if (!key.standard.empty()) property["default"] = Json::parse(key.standard);
    properties[std::string(key.name)] = property;
    if (key.required) needed.push_back(key.name);
  }
  schema["properties"] = properties;
  if (!needed.empty()) schema["required"] = needed;
  for (const SceneRule& rule : scene_rules())
    if (rule.shape == shape.shape) add_rule(schema, rule);
  return schema;
}

std::string rule_text(const SceneRule& rule) {
  std::vector<std::string> names(rule.keys.begin(), rule.keys.end());
  if (rule.kind == SceneRule::exactly_one) return "exactly one of " + quoted_list(names, ", ");
  if (rule.kind == SceneRule::at_most_one) return "at most one of " + quoted_list(names, ", ");
  const std::string first = names[0];
  names.erase(names.begin());
  if (rule.kind == SceneRule::needs_object)
    return fmt::format("together with '{}', {} as an object", first, quoted_list(names, ", "));
  return fmt::format("'{}' stands without {}", first, quoted_list(names, ", "));
}

std::string row_of(const SceneKey& key) {
  const std::string standard = key.required           ? "required"
                               : key.standard.empty() ? "-"
                                                      : fmt::format("`{}`", key.standard);
  return fmt::format("| `{}` | {} | {} | {} |\n", key.name, expectation(key), standard, key.help);
}

bool may_be_object(const SceneKey& key) {
  return key.type == ValueType::object || key.type == ValueType::objects || key.type == ValueType::point_or_object ||
         key.type == ValueType::real_or_object;
}

std::string section_of(const ShapeHelp& shape) {
  std::string section = fmt::format("## {}\n\n{}\n", shape.name, shape.help);
  for (const SceneRule& rule : scene_rules())
    if (rule.shape == shape.shape) section += fmt::format("\nKeys: {}.\n", rule_text(rule));
  section += "\n| key | value | default | what it is |\n|---|---|---|---|\n";
  for (const SceneKey& key : scene_keys())
    if (key.shape == shape.shape) section += row_of(key);
  return section;
}

/// The rows of a key in all objects that have it, and the sections about the objects that are its values.
std::string pages_about_key(std::string_view name) {
  std::string rows, sections;
  std::set<std::string_view> values;
  for (const SceneKey& key : scene_keys()) {
    if (key.name != name) continue;
    rows += fmt::format("| {} {}", help_of(key.shape).name, row_of(key));
    if (may_be_object(key) && values.insert(help_of(key.of).name).second)
      sections += "\n" + section_of(help_of(key.of));
  }
  if (rows.empty()) return "";
  return fmt::format("| object | key | value | default | what it is |\n|---|---|---|---|---|\n{}{}", rows, sections);
}

}  // namespace

Json scene_schema() {
  Json definitions = Json::object();
  for (const ShapeHelp& shape : scene_shapes())
    if (shape.shape != Shape::scene) definitions[std::string(shape.name)] = shape_schema(shape);
  Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "Dartboard scene"}};
  schema.update(shape_schema(help_of(Shape::scene)));
  schema["$defs"] = definitions;
  return schema;
}

std::string scene_reference() {
  std::string page =
      "# The keys of a scene file\n\nStrict JSON (RFC 8259), no comments. An unknown key, a key given twice, a value "
      "of "
      "another type or outside its range is an error that names its path. Made from the table in "
      "`core/scene/file/keys/scene_keys.cpp` by `dartboard scene --keys`.\n";
  for (const ShapeHelp& shape : scene_shapes()) page += "\n" + section_of(shape);
  return page;
}

std::string scene_reference(std::string_view object_or_key) {
  std::vector<std::string> names;
  for (const ShapeHelp& shape : scene_shapes()) {
    if (shape.name == object_or_key) return section_of(shape);
    names.emplace_back(shape.name);
  }
  if (std::string pages = pages_about_key(object_or_key); !pages.empty()) return pages;
  throw InputError(fmt::format("no object or key of scenes is called '{}'; expected a key, or one of the objects: {}",
                               object_or_key, fmt::join(names, ", ")));
}

}  // namespace dartboard
