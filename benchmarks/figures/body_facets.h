#pragma once
// The visible facets of bodies, and their colours.

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/figures/body_panel.h"
#include "benchmarks/figures/frame_facets.h"
#include "core/scene/body/frame.h"

namespace dartboard {

/// The facets of one run.
///
/// Of solids the boundary that looks towards the viewer, of surfaces every polygon, of chains the links as lines; each
/// component in its own colour, and facets that were inside a body in another, or all by a quantity. Held and driven
/// vertices of these are dots, attachments are lines.
class BodyFacets {
 public:
  BodyFacets(const Look& look, const Frame& first);

  /// The fields of frames that pictures show.
  static FrameFields fields(const Look& look) {
    return {.held = true,
            .stress = look.colour == ColourBy::stress,
            .contact = look.colour == ColourBy::contact,
            .attachments = true};
  }
  /// pre  frames come in the order of their times, the first one included
  BodyPanel of(const Frame& frame);

 private:
  PictureView view_;
  ColourBy colour_;
  FrameFacets facets_;
  LastingComponents components_;
};

/// The colours that have a meaning, with it.
std::vector<std::pair<std::uint32_t, std::string>> legend_of(const Look& look);
/// The colour of a share of the largest value.
std::uint32_t shade_of(double share);

/// Put facets into the order in which they are drawn: what is behind comes before what hides it, and otherwise the
/// farthest is first. Of facets that hide each other in a circle one is drawn too early. A side of an obstacle that
/// hides a tenth of the bodies' facets becomes an outline.
/// cost  O(n log n + pairs of facets whose boxes overlap in the picture)
void order_by_depth(std::vector<DrawnFacet>& facets);

/// The sides of obstacles at a time that look towards the viewer, without what is far from the bodies: planes and
/// larger obstacles end at `reach`, smaller ones are drawn whole if they come into it. A plane with its back to the
/// viewer is an outline.
std::vector<DrawnFacet> facets_of_obstacles(const Look& look, double time, const Eigen::AlignedBox3d& reach);

}  // namespace dartboard
