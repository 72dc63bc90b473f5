#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "core/base/bytes.h"
#include "core/base/overloads.h"
#include "core/places/border.h"
#include "core/scene/body/events/on_darts.h"
#include "core/scene/body/events/ready.h"

namespace dartboard {
namespace {

template <class Map>
class ReadyFaces : public Dissociation<Map> {
 public:
  ReadyFaces(ChangingBody<Map>& on, const std::vector<std::vector<std::uint32_t>>& faces, const std::string& path)
      : Dissociation<Map>(on) {
    constexpr std::size_t points = Map::dimension;
    for (std::size_t k = 0; k < faces.size(); ++k) {
      if (faces[k].size() != points)
        refuse_event(fmt::format("{}/{}", path, k), fmt::format("has {} points", faces[k].size()),
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
class ReadyPlane : public Dissociation<Map> {
 public:
  ReadyPlane(ChangingBody<Map>& on, const PlaneSelection& plane, const std::optional<CutRegion>& within)
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
  ReadyBlade(ChangingBody<Map>& on, const BladeSweep& blade) : Dissociation<Map>(on), blade_(blade) {}
  std::optional<std::size_t> facets() const override { return seam().size(); }
  std::size_t apply(EventTargets* taken) override { return this->take(seam(), taken); }
  std::size_t bytes() const override { return bytes_of(blade_.path); }

 private:
  std::vector<Dart> seam() const { return facets_on_sweep(on_.body(), blade_.path, blade_.depth); }

  using Dissociation<Map>::on_;
  BladeSweep blade_;
};

}  // namespace

template <class Map>
std::unique_ptr<ReadyEvent> ready(ChangingBody<Map>& on, const Dissociate& dissociate, const std::string& path) {
  using Ready = std::unique_ptr<ReadyEvent>;
  return std::visit(
      Overloads{[&](const FacetPoints& facets) -> Ready {
                  return std::make_unique<ReadyFaces<Map>>(on, facets, path + "/points");
                },
                [&](const PlaneSelection& plane) -> Ready {
                  return std::make_unique<ReadyPlane<Map>>(on, plane, dissociate.within);
                },
                [&](const BladeSweep& blade) -> Ready { return std::make_unique<ReadyBlade<Map>>(on, blade); }},
      dissociate.faces);
}

template std::unique_ptr<ReadyEvent> ready(ChangingBody<Map2>&, const Dissociate&, const std::string&);
template std::unique_ptr<ReadyEvent> ready(ChangingBody<Map3>&, const Dissociate&, const std::string&);
template std::unique_ptr<ReadyEvent> ready(ChangingBody<TetMap>&, const Dissociate&, const std::string&);

}  // namespace dartboard
