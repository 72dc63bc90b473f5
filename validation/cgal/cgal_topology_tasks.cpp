#include "validation/cgal/cgal_topology_tasks.h"

#include <CGAL/Cell_attribute.h>
#include <CGAL/Generalized_map.h>
#include <malloc.h>

#include <algorithm>
#include <array>
#include <memory>
#include <tuple>
#include <utility>

#include "core/plain/error.h"
#include "validation/cgal/cgal_twin.h"

namespace dartboard {
namespace {

struct Bare {
  template <class Map>
  struct Dart_wrapper {
    using Attributes = std::tuple<>;
  };
};

std::uint64_t splits = 0;  // functors are types to CGAL, so the count cannot live in one
struct CountSplit {
  template <class Attribute>
  void operator()(Attribute&, Attribute&) const {
    ++splits;
  }
};

struct Numbered {
  template <class Map>
  struct Dart_wrapper {
    using Number = CGAL::Cell_attribute<Map, std::uint32_t, CGAL::Tag_true, CGAL::Null_functor, CountSplit>;
    using Attributes = std::tuple<Number, Number>;
  };
};

using BareMap = CGAL::Generalized_map<3, Bare>;
using NumberedMap = CGAL::Generalized_map<3, Numbered>;

/// The darts of the mesh's map by number, linked as the mesh says. Faces are found again by their points: a chain per
/// smallest point, no sorting and no hashing, as in our own build.
template <class Map>
std::vector<typename Map::Dart_handle> build(Map& map, const Mesh& mesh) {
  struct Met {
    std::array<std::uint32_t, 3> points;  // ascending
    std::size_t first;                    // of its six darts
    std::size_t next;
  };
  constexpr auto none = static_cast<std::size_t>(-1);
  const CellShape& shape = shape_of(CellKind::tetrahedron);
  std::vector<std::size_t> chain(mesh.points.size(), none);
  std::vector<Met> met;
  std::vector<typename Map::Dart_handle> darts;
  met.reserve(4 * mesh.cell_count());
  darts.reserve(24 * mesh.cell_count());

  const auto point = [&](std::size_t d) { return mesh.cell(d / 24)[shape.node[d % 24]]; };
  const auto sew_faces = [&](std::size_t a, std::size_t b) {  // darts 2k and 2k + 1 of a face are the ends of an edge
    for (std::size_t x = a; x < a + 6; ++x)
      for (std::size_t y = b; y < b + 6; ++y)
        if (point(x) == point(y) && point(x ^ 1u) == point(y ^ 1u))
          map.template basic_link_alpha<3>(darts[x], darts[y]);
  };
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    if (mesh.kinds[c] != CellKind::tetrahedron) throw InputError("this work is for tetrahedra");
    for (std::size_t p = 0; p < 24; ++p) darts.push_back(map.create_dart());
    for (std::size_t p = 0; p < 24; ++p) {
      const auto link = [&]<unsigned i>(std::integral_constant<unsigned, i>) {
        const std::size_t q = shape.alpha[p][i];
        if (p < q) map.template basic_link_alpha<i>(darts[24 * c + p], darts[24 * c + q]);
      };
      link(std::integral_constant<unsigned, 0>{});
      link(std::integral_constant<unsigned, 1>{});
      link(std::integral_constant<unsigned, 2>{});
    }
    for (std::size_t first = 24 * c; first < 24 * (c + 1); first += 6) {
      std::array points{point(first), point(first + 2), point(first + 4)};
      std::sort(points.begin(), points.end());
      std::size_t k = chain[points[0]];
      while (k != none && met[k].points != points) k = met[k].next;
      if (k != none) {
        sew_faces(met[k].first, first);
      } else {
        met.push_back({points, first, chain[points[0]]});
        chain[points[0]] = met.size() - 1;
      }
    }
  }
  return darts;
}

template <unsigned i>
void number_cells(NumberedMap& map) {
  std::uint32_t number = 0;
  for (auto d = map.darts().begin(), end = map.darts().end(); d != end; ++d)
    if (map.attribute<i>(d) == nullptr) map.set_attribute<i>(d, map.create_attribute<i>(number++));
}
template <unsigned i>
void number_cells(BareMap&) {}

template <class Range>
std::uint64_t length(Range&& range) {
  std::uint64_t n = 0;
  for (auto it = range.begin(), end = range.end(); it != end; ++it) ++n;
  return n;
}

/// A map that is only read.
template <class MapType>
struct Subject {
  using Map = MapType;
  using Handle = typename Map::Dart_handle;
  Map map;
  std::vector<Handle> darts;

