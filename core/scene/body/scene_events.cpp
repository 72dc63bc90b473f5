#include "core/scene/body/scene_events.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <unordered_set>
#include <utility>

#include "core/mechanics/fracture/seam.h"
#include "core/mechanics/fracture/tearing.h"
#include "core/operations/dissociate_all.h"
#include "core/operations/remove_face.h"
#include "core/operations/remove_volume.h"
#include "core/operations/tear_fan.h"
#include "core/places/border.h"
#include "core/plain/bytes.h"
#include "core/plain/error.h"
#include "core/scene/body/body_on_map.h"
#include "core/scene/body/release.h"

namespace dartboard {
namespace {

[[noreturn]] void fail(const std::string& path, std::string_view found, std::string_view expected) {
  throw InputError(fmt::format("{}: {}; expected {}", path, found, expected));
}

/// An event that operates on the cells of some darts.
template <class Map>
class OnDarts : public ReadyEvent {
 public:
  explicit OnDarts(BodyOnMap<Map>& on) : on_(on) {}
  std::size_t repeat(const EventTargets& taken) final {
    std::vector<Dart> darts;
    for (const std::uint32_t index : taken) darts.push_back(Dart{index});
    return operate(darts);
  }

 protected:
  virtual std::size_t operate(std::span<const Dart> darts) = 0;
  /// The same, and they are added to `taken` unless that is null.
  std::size_t take(std::span<const Dart> darts, EventTargets* taken) {
    add(darts, taken);
    return operate(darts);
  }
  static void add(std::span<const Dart> darts, EventTargets* taken) {
    if (taken != nullptr)
      for (const Dart d : darts) taken->push_back(d.index);
  }

  BodyOnMap<Map>& on_;
};

/// An event that takes facets apart, and nothing else.
template <class Map>
class Dissociation : public OnDarts<Map> {
 public:
  using OnDarts<Map>::OnDarts;

 protected:
  using OnDarts<Map>::on_;
  std::size_t operate(std::span<const Dart> seam) override {
    const TopologyChange change = dissociate_all(on_.body().map, seam);
    if (change.empty()) return 0;
    on_.follow(change);
    return Map::dimension == 3 ? change.faces.size() : change.edges.size();
  }
};

// ---- dissociate

template <class Map>
class ReadyFaces : public Dissociation<Map> {
 public:
  ReadyFaces(BodyOnMap<Map>& on, const std::vector<std::vector<std::uint32_t>>& faces, const std::string& path)
      : Dissociation<Map>(on) {
    constexpr std::size_t points = Map::dimension;
    for (std::size_t k = 0; k < faces.size(); ++k) {
      if (faces[k].size() != points)
        fail(fmt::format("{}/{}", path, k), fmt::format("has {} points", faces[k].size()),
             Map::dimension == 3 ? "three points of a face" : "the two ends of an edge");
      std::array<std::uint32_t, points> one{};
      std::copy(faces[k].begin(), faces[k].end(), one.begin());
      try {
        for (const Dart d : find(one)) found_.push_back(on.body().map.id(d));
      } catch (const InputError& error) {
        throw InputError(fmt::format("{}/{}: {}", path, k, error.what()));
      }
    }
  }
  std::optional<std::size_t> facets() const override { return found_.size(); }
  std::size_t apply(EventTargets* taken) override {
    const Map& map = on_.body().map;
    std::vector<Dart> live;  // a face of a removed cell is on the boundary already: nothing to separate
    for (const DartId id : found_)
      if (map.is_live(id.dart) && map.id(id.dart) == id) live.push_back(id.dart);
    return this->take(live, taken);
  }
  std::size_t bytes() const override { return bytes_of(found_); }

 private:
  std::vector<Dart> find(const std::array<std::uint32_t, Map::dimension>& points) const {
    if constexpr (Map::dimension == 3)
      return faces_of_points(on_.body(), std::span(&points, 1));
    else
      return edges_of_points(on_.body(), std::span(&points, 1));
  }

