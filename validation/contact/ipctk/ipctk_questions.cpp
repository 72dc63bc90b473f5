#include "validation/contact/ipctk/ipctk_questions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/plain/error.h"

namespace dartboard {
namespace {

using nlohmann::json;

json numbers_of(const IpctkPlace& place) {
  json x = json::array(), samples = json::array();
  for (const Eigen::Vector3d& p : place.x) x.push_back(json::array({p[0], p[1], p[2]}));
  for (const IpctkSample& s : place.samples) samples.push_back({{"nodes", s.nodes}, {"body", s.body}});
  return {{"x", std::move(x)}, {"samples", std::move(samples)}};
}

[[noreturn]] void refuse(std::string_view found, std::string_view expected) {
  throw IoError(fmt::format("ipctk: its answers: {}; expected {}", found, expected));
}

/// The array under a key, of that size.
const json& rows_of(const json& value, const char* key, std::size_t size) {
  const auto at = value.is_object() ? value.find(key) : value.end();
  if (at == value.end() || !at->is_array()) refuse(fmt::format("no \"{}\"", key), fmt::format("{} in a list", size));
  if (at->size() != size) refuse(fmt::format("\"{}\" has {}", key, at->size()), fmt::format("{}", size));
  return *at;
}

std::vector<bool> verdicts_of(const json& answer, const char* key, std::size_t size) {
  std::vector<bool> verdicts;
  for (const json& one : rows_of(answer, key, size)) {
    if (!one.is_boolean()) refuse(fmt::format("\"{}\" has {}", key, one.dump()), "true or false");
    verdicts.push_back(one.get<bool>());
  }
  return verdicts;
}

std::vector<double> squares_of(const json& row, std::size_t size) {
  if (!row.is_array() || row.size() != size)
    refuse(fmt::format("squares of a place: {}", row.dump()), fmt::format("{} of them", size));
  std::vector<double> squares;
  for (const json& one : row) {
    const double square = one.is_number() ? one.get<double>() : NAN;
    if (!(square >= 0.0) || std::isinf(square))
      refuse(fmt::format("the square of a distance: {}", one.dump()), "a number >= 0");
    squares.push_back(square);
  }
  return squares;
}

}  // namespace

IpctkSurfaces::IpctkSurfaces(const BodyContact& contact) : contact_(contact), number_(contact.solids().node_count()) {
  for (std::uint32_t k = 0; k < number_.size(); ++k) {
    if (!contact.solids().is_on_boundary(k)) continue;
    number_[k] = static_cast<std::uint32_t>(vertices_.size());
    vertices_.push_back(k);
  }
}

IpctkQuestion IpctkSurfaces::question(bool in_motion) const {
  IpctkQuestion question{.triangles = {}, .bodies = {}, .in_motion = in_motion, .places = {}};
  for (const SkinTriangle& t : contact_.solids().triangles()) {
    question.triangles.push_back({number_[t.nodes[0]], number_[t.nodes[1]], number_[t.nodes[2]]});
    question.bodies.push_back(contact_.solids().group_at(t.nodes[0]));
  }
  return question;
}

IpctkPlace IpctkSurfaces::at(std::span<const Eigen::Vector3d> x) const {
  IpctkPlace place;
  for (const std::uint32_t k : vertices_) place.x.push_back(x[k]);
  for (const BodyTouch& touch : contact_.touching({x})) {
    IpctkSample sample{
        .nodes = {}, .body = contact_.solids().tetrahedra()[touch.tetrahedron].group, .depth = touch.depth};
    for (const std::uint32_t k : contact_.samples()[touch.sample].corners()) sample.nodes.push_back(number_[k]);
    place.samples.push_back(std::move(sample));
  }
  place.felt = !place.samples.empty() || !contact_.out_of_reach().empty();
  return place;
}

std::string text_of(std::span<const IpctkQuestion> questions) {
  json all = json::array();
  for (const IpctkQuestion& question : questions) {
    json places = json::array();
    for (const IpctkPlace& place : question.places) places.push_back(numbers_of(place));
    all.push_back({{"triangles", question.triangles},
                   {"bodies", question.bodies},
                   {"in_motion", question.in_motion},
                   {"places", std::move(places)}});
  }
  json asked = json::object();
  asked["questions"] = std::move(all);
  return asked.dump();
}

std::vector<IpctkAnswer> answers_of(std::string_view text, std::span<const IpctkQuestion> questions) {
  const json value = json::parse(text, nullptr, false);
  if (value.is_discarded()) refuse(fmt::format("{} characters", text.size()), "JSON");
  const json& all = rows_of(value, "answers", questions.size());
  std::vector<IpctkAnswer> answers;
  for (std::size_t q = 0; q < questions.size(); ++q) {
    const std::vector<IpctkPlace>& places = questions[q].places;
    IpctkAnswer answer{.crossing = verdicts_of(all[q], "crossing", places.size()), .squares = {}, .free = {}};
    const json& rows = rows_of(all[q], "squares", places.size());
    for (std::size_t k = 0; k < places.size(); ++k)
      answer.squares.push_back(squares_of(rows[k], places[k].samples.size()));
    const std::size_t steps = questions[q].in_motion && !places.empty() ? places.size() - 1 : 0;
    answer.free = verdicts_of(all[q], "free", steps);
    answers.push_back(std::move(answer));
  }
  return answers;
}

}  // namespace dartboard
