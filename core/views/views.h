#pragma once
// All views of a body at once; a scene holds only those that it needs.

#include "core/views/boundary_surface.h"
#include "core/views/component_labels.h"
#include "core/views/element_nodes_view.h"
#include "core/views/spring_ends.h"
#include "core/walks/cell_arrays.h"

namespace dartboard {

struct Views {
  CellArrays cells;
  SpringEndsView ends;
  TetrahedronNodesView tetrahedra;
  SolidNodesView solids;
  BoundarySurface boundary;
  ComponentLabels components;

  friend bool operator==(const Views&, const Views&) = default;

  /// Calls f(name, view) for each view.
  template <class Self, class F>
  static void for_each(Self& self, F&& f) {
    f("cell arrays", self.cells);
    f("spring ends", self.ends);
    f("corners of tetrahedra", self.tetrahedra);
    f("corners of solid cells", self.solids);
    f("boundary surface", self.boundary);
    f("component labels", self.components);
  }

  template <class Body>
  void rebuild(const Body& body) {
    for_each(*this, [&body](const char*, auto& view) { view.rebuild(body); });
  }
  /// Follow a change and what `adapt` reported of it; gives what `rebuild` would.
  template <class Body>
  ComponentChange apply(const Body& body, const TopologyChange& change, const ChangedEmbeddings& changed) {
    ComponentChange components_changed;
    for_each(*this, [&](const char*, auto& view) {
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(view)>, ComponentLabels>)
        components_changed = view.apply(body, change, changed);
      else
        view.apply(body, changed);
    });
    return components_changed;
  }
};

}  // namespace dartboard