  using Dissociation<Map>::on_;
  std::vector<DartId> found_;
};

template <class Map>
std::vector<Dart> seam_on(const BodyOnMap<Map>& on, const PlaneSelection& plane) {
  if constexpr (Map::dimension == 3)
    return faces_on_plane(on.body(), plane.point, plane.normal);
  else
    return edges_on_plane(on.body(), plane.point, plane.normal);
}

template <class Map>
class ReadyPlane : public Dissociation<Map> {
 public:
  ReadyPlane(BodyOnMap<Map>& on, const PlaneSelection& plane, const std::optional<CutRegion>& within)
      : Dissociation<Map>(on), plane_(plane), within_(within) {}
  std::optional<std::size_t> facets() const override { return seam().size(); }
  std::size_t apply(EventTargets* taken) override { return this->take(seam(), taken); }

 private:
  std::vector<Dart> seam() const {
    std::vector<Dart> all = seam_on(on_, plane_);
    if (within_) {
      const double thickness = border_thickness(on_.body().vertices.position);
      std::erase_if(all, [&](Dart d) { return !contains(*within_, facet_centre(on_.body(), d), thickness); });
    }
    return all;
  }

  using Dissociation<Map>::on_;
  PlaneSelection plane_;
  std::optional<CutRegion> within_;
};

template <class Map>
class ReadyBlade : public Dissociation<Map> {
 public:
  ReadyBlade(BodyOnMap<Map>& on, const BladeSweep& blade) : Dissociation<Map>(on), blade_(blade) {}
  std::optional<std::size_t> facets() const override { return seam().size(); }
  std::size_t apply(EventTargets* taken) override { return this->take(seam(), taken); }
  std::size_t bytes() const override { return bytes_of(blade_.path); }

 private:
  std::vector<Dart> seam() const { return facets_on_sweep(on_.body(), blade_.path, blade_.depth); }

  using Dissociation<Map>::on_;
  BladeSweep blade_;
};

// ---- remove

/// The mean of the positions of the vertices of cell k [m].
template <class Map>
Eigen::Vector3d centroid(const MassSpringBody<Map, Held::by_every_dart>& body, std::uint32_t k) {
  Eigen::Vector3d sum(0, 0, 0);
  double count = 0.0;
  for (const Vertex v : incident_cells<0>(body.map, Cell<Map::dimension>{body.cell_dart[k]})) {
    sum += body.vertices.position[body.vertex(body.map, v.dart)];
    count += 1.0;
  }
  return sum / count;
}

/// Finds the cells of a selection, by their present numbers, at each call.
template <class Map>
class CellChooser {
 public:
  CellChooser(const BodyOnMap<Map>& on, const CellSelection& selection, const std::string& path)
      : on_(on), selection_(selection) {
    if (std::holds_alternative<TagSelection>(selection))
      fail(path + "/tag", "has not been looked up", "cells of a scene whose mesh was loaded (load_mesh)");
    if (const auto* random = std::get_if<RandomSelection>(&selection)) random_.emplace(random->seed);
    if (const auto* by_id = std::get_if<IdSelection>(&selection)) {
      for (std::size_t k = 0; k < by_id->ids.size(); ++k)
        if (by_id->ids[k] >= on.mesh_cell().size())
          fail(fmt::format("{}/ids/{}", path, k), fmt::format("is {}", by_id->ids[k]),
               fmt::format("a cell of the mesh, less than {}", on.mesh_cell().size()));
      ids_.insert(by_id->ids.begin(), by_id->ids.end());
    }
  }

