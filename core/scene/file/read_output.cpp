#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "core/scene/file/keys/scene_value.h"
#include "core/scene/file/read_parts.h"

namespace dartboard {
namespace {

Probe read_probe(const SceneValue& value, const std::vector<Probe>& others) {
  Probe probe{value.get<std::string>("name"), {}, value.path()};
  for (const Probe& other : others)
    if (other.name == probe.name)
      value.fail_at("name", fmt::format("is {}, like {}/name", value.at("name").shown(), other.path),
                    "a name of its own");
  if (probe.name.empty()) value.fail_at("name", "is empty", "a name");
  if (const auto point = value.find<std::uint32_t>("vertex"))
    probe.vertex = *point;
  else
    probe.vertex = value.get<Eigen::Vector3d>("near");
  return probe;
}

ExpectedPlace read_place(const SceneValue& value, const std::vector<Probe>& probes) {
  const auto probe = std::ranges::find(probes, value.get<std::string>("probe"), &Probe::name);
  if (probe == probes.end())
    value.fail_at("probe", "is " + value.at("probe").shown(), "the name of one of /output/probes");
  return {.probe = static_cast<std::size_t>(probe - probes.begin()),
          .position = value.get<Eigen::Vector3d>("position"),
          .within = value.get<double>("within"),
          .of_part = value.get<std::string>("of") == "part",
          .why = value.get<std::string>("why")};
}

}  // namespace

OutputPlan read_output(const SceneValue& value) {
  OutputPlan plan;
  const auto take_every = [&value](const char* key, auto& time, auto& steps) {
    if (!value.has(key)) return;
    if (const SceneValue every = value.at(key); every.json().is_number())
      time = every.as<double>();
    else
      steps = every.get<std::uint64_t>("steps");
  };
  take_every("frames_every", plan.frame_time, plan.frame_steps);
  take_every("diagnostics_every", plan.diagnostic_time, plan.diagnostic_steps);
  take_every("probes_every", plan.probe_time, plan.probe_steps);
  plan.checkpoint_time = value.find<double>("checkpoint");
  const auto has_field = [fields = value.get<std::vector<std::string>>("fields")](std::string_view name) {
    return std::ranges::find(fields, name) != fields.end();
  };
  plan.fields = {.held = has_field("held"),
                 .stress = has_field("stress"),
                 .displacement = has_field("displacement"),
                 .springs = has_field("springs"),
                 .contact = has_field("contact")};
  if (const auto name = value.get<std::string>("compressed"); name == "zlib")
    plan.compressor = Compressor::zlib;
  else if (name == "lz4")
    plan.compressor = Compressor::lz4;
  return plan;
}

std::vector<Probe> read_probes(const SceneValue& list) {
  std::vector<Probe> probes;
  for (const SceneValue& value : list.entries()) probes.push_back(read_probe(value, probes));
  return probes;
}

Expectation read_expectation(const SceneValue& value, const std::vector<Probe>& probes) {
  Expectation e;
  for (const SceneValue& place : value.at("places").entries()) e.places.push_back(read_place(place, probes));
  const auto take = [&value]<class T>(const char* key, std::optional<T>& into) { into = value.find<T>(key); };
  take("vertices", e.vertices);
  take("edges", e.edges);
  take("faces", e.faces);
  take("cells", e.cells);
  take("components", e.components);
  take("components_at_least", e.components_at_least);
  take("operations", e.operations);
  take("mass", e.mass);
  take("kinetic_at_most", e.kinetic_at_most);
  take("energy_drift_at_most", e.energy_drift_at_most);
  e.why = value.get<std::string>("why");
  return e;
}

std::optional<std::uint64_t> read_hash(const SceneValue& expectation) {
  const auto digits = expectation.find<std::string>("hash");
  if (!digits) return std::nullopt;
  std::uint64_t value = 0;
  const char* const last = digits->data() + digits->size();
  const auto [end, error] = std::from_chars(digits->data(), last, value, 16);
  if (digits->size() != 16 || error != std::errc() || end != last)
    expectation.fail_at("hash", "is " + expectation.at("hash").shown(), "16 hexadecimal digits");
  return value;
}

}  // namespace dartboard
