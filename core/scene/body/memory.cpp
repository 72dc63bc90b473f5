#include "core/scene/body/memory.h"

#include "core/base/bytes.h"
#include "core/mechanics/vertex_columns.h"
#include "core/scene/file/force_kind.h"

namespace dartboard {

std::string_view name(Part part) {
  switch (part) {
    case Part::map: return "map";
    case Part::marks: return "marks";
    case Part::embeddings: return "embeddings";
    case Part::cell_darts: return "darts of cells";
    case Part::cells: return "cells";
    case Part::components: return "components";
    case Part::vertices: return "vertices";
    case Part::viscosity: return "viscosity";
    case Part::fixed: return "fixed vertices";
    case Part::rest: return "places at rest";
    case Part::pull: return "forces";
    case Part::driven: return "driven vertices";
    case Part::springs: return "springs";
    case Part::elements: return "elements";
    case Part::cell_damping: return "damping of elements";
    case Part::damping: return "damping";
    case Part::cell_springs: return "springs within cells";
    case Part::force: return "force";
    case Part::contact: return "contact";
    case Part::gravity: return "gravity";
    case Part::integrator: return "integrator";
    case Part::solver: return "matrices and factor";
    case Part::detector: return "divergence detector";
    case Part::speed_check: return "speed check";
    case Part::event: return "event";
    case Part::step_check: return "stable step";
    case Part::output_cells: return "cells for output";
    case Part::frames: return "frames";
    case Part::probes: return "probes";
    case Part::diagnostics: return "diagnostics";
    case Part::sleeping: return "sleeping";
  }
  return "?";
}

std::string_view name_of(Part part, std::size_t which) {
  return part == Part::force ? force_kinds()[which].name : name(part);
}

std::size_t bytes_of_vertices(const VertexColumns& vertices) {
  std::size_t bytes = 0;
  for_each_column(vertices, VertexColumns::embedded(),
                  [&bytes](const auto& column, const auto&) { bytes += bytes_of(column); });
  return bytes - bytes_of(vertices.viscosity, vertices.fixed, vertices.held_axes, vertices.rest, vertices.pull);
}

}  // namespace dartboard
