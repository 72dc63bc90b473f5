#include "benchmarks/figures/body_picture.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "benchmarks/figures/gnuplot.h"
#include "core/base/escape.h"

namespace dartboard {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::array component_colours{0x7ba7d9u, 0xe0b15au, 0x86bf7cu, 0xb18cc8u, 0x5fb8b3u, 0xd98ba5u, 0xa8a878u};
constexpr std::uint32_t inside_colour = 0xc8503c;
// The viewer stands to the right of -y, a little above; `up` is z as seen by the viewer.
const Vector3d toward_viewer = Vector3d(0.45, -0.8, 0.4).normalized();
const Vector3d rightward = Vector3d(0, 0, 1).cross(toward_viewer).normalized();
const Vector3d up = toward_viewer.cross(rightward);
const Vector3d toward_light = Vector3d(-0.3, -0.6, 0.74).normalized();

using Key = std::vector<std::uint32_t>;

Key sorted(Key nodes) {
  std::ranges::sort(nodes);
  return nodes;
}

struct Facet {
  Key nodes;  // in order around it
  std::size_t cell;
};

// The polygons of a surface; the faces of volumes that belong to one cell.
std::vector<Facet> facets_of(const Mesh& mesh) {
  std::vector<Facet> all;
  std::map<Key, int> cells_at;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    const auto nodes = mesh.cell(c);
    for (const std::vector<int>& face : faces_of(mesh.kinds[c])) {
      Facet facet{{}, c};
      for (const int k : face) facet.nodes.push_back(nodes[static_cast<std::size_t>(k)]);
      if (dimension(mesh.kinds[c]) == 3) ++cells_at[sorted(facet.nodes)];
      all.push_back(std::move(facet));
    }
  }
  std::erase_if(all, [&](const Facet& facet) {
    const auto found = cells_at.find(sorted(facet.nodes));
    return found != cells_at.end() && found->second > 1;
  });
  return all;
}

// The points of the mesh by which facets are compared: their own, or those of the face of the mesh that contains them.
class Origins {
 public:
  explicit Origins(const Frame& panel) : panel_(panel) {
    for (const RefinedFacet& facet : panel.refined_facets)
      lies_in_.try_emplace(sorted(Key(facet.points.begin(), facet.points.end())),
                           sorted(Key(facet.lies_in.begin(), facet.lies_in.end())));
  }
  // For a facet inside a cell of the mesh, the points include a vertex made by refinement.
  Key of(const Facet& facet) const {
    Key points;
    for (const std::uint32_t k : facet.nodes) points.push_back(static_cast<std::uint32_t>(panel_.mesh_point[k]));
    const auto found = lies_in_.find(sorted(facet.nodes));
    return found == lies_in_.end() ? sorted(std::move(points)) : found->second;
  }

 private:
  const Frame& panel_;
  std::map<Key, Key> lies_in_;
};

std::uint32_t shaded(std::uint32_t colour, double light) {
  std::uint32_t out = 0;
  for (const int shift : {16, 8, 0}) {
    const double channel = light * static_cast<double>((colour >> shift) & 0xff);
    out |= static_cast<std::uint32_t>(std::lround(std::min(255.0, channel))) << shift;
  }
  return out;
}

Vector2d seen(const Vector3d& x) { return {x.dot(rightward), x.dot(up)}; }

using Box = Eigen::AlignedBox2d;

// A polygon with its corners moved away from its middle; towards it where `by` is negative.
std::string moved_corners(const std::vector<Vector2d>& corners, const Vector2d& shift, double by,
                          std::uint32_t colour) {
  Vector2d middle(0, 0);
  for (const Vector2d& x : corners) middle += x / static_cast<double>(corners.size());
  std::string text;
  for (const Vector2d& x : corners) {
    const double far = (x - middle).norm();
    const Vector2d at = middle + (x - middle) * (far > -by && far > 0.0 ? 1.0 + by / far : 0.0) + shift;
    text += fmt::format("{:.6g} {:.6g} {}\n", at.x(), at.y(), colour);
  }
  return text + '\n';
}

