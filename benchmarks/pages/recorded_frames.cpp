#include "benchmarks/pages/recorded_frames.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <utility>
#include <variant>

#include "benchmarks/figures/run_diagrams.h"
#include "benchmarks/harness/json_number.h"
#include "core/forces/term_damping.h"
#include "core/meshes/text/base64.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;
using nlohmann::json;

struct Quantity {
  ColourBy by;
  const char* name;
};
constexpr Quantity quantities[]{
    {ColourBy::speed, "speed"}, {ColourBy::stress, "stress"}, {ColourBy::contact, "contact force"}};

static_assert(std::endian::native == std::endian::little, "the page reads columns of the processor's numbers");

template <class T>
std::string encoded(const std::vector<T>& column) {
  return encode_base64({reinterpret_cast<const char*>(column.data()), column.size() * sizeof(T)});
}

template <class To, class From>
std::vector<To> narrowed(const std::vector<From>& column) {
  std::vector<To> narrow;
  narrow.reserve(column.size());
  for (const From& value : column) narrow.push_back(static_cast<To>(value));
  return narrow;
}

/// Points, of which there are `points`, in two bytes each where that is enough.
std::string encoded_points(const std::vector<std::uint32_t>& column, std::size_t points) {
  return points <= 0x10000 ? encoded(narrowed<std::uint16_t>(column)) : encoded(column);
}

json numbers(const Vector3d& x) { return {x.x(), x.y(), x.z()}; }

json obstacle_of(const Obstacle& obstacle) {
  json out;
  if (const auto* plane = std::get_if<HalfSpace>(&obstacle.shape))
    out = {{"kind", "plane"}, {"point", numbers(plane->point)}, {"normal", numbers(plane->normal)}};
  else if (const auto* ball = std::get_if<Ball>(&obstacle.shape))
    out = {{"kind", "ball"}, {"centre", numbers(ball->centre)}, {"radius", ball->radius}};
  else if (const auto* block = std::get_if<Block>(&obstacle.shape))
    out = {{"kind", "block"}, {"low", numbers(block->low)}, {"high", numbers(block->high)}};
  return out;
}

json diagram_of(const RunDiagram& diagram) {
  json curves = json::array();
  for (const RunCurve& curve : diagram.curves) {
    json values = json::array();
    for (const double value : curve.values) values.push_back(number(value));
    curves.push_back({{"name", curve.name}, {"values", std::move(values)}, {"is_part", curve.is_part}});
  }
  return {{"title", diagram.title},
          {"unit", diagram.unit},
          {"note", diagram.note},
          {"times", diagram.times},
          {"curves", std::move(curves)}};
}

/// Six numbers each.
std::string arrows_of(const std::vector<PlayedFrame::Arrow>& arrows) {
  std::vector<float> numbers;
  for (const PlayedFrame::Arrow& arrow : arrows)
    for (const Vector3d& x : arrow)
      for (const double part : x) numbers.push_back(static_cast<float>(part));
  return encoded(numbers);
}

/// Bytes of a frame, and of a shape, before they are encoded.
std::size_t bytes_of(const PlayedFrame& frame) {
  std::size_t bytes = 2 * frame.places.size() + 24 * (frame.attachments.size() + frame.loads.size());
  for (const auto& values : frame.values) bytes += values.size();
  return bytes;
}
std::size_t bytes_of(const PlayedShape& shape) {
  const std::size_t index = shape.number.size() <= 0x10000 ? 2 : 4;
  return 5 * shape.number.size() + index * (shape.corners.size() + shape.links.size()) + 3 * shape.sides.size() +
         4 * shape.component.size();
}

/// At most so many arrows show where forces act.
constexpr std::size_t most_loads = 200;

/// [N] At each vertex: of forces that are shared by mass, of pressures that follow their faces, and of wind.
std::vector<Vector3d> loads_of(const SimulatedBody& body) {
  const VertexColumns& vertices = body.vertices();
  std::vector<Vector3d> loads(vertices.size(), Vector3d::Zero());
  for (std::size_t k = 0; k < vertices.pull.size(); ++k) loads[k] = vertices.mass[k] * vertices.pull[k];
  for (const ForceTerm* term : body.system().terms) {
    if (term->has_energy()) continue;
    term->add_forces({vertices.position}, loads);
    if (term->damping() != nullptr) term->damping()->add_forces({vertices.position}, vertices.velocity, loads);
  }
  return loads;
}

}  // namespace