  explicit Subject(const Mesh& mesh) : darts(build(map, mesh)) {
    number_cells<0>(map);
    number_cells<1>(map);
  }
};

/// A map whose faces are unsewn and sewn again.
struct UnsewnSubject : Subject<NumberedMap> {
  using Subject::Subject;
  std::vector<std::pair<Handle, Handle>> unsewn;

  std::uint64_t unsew(const std::vector<Dart>& faces) {
    splits = 0;
    for (const Dart d : faces) {
      const Handle a = darts[d.index];
      if (map.is_free<3>(a)) continue;
      unsewn.emplace_back(a, map.alpha<3>(a));
      map.unsew<3>(a);
    }
    return splits;
  }
  void restore() {
    for (; !unsewn.empty(); unsewn.pop_back()) map.sew<3>(unsewn.back().first, unsewn.back().second);
    for (const Handle d : darts)
      if (map.alpha<3>(d) == nullptr || map.attribute<0>(d) == nullptr || map.attribute<1>(d) == nullptr)
        throw InputError("CGAL lost a link or an attribute");
  }
};

template <class Subject>
std::vector<TopologyTask> reading_tasks(const std::shared_ptr<Subject>& subject, const TopologyWork& work) {
  using Map = typename Subject::Map;
  std::vector<TopologyTask> tasks;
  const auto reads_only = [&](const char* figure, std::function<std::uint64_t()> run) {
    tasks.push_back({figure, run, [run] { run(); }});
  };
  reads_only("vertex-orbit", [subject, &work] {
    std::uint64_t n = 0;
    for (const Dart v : work.vertices) n += length(subject->map.template darts_of_cell<0>(subject->darts[v.index]));
    return n;
  });
  reads_only("vertex-to-tetrahedra", [subject, &work] {
    std::uint64_t n = 0;
    for (const Dart v : work.vertices)
      n += length(subject->map.template one_dart_per_incident_cell<3, 0>(subject->darts[v.index]));
    return n;
  });
  reads_only("full-check", [subject] { return std::uint64_t{subject->map.is_valid()}; });
  reads_only("count-cells", [subject] {
    const auto n = subject->map.count_cells({0, 1, 2, 3});
    return std::uint64_t{n[0]} + n[1] + n[2] + n[3];
  });
  const auto built = std::make_shared<std::unique_ptr<Map>>();
  const auto build_anew = [built, &work] {
    *built = std::make_unique<Map>();
    build(**built, work.mesh);
    number_cells<0>(**built);
    return std::uint64_t{(*built)->number_of_darts()};
  };
  tasks.push_back({"build", build_anew, [built] { built->reset(); }});
  return tasks;
}

std::size_t heap_in_use() {
  const auto info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

}  // namespace

std::vector<TopologyTask> cgal_topology_tasks(const TopologyWork& work) {
  const auto subject = std::make_shared<UnsewnSubject>(work.mesh);
  std::vector<TopologyTask> tasks = reading_tasks(subject, work);
  const auto restore = [subject] { subject->restore(); };
  tasks.push_back({"unsew-cut", [subject, &work] { return subject->unsew(work.cut); }, restore});
  tasks.push_back({"unsew-scattered", [subject, &work] { return subject->unsew(work.scattered); }, restore});
  return tasks;
}

std::vector<TopologyTask> cgal_bare_topology_tasks(const TopologyWork& work) {
  return reading_tasks(std::make_shared<Subject<BareMap>>(work.mesh), work);
}

std::size_t cgal_map_bytes(const Mesh& mesh) {
  const std::size_t before = heap_in_use();
  NumberedMap map;
  build(map, mesh);
  number_cells<0>(map);
  number_cells<1>(map);
  return heap_in_use() - before;
}

}  // namespace dartboard