  /// The numbers of the cells, ascending.
  std::vector<std::uint32_t> choose() {
    const auto count = static_cast<std::uint32_t>(on_.body().cell_dart.size());
    if (random_) return draw(count, std::get<RandomSelection>(selection_).count);
    std::vector<std::uint32_t> cells;
    if (ids_.empty()) {
      std::vector<Eigen::Vector3d> centroids(count);
      for (std::uint32_t k = 0; k < count; ++k) centroids[k] = centroid(on_.body(), k);
      return cells_in(selection_, centroids, border_thickness(on_.body().vertices.position));
    }
    for (std::uint32_t k = 0; k < count; ++k)
      if (ids_.contains(on_.mesh_cell()[k])) cells.push_back(k);
    return cells;
  }

  void state(Archive& archive) {
    if (random_) archive(*random_);
  }
  std::size_t bytes() const {
    const auto* by_id = std::get_if<IdSelection>(&selection_);
    return by_id == nullptr ? 0 : bytes_of(by_id->ids) + ids_.size() * sizeof(std::uint32_t);
  }

 private:
  /// The first places of a shuffle of 0 .. count - 1 (Fisher and Yates).
  std::vector<std::uint32_t> draw(std::uint32_t count, std::uint32_t wanted) {
    std::vector<std::uint32_t> numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0u);
    const std::uint32_t size = std::min(count, wanted);
    for (std::uint32_t k = 0; k < size; ++k) std::swap(numbers[k], numbers[k + random_->below(count - k)]);
    numbers.resize(size);
    std::sort(numbers.begin(), numbers.end());
    return numbers;
  }

  const BodyOnMap<Map>& on_;
  CellSelection selection_;
  std::unordered_set<std::uint32_t> ids_;  // of the mesh; empty for a selection by place
  std::optional<SplitMix64> random_;
};

template <class Map>
class ReadyRemoval : public OnDarts<Map> {
 public:
  ReadyRemoval(BodyOnMap<Map>& on, const CellSelection& selection, const std::string& path)
      : OnDarts<Map>(on), chooser_(on, selection, path) {}

  std::size_t apply(EventTargets* taken) override {
    // darts and not numbers: these change when the body follows
    std::vector<Dart> darts;
    for (const std::uint32_t k : chooser_.choose()) darts.push_back(on_.body().cell_dart[k]);
    return this->take(darts, taken);
  }
  void state(Archive& archive) override { chooser_.state(archive); }
  std::size_t bytes() const override { return chooser_.bytes(); }

 private:
  std::size_t operate(std::span<const Dart> darts) override {
    if (darts.empty()) return 0;
    auto& body = on_.body();
    double mass = 0.0;
    for (const Dart d : darts) mass += body.cell_mass[body.cell(body.map, d)];
    TopologyChange change;
    for (const Dart d : darts) {
      if constexpr (Map::dimension == 3)
        change.append(remove_volume(body.map, d));
      else
        change.append(remove_face(body.map, d));
    }
    on_.follow(change);
    on_.count_removed(mass);
    return darts.size();
  }

  using OnDarts<Map>::on_;
  CellChooser<Map> chooser_;
};

// ---- refine; of the tetrahedra of a solid

template <class Map>
bool is_tetrahedron(const Map& map, Dart d) {
  if constexpr (Map::tetrahedral) return true;
  std::size_t darts = 0;
  for_each_dart_of(map, Volume{d}, [&darts](Dart) { ++darts; });
  return darts == 24;  // other cells of a solid have 32 and more
}

template <class Map>
bool has_tetrahedra(const BodyOnMap<Map>& on) {
  const auto& body = on.body();
  return std::ranges::any_of(body.cell_dart, [&](Dart d) { return is_tetrahedron(body.map, d); });
}

template <class Map>
class ReadyRefinement : public OnDarts<Map> {
 public:
  ReadyRefinement(BodyOnMap<Map>& on, const Refine& refine, const std::string& path)
      : OnDarts<Map>(on), refine_(refine), path_(path), chooser_(on, refine.cells, path + "/cells") {}