RecordedFrames::RecordedFrames(const Simulation& simulation, std::vector<std::uint64_t> steps, const SceneFile& scene)
    : PicturesOfRun(std::move(steps)),
      scene_(scene),
      dimension_(simulation.dimension()),
      fields_{.held = true, .stress = true, .contact = scene.has_contact(), .attachments = true},
      facets_(simulation.frame(fields_)) {
  begin(picture_of(simulation));
}

PlayedFrame RecordedFrames::picture_of(const Simulation& simulation) {
  const Frame frame = simulation.frame(fields_);
  PlayedShape shape;
  constexpr std::uint32_t unseen = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> point(frame.mesh.points.size(), unseen), seen;
  const auto add_point = [&](std::uint32_t k) {
    if (point[k] == unseen) {
      point[k] = static_cast<std::uint32_t>(seen.size());
      seen.push_back(k);
    }
    return point[k];
  };
  const std::vector<std::uint32_t> lasting = components_.of(frame);
  const auto add_cell = [&](std::size_t c) {
    shape.material.push_back(frame.material.empty() ? 0 : frame.material[c]);
    shape.body.push_back(static_cast<std::uint8_t>(frame.body.empty() ? 0 : std::min(frame.body[c], 255u)));
    shape.component.push_back(lasting[frame.component[c]]);
  };
  for (const FrameFacet& facet : facets_.of(frame)) {
    for (const std::uint32_t k : facet.nodes) shape.corners.push_back(add_point(k));
    shape.sides.push_back(static_cast<std::uint8_t>(facet.nodes.size()));
    shape.dimension.push_back(static_cast<std::uint8_t>(dimension(frame.mesh.kinds[facet.cell])));
    shape.was_inside.push_back(facet.was_inside ? 1 : 0);
    add_cell(facet.cell);
  }
  for (std::size_t k = 0; k < frame.links.size(); ++k) {
    for (const std::uint32_t end : frame.links[k]) shape.links.push_back(add_point(end));
    add_cell(frame.mesh.cell_count() + k);
  }

  PlayedFrame played{.time = frame.time, .diagnostics = simulation.diagnostics(), .probes = simulation.probes()};
  for (const std::uint32_t k : seen) {
    shape.number.push_back(frame.mesh_point.empty() ? std::int64_t{k} : frame.mesh_point[k]);
    shape.held.push_back(frame.held[k]);
    for (const double x : frame.mesh.points[k]) played.places.push_back(x);
  }
  for (std::size_t q = 0; q < std::size(quantities); ++q) {
    const FrameValues values(quantities[q].by, frame);
    if (values.unit().empty() || (quantities[q].by == ColourBy::contact && !fields_.contact)) continue;
    units_[q] = values.unit();
    std::vector<double> sum(seen.size(), 0.0);
    std::vector<int> links(seen.size(), 0);
    // a chain's tensions are those of its links, and a point shows their mean
    if (quantities[q].by == ColourBy::stress && !frame.tension.empty()) {
      for (std::size_t k = 0; k < frame.links.size(); ++k)
        for (const std::uint32_t end : frame.links[k]) {
          sum[point[end]] += values.at_link(k);
          ++links[point[end]];
        }
      for (std::size_t k = 0; k < seen.size(); ++k) sum[k] /= std::max(1, links[k]);
    } else {
      for (std::size_t k = 0; k < seen.size(); ++k) sum[k] = values.at(std::span(&seen[k], 1), 3);
    }
    played.values[q] = narrowed<float>(sum);
  }
  played.attachments = frame.attachments;
  const std::vector<Vector3d> loads = loads_of(simulation.body());
  std::vector<std::size_t> pulled;
  for (std::size_t k = 0; k < loads.size(); ++k)
    if (!loads[k].isZero(0.0)) pulled.push_back(k);
  const std::size_t every = 1 + pulled.size() / (most_loads + 1);
  for (std::size_t k = 0; k < pulled.size(); k += every)
    played.loads.push_back({simulation.body().vertices().position[pulled[k]], loads[pulled[k]]});

  if (shapes_.empty() || shapes_.back() != shape) shapes_.push_back(std::move(shape));
  played.shape = shapes_.size() - 1;
  return played;
}

nlohmann::json RecordedFrames::diagrams() const {
  std::vector<Diagnostics> rows;
  std::vector<ProbeRow> probes;
  for (const PlayedFrame& frame : pictures()) {
    rows.push_back(frame.diagnostics);
    probes.push_back(frame.probes);
  }
  nlohmann::json all = nlohmann::json::array();
  for (const RunDiagram& diagram : diagrams_of(rows, probes, scene_, dimension_)) all.push_back(diagram_of(diagram));
  return all;
}