// A line as a rectangle.
std::vector<Vector2d> widened(const std::vector<Vector2d>& line, double half_width) {
  const Vector2d along = line[1] - line[0];
  const double length = along.norm();
  const Vector2d aside =
      length > 0.0 ? Vector2d(-along.y(), along.x()) * (half_width / length) : Vector2d(0, half_width);
  return {line[0] + aside, line[1] + aside, line[1] - aside, line[0] - aside};
}

}  // namespace

Box seen_box(const Frame& panel) {
  Box box;
  for (const Vector3d& x : panel.mesh.points) box.extend(seen(x));
  return box;
}

PictureArea picture_area(std::span<const Box> boxes, double thinnest) {
  PictureArea area;
  Vector2d largest(0, 0);
  for (const Box& box : boxes) {
    if (box.isEmpty()) continue;
    area.all.extend(box);
    largest = largest.cwiseMax(box.sizes());
  }
  if (area.all.isEmpty()) area.all = Box(Vector2d(0, 0), Vector2d(1, 1));
  area.follows = (area.all.sizes().array() > 2.5 * largest.maxCoeff()).any();
  area.size = 1.08 * (area.follows ? largest : Vector2d(area.all.sizes()));
  area.size = area.size.cwiseMax(thinnest * area.size.maxCoeff());
  return area;
}

std::string polygons_of(std::span<const DrawnFacet> facets, const Vector2d& shift, double pixels) {
  std::string data;
  for (const DrawnFacet& facet : facets) {
    if (facet.corners.size() == 2) {
      data += moved_corners(widened(facet.corners, 2.0 / pixels), shift, 0.5 / pixels, shaded(facet.colour, 0.72));
      continue;
    }
    // the facet, in a darker colour and over the seams to its neighbours, then its inner part
    data += moved_corners(facet.corners, shift, 0.4 / pixels, shaded(facet.colour, 0.72));
    data += moved_corners(facet.corners, shift, -0.9 / pixels, facet.colour);
  }
  return data;
}

std::vector<Frame> upright(std::span<const Frame> panels, const Vector3d& up_now) {
  std::vector<Frame> turned(panels.begin(), panels.end());
  if (up_now.isZero(0.0) || up_now.normalized() == Vector3d::UnitZ()) return turned;
  const Eigen::Matrix3d turn = Eigen::Quaterniond::FromTwoVectors(up_now, Vector3d::UnitZ()).toRotationMatrix();
  for (Frame& panel : turned)
    for (Vector3d& x : panel.mesh.points) x = turn * x;
  return turned;
}

std::vector<DrawnFacet> drawn_facets(const Frame& panel, const Frame& first) {
  std::set<Key> skin;
  const Origins first_origins(first), origins(panel);
  for (const Facet& facet : facets_of(first.mesh)) skin.insert(first_origins.of(facet));
  std::vector<DrawnFacet> drawn;
  for (const Facet& facet : facets_of(panel.mesh)) {
    const auto& x = panel.mesh.points;
    DrawnFacet d;
    Vector3d middle(0, 0, 0), normal(0, 0, 0);
    for (std::size_t k = 0; k < facet.nodes.size(); ++k) {
      const Vector3d &here = x[facet.nodes[k]], &next = x[facet.nodes[(k + 1) % facet.nodes.size()]];
      d.corners.push_back(seen(here));
      middle += here / static_cast<double>(facet.nodes.size());
      normal += (here - x[facet.nodes[0]]).cross(next - x[facet.nodes[0]]);
    }
    // a face of a volume that looks away is hidden by the others
    if (dimension(panel.mesh.kinds[facet.cell]) == 3 && normal.dot(toward_viewer) <= 0.0) continue;
    d.depth = middle.dot(toward_viewer);
    const bool was_inside = !skin.contains(origins.of(facet));
    const std::uint32_t component = panel.component[facet.cell];
    const std::uint32_t colour = was_inside ? inside_colour : component_colours[component % component_colours.size()];
    // lit from the visible side
    const double side = normal.dot(toward_viewer) < 0.0 ? -1.0 : 1.0;
    const double cosine = normal.norm() > 0.0 ? side * normal.normalized().dot(toward_light) : 0.0;
    // in steps: an animated GIF has 256 colours, and takes the nearest of these, of whatever hue, for others
    constexpr double steps = 12.0;
    d.colour = shaded(colour, 0.62 + 0.45 * std::round(steps * std::max(0.0, cosine)) / steps);
    drawn.push_back(std::move(d));
  }
  for (std::size_t k = 0; k < panel.links.size(); ++k) {
    const auto [a, b] = panel.links[k];
    const Vector3d &from = panel.mesh.points[a], &to = panel.mesh.points[b];
    const std::uint32_t component = panel.component[panel.mesh.cell_count() + k];
    drawn.push_back({{seen(from), seen(to)},
                     ((from + to) / 2).dot(toward_viewer),
                     component_colours[component % component_colours.size()]});
  }
  std::ranges::stable_sort(drawn, {}, &DrawnFacet::depth);
  return drawn;
}