  std::size_t apply(EventTargets* taken) override {
    const auto& body = on_.body();
    std::vector<Dart> darts;
    for (const std::uint32_t k : chooser_.choose())
      if (is_tetrahedron(body.map, body.cell_dart[k])) darts.push_back(body.cell_dart[k]);
    return this->take(darts, taken);
  }
  void state(Archive& archive) override { chooser_.state(archive); }
  std::size_t bytes() const override { return chooser_.bytes(); }

 private:
  std::size_t operate(std::span<const Dart> darts) override {
    auto& body = on_.body();
    std::vector<DartId> chosen;
    for (const Dart d : darts) chosen.push_back(body.map.id(d));
    std::size_t count = 0;
    for (const DartId id : chosen) {
      if (!body.map.is_live(id.dart) || body.map.id(id.dart) != id) continue;  // subdivided with a neighbour
      const Subdivision subdivision =
          refine_.at_centre ? subdivide(body.map, Volume{id.dart}) : subdivide(body.map, own_edge(id.dart));
      on_.follow(subdivision, refine_.bracing);
      ++count;
    }
    return count;
  }

  /// The longest edge at rest; among equal ones, that with the lowest number.
  Edge longest_edge(Dart cell) const {
    const auto& body = on_.body();
    Edge best{cell};
    for (const Edge e : incident_cells<1>(body.map, Volume{cell})) {
      const std::uint32_t k = body.edge(body.map, e.dart), longest = body.edge(body.map, best.dart);
      const double excess = body.springs[k].rest_length - body.springs[longest].rest_length;
      if (excess > 0.0 || (excess == 0.0 && k < longest)) best = e;
    }
    return best;
  }

  /// The longest edge, which only tetrahedra may share.
  /// throws  InputError if a cell of another kind has it, too
  Edge own_edge(Dart cell) const {
    const auto& body = on_.body();
    const Edge longest = longest_edge(cell);
    for (const Volume v : incident_cells<3>(body.map, longest))
      if (!is_tetrahedron(body.map, v.dart))
        fail(path_ + "/at",
             fmt::format("is \"longest edge\", and that of cell {} belongs to a cell that is no tetrahedron, too",
                         on_.mesh_cell()[body.cell(body.map, cell)]),
             "\"centre\", or cells whose longest edge tetrahedra alone have");
    return longest;
  }

  using OnDarts<Map>::on_;
  Refine refine_;
  std::string path_;
  CellChooser<Map> chooser_;
};

// ---- tear; of solids only

template <class Map>
class ReadyTear : public Dissociation<Map> {
 public:
  ReadyTear(BodyOnMap<Map>& on, const Tear& tear, const std::string& path) : Dissociation<Map>(on), tear_(tear) {
    const auto* point = std::get_if<std::uint32_t>(&tear.vertex);
    if (point != nullptr && *point >= on.body().vertices.size())  // one vertex for each point at the start
      fail(path + "/vertex", fmt::format("is {}", *point),
           fmt::format("a point of the mesh, less than {}", on.body().vertices.size()));
  }

  std::size_t apply(EventTargets* taken) override {
    const auto& body = on_.body();
    const auto vertex = chosen();
    if (!vertex) return 0;
    const Dart start = starting_face(body, *vertex, tear_.direction);
    if (start == no_dart) return 0;  // a vertex of a single cell
    return this->take(fan(body.map, start), taken);
  }

 private:
  // The lowest of several: parts of one point, or vertices at the same distance.
  std::optional<std::uint32_t> chosen() const {
    const VertexColumns& v = on_.body().vertices;
    std::optional<std::uint32_t> best;
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t k = 0; k < v.size(); ++k) {
      double far = 0.0;
      if (const auto* point = std::get_if<std::uint32_t>(&tear_.vertex)) {
        if (v.point[k] != *point) continue;
      } else {
        far = (v.position[k] - std::get<Eigen::Vector3d>(tear_.vertex)).squaredNorm();
      }
      if (far < least) {
        best = k;
        least = far;
      }
    }
    return best;
  }

  using Dissociation<Map>::on_;
  Tear tear_;
};

