#pragma once
// One map, several carriers: all questions on a map, answered by all of them, with the answers in one table.

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/plain/mesh.h"
#include "core/topology/generalized_map.h"
#include "validation/cgal/cgal_twin.h"

namespace dartboard {

/// The operations of a map of ours, replaceable so that a test can put a faulty one in their place. Darts are the map's
/// own here. An empty function means core's.
template <class Map>
struct MapOperations {
  std::function<void(Map&, int i, Dart, Dart)> sew;
  std::function<void(Map&, int i, Dart)> unsew;
  std::function<SplitCounts(Map&, Dart)> dissociate;
};

/// Our map of a mesh as a twin, built by build_map; its darts get the names of alphas_of(mesh).
/// throws  InputError if the map cannot hold the mesh
template <class Map>
std::unique_ptr<MapTwin> make_core_twin(const Mesh& mesh, MapOperations<Map> operations = {});

extern template std::unique_ptr<MapTwin> make_core_twin(const Mesh&, MapOperations<Map2>);
extern template std::unique_ptr<MapTwin> make_core_twin(const Mesh&, MapOperations<Map3>);
extern template std::unique_ptr<MapTwin> make_core_twin(const Mesh&, MapOperations<TetMap>);

/// One question and the answer of each twin, in words; empty where a twin has no answer ("-" when printed).
struct AgreementRow {
  std::string what;
  std::vector<std::string> answers;  // one per twin
  bool agrees = true;
};

/// Every question, in this order: darts; i-cells and components by the carrier's own counting; names and alphas; the
/// partition into orbits for every subset of {alpha_0 .. alpha_n}; orientability; boundary; Euler characteristic of
/// each component, by smallest dart; validity. All answers are compared with the first twin's.
///
/// cost    O(2^(n+1) darts) per twin
std::vector<AgreementRow> compare_twins(std::span<const MapTwin* const> twins);

/// CGAL's verdict on whether each of its twins is isomorphic to the map it makes of these alphas; twins before `first`
/// are not CGAL's and have no answer.
AgreementRow compare_isomorphism(std::span<const MapTwin* const> twins, std::size_t first, const AlphaList& alphas);

/// The comparison of a mesh at rest: ours (Map2 or Map3, and TetMap where it can) against CGAL's maps of the mesh,
/// which are built without core; and CGAL's verdict on whether its maps are isomorphic to those it makes of our alphas.
struct TopologyComparison {
  std::vector<std::string> carriers;  // titles of the answers
  std::vector<AgreementRow> rows;
  std::string no_cmap;  // the reason why there is no combinatorial map; empty if there is one
  bool agrees() const;
};
TopologyComparison compare_topology(const Mesh& mesh);

}  // namespace dartboard