std::string draw_bodies(std::span<const Frame> panels, const std::string& title, const std::filesystem::path& folder,
                        const std::string& name, const std::string& gnuplot) {
  std::vector<Box> boxes;
  for (const Frame& panel : panels) boxes.push_back(seen_box(panel));
  const PictureArea area = picture_area(boxes, 0.1);
  const Vector2d& size = area.size;

  constexpr double widest = 1400, highest = 900, above_and_below = 80;  // [pixels]
  const double count = static_cast<double>(std::max<std::size_t>(1, panels.size()));
  constexpr double apart = 1.15, caption = 110;  // times the body's width; [pixels]
  const double pixels = std::min(widest / (count * apart * size.x()), (highest - above_and_below) / (1.1 * size.y()));
  const double pitch = std::max(apart * size.x(), caption / pixels);  // [m] from one time to the next
  const Vector2d whole(count * pitch, 1.1 * size.y());
  std::string data, labels;
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const Frame& panel = panels[k];
    const bool empty = panel.mesh.points.empty();
    const Vector2d centre = area.centre_of(boxes[k]);
    const double middle = static_cast<double>(k) * pitch;
    const Vector2d shift(middle - centre.x(), -centre.y());
    data += polygons_of(drawn_facets(panel, panels[0]), shift, pixels);
    labels +=
        fmt::format("set label {} {} at {:.6g},graph 0.02 center font \",13\"\n", k + 1,
                    gnuplot_string(fmt::format("t = {:.3g} s{}", panel.time, empty ? ", nothing left" : "")), middle);
    if (k > 0)
      labels += fmt::format("set arrow {0} from {1:.6g},graph 0 to {1:.6g},graph 1 nohead linecolor rgb \"#d8d8d8\"\n",
                            k, middle - pitch / 2);
  }
  write_plot_file(folder / (name + ".dat"), data);
  const int width = static_cast<int>(std::lround(std::max(560.0, pixels * whole.x())));
  const int height = static_cast<int>(std::lround(pixels * whole.y() + above_and_below));
  const std::string setup = fmt::format(
      "set encoding utf8\nunset key\nunset border\nunset tics\nset margins 0,0,0,3\nset size ratio -1\n"
      "set title {} font \",16\" noenhanced\n{}set xrange [{:.6g}:{:.6g}]\nset yrange [{:.6g}:{:.6g}]\n"
      "set style fill solid 1.0 noborder\n",
      quoted_title(title, width, 16.0, 1), labels, -0.5 * pitch, (count - 0.5) * pitch, -0.6 * size.y(),
      0.5 * size.y());
  const std::string commands = data.empty() ? "plot NaN"
                                            : fmt::format("plot {} using 1:2:3 with polygons fillcolor rgb variable",
                                                          plot_source(name + ".dat"));
  write_plot_file(folder / (name + ".gnuplot"), setup + for_both_pictures(commands, name, width, height));
  return run_gnuplot(gnuplot, folder, name);
}

}  // namespace dartboard
