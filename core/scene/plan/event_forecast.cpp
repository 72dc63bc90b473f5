#include "core/scene/plan/event_forecast.h"

#include <algorithm>

#include "core/base/overloads.h"
#include "core/mechanics/fracture/seam.h"
#include "core/places/border.h"
#include "core/scene/file/scene_materials.h"
#include "core/scene/timeline/event_clock.h"

namespace dartboard {
namespace {

/// The number of cells in a selection at rest.
double selected(const CellSelection& selection, const Mesh& mesh) {
  return std::visit(
      [&mesh](const auto& s) -> double {
        if constexpr (requires { s.count; }) {
          return s.count;
        } else if constexpr (requires { s.tag; }) {
          return 0.0;
        } else if constexpr (requires { s.ids; }) {
          return static_cast<double>(s.ids.size());
        } else {
          return static_cast<double>(cells_in(s, centroids(mesh), border_thickness(mesh.points)).size());
        }
      },
      selection);
}

// A face lies about midway between the centroids of its two cells.
double facets_of(const Dissociate& cut, const Mesh& mesh, const MeshTally& counts) {
  if (const auto* faces = std::get_if<0>(&cut.faces)) return static_cast<double>(faces->size());
  const double thickness = border_thickness(mesh.points);
  double count = 0.0;
  for (const auto& [a, b] : counts.cells_of_facet) {
    const Eigen::Vector3d from = centroid(mesh, a), to = centroid(mesh, b);
    if (const auto* blade = std::get_if<BladeSweep>(&cut.faces)) {
      count += crosses_sweep(blade->path, blade->depth, from, to, thickness);
    } else {
      const auto& plane = std::get<PlaneSelection>(cut.faces);
      count += contains(plane, from, thickness) != contains(plane, to, thickness) &&
               (!cut.within || contains(*cut.within, (from + to) / 2.0, thickness));
    }
  }
  return count;
}

/// The number of steps at which an event is due: several times within one step are one.
std::uint64_t count_times(const SceneEvent& event, const SceneFile& scene) {
  const std::uint64_t end = step_of_time(scene.duration, scene.step);
  EventClock clock(event.from, event.until, event.every, scene.step);
  std::uint64_t count = 0, last = EventClock::never;
  for (; clock.next() <= end; clock.advance()) {
    if (clock.next() != last) ++count;
    last = clock.next();
  }
  return count;
}

/// Does a selection find cells each time? A region is empty after the first time.
bool repeats(const CellSelection& selection) { return std::holds_alternative<RandomSelection>(selection); }

}  // namespace

std::vector<EventForecast> forecast_events(const SceneFile& scene, const Mesh& mesh, const MeshTally& counts) {
  std::vector<EventForecast> forecasts;
  auto left = static_cast<double>(counts.cells);
  for (const SceneEvent& event : scene.events) {
    EventForecast f;
    // many times are counted, not enumerated
    constexpr double many = 1e5;
    const double every = event.every ? std::max(*event.every, scene.step) : scene.step;
    if (const double times = (event.until - event.from) / every; times > many)
      f.times = static_cast<std::uint64_t>(times * (1 + 0x1p-50)) + 1;
    else
      f.times = count_times(event, scene);
    const auto times = static_cast<double>(f.times);
    const auto of_cells = [&](const CellSelection& cells, double most) {
      const double each = std::min(selected(cells, mesh), most);
      f.operations = std::min(repeats(cells) ? times * each : each, most);
    };
    std::visit(
        Overloads{[&](const Dissociate& dissociate) { f.operations = facets_of(dissociate, mesh, counts); },
                  [&](const Remove& remove) {
                    of_cells(remove.cells, left);
                    left -= f.operations;
                  },
                  [&](const Tear&) { f.operations = times; }, [](const TearWhereStressed&) {},  // the motion decides
                  [&](const Refine& refine) { of_cells(refine.cells, static_cast<double>(counts.cells) * times); },
                  [&](const Release& release) {
                    f.operations = static_cast<double>(select_points(release.vertices, mesh.points, event.path).size());
                  }},
        event.action);
    forecasts.push_back(f);
  }
  return forecasts;
}

}  // namespace dartboard