template <class Map>
class ReadyStress : public Dissociation<Map> {
 public:
  ReadyStress(BodyOnMap<Map>& on, const TearWhereStressed& tear, const std::string& path)
      : Dissociation<Map>(on), rule_{tear.threshold} {
    if (tear.most_per_step) rule_.most_per_step = *tear.most_per_step;
    if (!tear.seam) return;
    const std::vector<Dart> faces = seam_on(on, *tear.seam);
    if (faces.empty()) fail(path + "/plane", "has no two cells on different sides", "a seam through the body at rest");
    filter_ = [&map = on.body().map, seam = FaceSet(on.body().map, faces)](Dart d) { return seam.contains(map, d); };
  }
  std::size_t apply(EventTargets* taken) override {
    const auto follow = [this, taken](const TopologyChange& change) {
      for (const DissociatedCell& face : change.faces) this->add(std::span(&face.kept, 1), taken);
      on_.follow(change);
    };
    return tear_where_stressed(on_.body(), on_.ends(), rule_, filter_, follow, stress_, on_.system().terms,
                               on_.corners())
        .faces;
  }
  // a seam takes a bit for each face slot of a cell
  std::size_t bytes() const override {
    return bytes_of(stress_) + (filter_ ? (on_.body().map.template slot_count<2>() + 7) / 8 : 0);
  }

 private:
  using Dissociation<Map>::on_;
  TearRule rule_;
  FaceFilter filter_;
  std::vector<Eigen::Matrix3d> stress_;
};

}  // namespace

template <class Map>
std::unique_ptr<ReadyEvent> make_event_ready(BodyOnMap<Map>& on, const SceneEvent& event) {
  if (const auto* dissociate = std::get_if<Dissociate>(&event.action)) {
    if (const auto* plane = std::get_if<PlaneSelection>(&dissociate->faces))
      return std::make_unique<ReadyPlane<Map>>(on, *plane, dissociate->within);
    if (const auto* blade = std::get_if<BladeSweep>(&dissociate->faces))
      return std::make_unique<ReadyBlade<Map>>(on, *blade);
    return std::make_unique<ReadyFaces<Map>>(on, std::get<0>(dissociate->faces), event.path + "/dissociate/points");
  }
  if (const auto* release = std::get_if<Release>(&event.action))
    return std::make_unique<ReadyRelease>(on.body().vertices, *release, event.path + "/release");
  if (const auto* remove = std::get_if<Remove>(&event.action))
    return std::make_unique<ReadyRemoval<Map>>(on, remove->cells, event.path + "/remove");
  if (const auto* refine = std::get_if<Refine>(&event.action)) {
    if constexpr (Map::dimension == 3)
      if (has_tetrahedra(on)) return std::make_unique<ReadyRefinement<Map>>(on, *refine, event.path + "/refine");
    fail(event.path + "/refine", "subdivides tetrahedra, and the body has other cells", "a solid that has tetrahedra");
  }
  if constexpr (Map::dimension == 3) {
    if (const auto* tear = std::get_if<Tear>(&event.action))
      return std::make_unique<ReadyTear<Map>>(on, *tear, event.path + "/tear");
    return std::make_unique<ReadyStress<Map>>(on, std::get<TearWhereStressed>(event.action),
                                              event.path + "/tear_where_stressed");
  } else {
    const bool by_stress = std::holds_alternative<TearWhereStressed>(event.action);
    fail(event.path + (by_stress ? "/tear_where_stressed" : "/tear"), "tears fans of faces, and the body is a surface",
         "'dissociate' or 'remove'");
  }
}

template std::unique_ptr<ReadyEvent> make_event_ready(BodyOnMap<Map2>&, const SceneEvent&);
template std::unique_ptr<ReadyEvent> make_event_ready(BodyOnMap<Map3>&, const SceneEvent&);
template std::unique_ptr<ReadyEvent> make_event_ready(BodyOnMap<TetMap>&, const SceneEvent&);

}  // namespace dartboard
