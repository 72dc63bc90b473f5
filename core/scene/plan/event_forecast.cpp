#include "core/scene/plan/event_forecast.h"

#include <algorithm>
#include <cmath>
#include <map>

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

std::uint64_t step_count(const SceneFile& scene) { return step_of_time(scene.duration, scene.step); }

/// f(step) for every time an event is due, until it returns false.
template <class F>
void for_each_time(const SceneEvent& event, const SceneFile& scene, F&& f) {
  EventClock clock(event.from, event.until, event.every, scene.step);
  std::uint64_t last = EventClock::never;
  for (; clock.next() <= step_count(scene); clock.advance()) {
    if (clock.next() != last && !f(clock.next())) return;  // several times within one step are one
    last = clock.next();
  }
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
      for_each_time(event, scene, [&f](std::uint64_t) { return ++f.times > 0; });
    const auto times = static_cast<double>(f.times);
    const auto of_cells = [&](const CellSelection& cells, double most) {
      const double each = std::min(selected(cells, mesh), most);
      f.operations = std::min(repeats(cells) ? times * each : each, most);
      f.with_operations = each > 0.0 ? std::min(times, std::ceil(f.operations / each)) : 0.0;
    };
    std::visit(
        Overloads{[&](const Dissociate& dissociate) {
                    f.operations = facets_of(dissociate, mesh, counts);
                    f.with_operations = f.operations > 0.0 ? std::min(times, 1.0) : 0.0;
                  },
                  [&](const Remove& remove) {
                    of_cells(remove.cells, left);
                    left -= f.operations;
                  },
                  [&](const Tear&) { f.operations = f.with_operations = times; },
                  [](const TearWhereStressed&) {},  // the motion decides
                  [&](const Refine& refine) { of_cells(refine.cells, static_cast<double>(counts.cells) * times); },
                  [&](const Release& release) {
                    f.operations = static_cast<double>(select_points(release.vertices, mesh.points, event.path).size());
                    f.with_operations = std::min(times, 1.0);
                  }},
        event.action);
    forecasts.push_back(f);
  }
  return forecasts;
}

MeanSizes mean_sizes(const SceneFile& scene, const Mesh& mesh, const MeshTally& counts) {
  std::map<std::uint64_t, double> removed;  // by step: cells
  for (const SceneEvent& event : scene.events)
    if (const auto* remove = std::get_if<Remove>(&event.action)) {
      const double each = selected(remove->cells, mesh);
      double sum = 0.0;
      for_each_time(event, scene, [&](std::uint64_t step) {
        removed[step] += each;
        sum += each;
        return repeats(remove->cells) && sum < static_cast<double>(counts.cells);
      });
    }
  MeanSizes mean;
  const auto steps = static_cast<double>(step_count(scene));
  if (removed.empty() || steps == 0.0 || counts.cells == 0) return mean;

  std::map<std::pair<std::uint32_t, bool>, double> edges;  // how many edges have (number of cells, on the boundary)
  for (std::size_t e = 0; e < counts.edges; ++e)
    edges[{counts.cells_of_edge[e], counts.edge_on_boundary[e] != 0}] += 1.0;
  const double around_vertex = static_cast<double>(mesh.nodes.size()) / static_cast<double>(counts.vertices);
  // with a share p of the cells left: runs of cells around an edge, parts of a vertex
  const auto springs_at = [&](double p) {
    double sum = 0.0;
    for (const auto& [kind, count] : edges) {
      const double n = kind.first;
      sum += count * (kind.second ? p + (n - 1.0) * p * (1.0 - p) : n * p * (1.0 - p) + std::pow(p, n));
    }
    return sum / static_cast<double>(counts.edges);
  };
  const auto vertices_at = [around_vertex](double p) {
    const double alone = std::pow(1.0 - p, 3.0);  // a cell without a neighbour at the vertex
    return around_vertex * p * alone + 1.0 - std::pow(1.0 - p * (1.0 - alone), around_vertex);
  };

  mean = {0.0, 0.0, 0.0};
  double left = 1.0, since = 0.0;
  const auto go_to = [&](double step) {
    const double share = (step - since) / steps;
    mean.springs += share * springs_at(left);
    mean.vertices += share * vertices_at(left);
    mean.cells += share * left;
    since = step;
  };
  for (const auto& [step, cells] : removed) {
    go_to(static_cast<double>(step));
    left = std::max(0.0, left - cells / static_cast<double>(counts.cells));
  }
  go_to(steps);
  return mean;
}

}  // namespace dartboard
