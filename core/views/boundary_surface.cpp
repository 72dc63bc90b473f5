#include "core/views/boundary_surface.h"

#include <algorithm>

namespace dartboard {

void BoundarySurface::resize(std::size_t count) {
  for (std::size_t k = count; k < place_.size(); ++k) erase(static_cast<std::uint32_t>(k));
  place_.resize(count, no_place);
}

void BoundarySurface::set(const BoundaryFacet& facet) {
  std::uint32_t& place = place_[facet.number];
  if (place == no_place) {
    place = static_cast<std::uint32_t>(facets_.size());
    facets_.push_back(facet);
  } else {
    facets_[place] = facet;
  }
}

void BoundarySurface::erase(std::uint32_t number) {
  const std::uint32_t place = place_[number];
  if (place == no_place) return;
  facets_[place] = facets_.back();
  place_[facets_[place].number] = place;
  facets_.pop_back();
  place_[number] = no_place;
}

bool operator==(const BoundarySurface& a, const BoundarySurface& b) {
  return a.place_.size() == b.place_.size() && a.facets_.size() == b.facets_.size() &&
         std::all_of(a.facets_.begin(), a.facets_.end(), [&b](const BoundaryFacet& facet) {
           const std::uint32_t place = b.place_[facet.number];
           return place != BoundarySurface::no_place && b.facets_[place] == facet;
         });
}

}  // namespace dartboard
