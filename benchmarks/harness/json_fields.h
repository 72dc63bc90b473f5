#pragma once
// Records of samples as JSON objects, by the names of their fields.

#include <nlohmann/json.hpp>

/// Defines to_json and from_json of a record, declared in its header.
/// throws  nlohmann::json::exception by from_json, for a field that is missing or of another type
#define DARTBOARD_JSON_FIELDS(Record, ...)                                         \
  void to_json(nlohmann::json& nlohmann_json_j, const Record& nlohmann_json_t) {   \
    NLOHMANN_JSON_EXPAND(NLOHMANN_JSON_PASTE(NLOHMANN_JSON_TO, __VA_ARGS__))       \
  }                                                                                \
  void from_json(const nlohmann::json& nlohmann_json_j, Record& nlohmann_json_t) { \
    NLOHMANN_JSON_EXPAND(NLOHMANN_JSON_PASTE(NLOHMANN_JSON_FROM, __VA_ARGS__))     \
  }
