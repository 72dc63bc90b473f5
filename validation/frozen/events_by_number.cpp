#include "validation/frozen/events_by_number.h"

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "core/scene/body/events/changing_body.h"
#include "core/scene/file/load_mesh.h"

namespace dartboard {
namespace {

using Json = nlohmann::ordered_json;

/// The names that events know the cells of a body by.
struct Names {
  std::function<Json(std::uint32_t dart)> facet;  // points of the mesh file: three of a face, or the ends of an edge
  std::function<Json(std::uint32_t dart)> cell;
};

/// pre  the body is as it was made: later its darts keep their facets and cells until these are removed or refined
template <class Map>
bool find_names(const SimulatedBody& of, const std::vector<std::uint32_t>& number_in_file, Names& names) {
  const auto* on = dynamic_cast<const ChangingBody<Map>*>(&of);
  if (on == nullptr) return false;
  const auto point = [on, &number_in_file](Dart d) {
    const auto& body = on->body();
    const std::uint32_t number = body.vertices.point[body.vertex(body.map, d)];
    return number_in_file.empty() ? number : number_in_file[number];
  };
  names.facet = [on, point](std::uint32_t index) {
    const Map& map = on->body().map;
    const Dart first{index}, second = map.template alpha<0>(first);
    Json points{point(first), point(second)};
    if constexpr (Map::dimension == 3) points.push_back(point(map.template alpha<1, 0>(second)));
    return points;
  };
  names.cell = [on](std::uint32_t index) -> Json {
    const auto& body = on->body();
    return on->mesh_cell()[body.cell(body.map, Dart{index})];
  };
  return true;
}

}  // namespace

std::optional<Json> events_by_number(const FrozenScene& scene, const Json& events) {
  if (has<Refine>(scene.file.events)) return {};
  const auto body = make_simulated_body(scene.problem, scene.needs);
  const std::vector<std::uint32_t> number_in_file = numbers_in_file(scene.file);
  Names names;
  if (!find_names<TetMap>(*body, number_in_file, names) && !find_names<Map3>(*body, number_in_file, names) &&
      !find_names<Map2>(*body, number_in_file, names))
    return {};
  Json named = Json::array();
  for (std::size_t k = 0; k < events.size(); ++k) {
    const std::string path = "/events/" + std::to_string(k);
    const auto frozen = std::ranges::find(scene.file.events, path, &SceneEvent::path);
    const bool takes_part = frozen != scene.file.events.end();
    if (!takes_part && !(events[k].value("at", 0.0) >= scene.file.duration)) return {};  // an accurate run has none
    if (!takes_part || !is_left_to_the_run(*frozen)) {
      named.push_back(events[k]);
      continue;
    }
    const auto number = static_cast<std::size_t>(frozen - scene.file.events.begin());
    for (const FrozenChange& change : scene.changes)
      for (const FrozenChange::Operation& operation : change.operations) {
        if (operation.event != number) continue;
        Json list = Json::array();
        for (const std::uint32_t dart : operation.targets)
          list.push_back(dissociates(frozen->action) ? names.facet(dart) : names.cell(dart));
        Json event{{"at", change.time}};
        if (dissociates(frozen->action))
          event["dissociate"] = {{"points", list}};
        else
          event["remove"] = {{"ids", list}};
        named.push_back(std::move(event));
      }
  }
  return named;
}

}  // namespace dartboard
