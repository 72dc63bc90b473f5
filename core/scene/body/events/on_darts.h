#pragma once
// What events that operate on the cells of some darts have in common.

#include <fmt/format.h>

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/mechanics/fracture/seam.h"
#include "core/operations/dissociate_all.h"
#include "core/plain/error.h"
#include "core/scene/body/events/changing_body.h"
#include "core/scene/body/events/ready_event.h"
#include "core/scene/file/selections/selection.h"

namespace dartboard {

[[noreturn]] inline void refuse_event(const std::string& path, std::string_view found, std::string_view expected) {
  throw InputError(fmt::format("{}: {}; expected {}", path, found, expected));
}

/// An event that operates on the cells of some darts.
template <class Map>
class OnDarts : public ReadyEvent {
 public:
  explicit OnDarts(ChangingBody<Map>& on) : on_(on) {}
  std::size_t repeat(const EventTargets& taken) final {
    std::vector<Dart> darts;
    for (const std::uint32_t index : taken) darts.push_back(Dart{index});
    return operate(darts);
  }

 protected:
  virtual std::size_t operate(std::span<const Dart> darts) = 0;
  /// Operates on the darts and adds them to `taken`, unless that is null.
  std::size_t take(std::span<const Dart> darts, EventTargets* taken) {
    add(darts, taken);
    return operate(darts);
  }
  static void add(std::span<const Dart> darts, EventTargets* taken) {
    if (taken != nullptr)
      for (const Dart d : darts) taken->push_back(d.index);
  }

  ChangingBody<Map>& on_;
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

/// The facets between cells on different sides of a plane.
template <class Map>
std::vector<Dart> seam_on(const ChangingBody<Map>& on, const PlaneSelection& plane) {
  if constexpr (Map::dimension == 3)
    return faces_on_plane(on.body(), plane.point, plane.normal);
  else
    return edges_on_plane(on.body(), plane.point, plane.normal);
}

}  // namespace dartboard