nlohmann::json RecordedFrames::json(std::size_t most_bytes) const {
  std::vector<const PlayedFrame*> frames;
  for (const PlayedFrame& frame : pictures()) frames.push_back(&frame);
  const auto bytes = [&] {
    std::size_t all = 0;
    std::set<std::size_t> used;
    for (const PlayedFrame* frame : frames) {
      all += bytes_of(*frame);
      if (used.insert(frame->shape).second) all += bytes_of(shapes_[frame->shape]);
    }
    return all;
  };
  while (frames.size() > 2 && bytes() > most_bytes) {  // the last stays
    std::vector<const PlayedFrame*> fewer;
    for (std::size_t k = 0; k + 1 < frames.size(); k += 2) fewer.push_back(frames[k]);
    fewer.push_back(frames.back());
    frames = std::move(fewer);
  }

  Eigen::AlignedBox3d box;
  double largest[3]{};
  for (const PlayedFrame* frame : frames) {
    for (std::size_t k = 0; k < frame->places.size(); k += 3)
      box.extend(Vector3d(frame->places[k], frame->places[k + 1], frame->places[k + 2]));
    for (std::size_t q = 0; q < std::size(quantities); ++q)
      for (const float value : frame->values[q])
        if (std::isfinite(value)) largest[q] = std::max(largest[q], double{value});
  }
  if (box.isEmpty()) box.extend(Vector3d(0, 0, 0));
  const Vector3d size = box.sizes().cwiseMax(std::numeric_limits<double>::min());

  nlohmann::json out{{"low", numbers(box.min())},
                     {"size", numbers(box.sizes())},
                     {"taken", pictures().size()},
                     {"quantities", nlohmann::json::array()},
                     {"shapes", nlohmann::json::array()},
                     {"frames", nlohmann::json::array()},
                     {"obstacles", nlohmann::json::array()},
                     {"curves", diagrams()}};
  for (std::size_t q = 0; q < std::size(quantities); ++q)
    if (!units_[q].empty())
      out["quantities"].push_back({{"name", quantities[q].name},
                                   {"unit", units_[q]},
                                   {"largest", largest[q]},
                                   {"dimension", quantities[q].by == ColourBy::stress ? dimension_ : 0}});
  for (const SceneObstacle& one : scene_.obstacles) out["obstacles"].push_back(obstacle_of(one.obstacle));
  std::size_t last = shapes_.size();
  for (const PlayedFrame* frame : frames) {
    if (frame->shape != last) {
      const PlayedShape& shape = shapes_[last = frame->shape];
      const std::size_t points = shape.number.size();
      out["shapes"].push_back({{"points", points},
                               {"number", encoded(narrowed<std::int32_t>(shape.number))},
                               {"held", encoded(shape.held)},
                               {"corners", encoded_points(shape.corners, points)},
                               {"sides", encoded(shape.sides)},
                               {"dimension", encoded(shape.dimension)},
                               {"was_inside", encoded(shape.was_inside)},
                               {"links", encoded_points(shape.links, points)},
                               {"material", encoded(shape.material)},
                               {"body", encoded(shape.body)},
                               {"component", encoded(narrowed<std::uint16_t>(shape.component))}});
    }
    std::vector<std::uint16_t> places;
    places.reserve(frame->places.size());
    for (std::size_t k = 0; k < frame->places.size(); ++k) {
      const auto axis = static_cast<Eigen::Index>(k % 3);
      places.push_back(
          static_cast<std::uint16_t>(std::lround(65535.0 * (frame->places[k] - box.min()[axis]) / size[axis])));
    }
    nlohmann::json moved = nlohmann::json::array(), values = nlohmann::json::object();
    for (const SceneObstacle& one : scene_.obstacles) moved.push_back(numbers(one.obstacle.moved_by(frame->time)));
    for (std::size_t q = 0; q < std::size(quantities); ++q) {
      if (frame->values[q].empty()) continue;
      std::vector<std::uint8_t> shares;  // 0: there is no value
      for (const float value : frame->values[q])
        shares.push_back(
            std::isfinite(value)
                ? static_cast<std::uint8_t>(1 + (largest[q] > 0.0 ? std::lround(254.0 * value / largest[q]) : 0))
                : std::uint8_t{0});
      values[quantities[q].name] = encoded(shares);
    }
    out["frames"].push_back({{"time", frame->time},
                             {"shape", out["shapes"].size() - 1},
                             {"places", encoded(places)},
                             {"values", std::move(values)},
                             {"moved", std::move(moved)},
                             {"attachments", arrows_of(frame->attachments)},
                             {"loads", arrows_of(frame->loads)}});
  }
  return out;
}

}  // namespace dartboard
