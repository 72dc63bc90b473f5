#include "core/contact/obstacle_contact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/bytes.h"
#include "core/base/disjoint_sets.h"
#include "core/forces/compensated_sum.h"
#include "core/plain/error.h"

namespace dartboard {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Vector3d mean_of(const SkinSample& sample, std::span<const Vector3d> of) {
  return mean_of(sample, [of](std::uint32_t i) -> const Vector3d& { return of[i]; });
}

/// Add an equal share of the force to each node.
void share_force(const SkinSample& sample, const Vector3d& f, std::span<Vector3d> force) {
  if (sample.count == 1) {
    force[sample.nodes[0]] += f;
    return;
  }
  const Vector3d share = f / static_cast<double>(sample.count);
  for (const std::uint32_t i : sample.corners()) force[i] += share;
}

/// The origin that places in a shape are taken from: its coordinates are rounded too.
const Vector3d& origin_of(const ObstacleShape& shape) {
  if (const auto* plane = std::get_if<HalfSpace>(&shape)) return plane->point;
  if (const auto* ball = std::get_if<Ball>(&shape)) return ball->centre;
  return std::get<Block>(shape).high;
}

/// The rounding of a mean of places, and of its distance from an obstacle, over the sizes of coordinates.
constexpr double slack = 1e-12;
/// The calls of `is_clear` that are not answered after one that could not say yes.
constexpr int passed_calls = 15;

/// [m] The largest coordinate of a box.
double size_of(const BoxAround& box) { return box.low.cwiseAbs().cwiseMax(box.high.cwiseAbs()).maxCoeff(); }

/// Is the whole box outside of the shape, by more than `by` and the rounding of the shape?
bool is_outside(const ObstacleShape& shape, const BoxAround& box, double by) {
  if (const auto* plane = std::get_if<HalfSpace>(&shape)) {
    const Vector3d deepest = (plane->normal.array() > 0.0).select(box.low, box.high);
    return (deepest - plane->point).dot(plane->normal) > by + slack * plane->point.cwiseAbs().maxCoeff();
  }
  const auto* ball = std::get_if<Ball>(&shape);
  const auto* block = std::get_if<Block>(&shape);
  const Vector3d low = ball != nullptr ? ball->centre : block->low, high = ball != nullptr ? ball->centre : block->high;
  by += slack * (low.cwiseAbs().maxCoeff() + high.cwiseAbs().maxCoeff());
  const Vector3d beyond = (low - box.high).cwiseMax(box.low - high).cwiseMax(0.0);
  return ball != nullptr ? beyond.norm() > (1.0 + slack) * ball->radius + by : beyond.maxCoeff() > by;
}

/// Is the corner in the half-space, or on its plane to rounding?
bool is_in(const HalfSpace& plane, const Vector3d& corner) {
  const double size = std::max(corner.cwiseAbs().maxCoeff(), plane.point.cwiseAbs().maxCoeff());
  return (plane.point - corner).dot(plane.normal) >= -JoinedBoxes::tolerance * size;
}

Vector3d corner_of(const Block& block, int k) {
  return {(k & 1 ? block.high : block.low)[0], (k & 2 ? block.high : block.low)[1],
          (k & 4 ? block.high : block.low)[2]};
}

/// Moves the faces of `spanned` to infinity that are faces of the block with all corners in the half-space. False if
/// all of the block is in it. Other faces go no further into the half-space than these: it ends somewhere in the block.
bool reach_into(const HalfSpace& plane, const Block& block, Block& spanned) {
  std::array<bool, 8> in{};
  for (int k = 0; k < 8; ++k) in[static_cast<std::size_t>(k)] = is_in(plane, corner_of(block, k));
  if (std::ranges::all_of(in, [](bool corner) { return corner; })) return false;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    bool low = true, high = true;
    for (std::size_t k = 0; k < 8; ++k) ((k >> axis & 1) != 0 ? high : low) &= in[k];
    if (low) spanned.low[axis] = -infinity;
    if (high) spanned.high[axis] = infinity;
  }
  return true;
}

EnergyChange& operator+=(EnergyChange& sum, const EnergyChange& change) {
  sum.value += change.value;
  sum.sizes += change.sizes;
  return sum;
}

bool is_same(const JoinedBlocks& a, const JoinedBlocks& b) {
  return a.obstacle == b.obstacle && std::ranges::equal(a.boxes.boxes(), b.boxes.boxes());
}

bool is_same(const ObstacleShape& a, const ObstacleShape& b) {
  const auto *block = std::get_if<Block>(&a), *other = std::get_if<Block>(&b);
  return block == nullptr || (block->low == other->low && block->high == other->high);
}

}  // namespace

ObstacleContact::ObstacleContact(std::vector<ContactLaw> laws, std::vector<Obstacle> obstacles,
                                 const std::vector<SkinSample>& samples)
    : laws_(std::move(laws)),
      obstacles_(std::move(obstacles)),
      samples_(samples),
      moved_(obstacles_.size(), Vector3d(0, 0, 0)) {
  if (laws_.size() != obstacles_.size()) throw InputError("every obstacle needs one law of contact");
  for (const Obstacle& obstacle : obstacles_) obstacle.require_valid();
  for (const ContactLaw& law : laws_) {
    law.require_valid();
    friction_ = friction_ || law.friction > 0.0;
    damping_ = damping_ || law.restitution < 1.0;
  }
  std::size_t blocks = 0, planes = 0;
  for (const Obstacle& obstacle : obstacles_) {
    if (std::holds_alternative<Block>(obstacle.shape)) ++blocks;
    if (std::holds_alternative<HalfSpace>(obstacle.shape)) ++planes;
  }
  may_cover_ = blocks > 0 && blocks + planes > 1;
  now_ = arranged(moved_);
}

ObstacleContact::Arrangement ObstacleContact::arranged(std::span<const Vector3d> moved) const {
  Arrangement found{.moved = {moved.begin(), moved.end()},
                    .shape = {},
                    .joined_in = std::vector<std::uint32_t>(obstacles_.size(), Arrangement::alone),
                    .joined = {}};
  for (const Obstacle& obstacle : obstacles_) found.shape.push_back(obstacle.shape);
  if (!may_cover_) return found;
  std::vector<std::uint32_t> blocks;  // with a face that is not in a half-space
  for (std::uint32_t o = 0; o < obstacles_.size(); ++o) {
    const auto* block = std::get_if<Block>(&obstacles_[o].shape);
    if (block == nullptr) continue;
    bool shown = true;
    for (std::uint32_t p = 0; p < obstacles_.size() && shown; ++p)
      if (const auto* plane = std::get_if<HalfSpace>(&obstacles_[p].shape))
        shown =
            reach_into({plane->point + (moved[p] - moved[o]), plane->normal}, *block, std::get<Block>(found.shape[o]));
    const Block& spanned = std::get<Block>(found.shape[o]);
    if (shown && (spanned.low.array().isFinite().any() || spanned.high.array().isFinite().any()))
      blocks.push_back(o);
    else
      found.joined_in[o] = Arrangement::hidden;
  }
  const auto seen_from = [&](std::uint32_t o, std::uint32_t from) {
    const Block& block = std::get<Block>(found.shape[o]);
    const Vector3d way = moved[o] - moved[from];
    return SpannedBox{block.low + way, block.high + way};
  };
  DisjointSets sets(blocks.size());
  for (std::uint32_t a = 0; a < blocks.size(); ++a)
    for (std::uint32_t b = a + 1; b < blocks.size(); ++b)
      if (::dartboard::are_joined(seen_from(blocks[a], blocks[a]), seen_from(blocks[b], blocks[a]))) sets.join(a, b);
  for (std::uint32_t first = 0; first < blocks.size(); ++first) {
    JoinedBlocks joined;
    std::vector<SpannedBox> boxes;
    for (std::uint32_t k = first; k < blocks.size(); ++k) {
      if (sets.set_of(k) != first) continue;
      joined.obstacle.push_back(blocks[k]);
      joined.law.push_back(laws_[blocks[k]]);
      boxes.push_back(seen_from(blocks[k], blocks[first]));
    }
    if (boxes.size() < 2) continue;
    joined.boxes = JoinedBoxes(std::move(boxes));
    for (const std::uint32_t o : joined.obstacle) found.joined_in[o] = static_cast<std::uint32_t>(found.joined.size());
    found.joined.push_back(std::move(joined));
  }
  return found;
}

template <class F>
bool ObstacleContact::differs(const F& moved) const {
  if (!may_cover_) return false;
  std::size_t first = obstacles_.size();
  for (std::size_t o = 0; o < obstacles_.size(); ++o) {
    if (std::holds_alternative<Ball>(obstacles_[o].shape)) continue;
    if (first == obstacles_.size()) first = o;
    if (moved(o) - moved(first) != now_.moved[o] - now_.moved[first]) return true;
  }
  return false;
}

void ObstacleContact::arrange() {
  if (differs([this](std::size_t o) { return moved_[o]; })) now_ = arranged(moved_);
}

bool ObstacleContact::place_at(double time) {
  bool any = false;
  for (std::size_t o = 0; o < obstacles_.size(); ++o) {
    const Vector3d there = obstacles_[o].moved_by(time);
    any = any || there != moved_[o];
    moved_[o] = there;
  }
  if (any) arrange();
  return any;
}

bool ObstacleContact::is_away(std::uint32_t o, const BoxAround& box, double by) const {
  return is_outside(obstacles_[o].shape, {box.low - moved_[o], box.high - moved_[o]}, by);
}

EnergyChange ObstacleContact::work_of_placing(double time, std::span<const Vector3d> x) const {
  CompensatedSum sum;
  double sizes = 0.0;
  const auto add_all = [&](const auto& change_of) {
    for (const SkinSample& s : samples_) {
      const EnergyChange change = change_of(s.area, mean_of(s, x));
      sum.add(change.value);
      sizes += change.sizes;
    }
  };
  const auto there = [&](std::size_t o) { return obstacles_[o].moved_by(time); };
  std::optional<Arrangement> other;
  if (differs(there)) {
    std::vector<Vector3d> moved;
    for (std::size_t o = 0; o < obstacles_.size(); ++o) moved.push_back(there(o));
    other = arranged(moved);
  }
  const Arrangement& next = other ? *other : now_;
  // where what covers an obstacle changes, what it had is taken away, and what it has is added
  const auto add_energies_alone = [&](const Arrangement& in, std::size_t o, const Vector3d& at, double sign) {
    if (in.joined_in[o] != Arrangement::alone) return;
    add_all([&](double area, const Vector3d& y) {
      if (!is_inside(in.shape[o], y - at)) return EnergyChange{};
      const double energy = laws_[o].energy(area, penetration(in.shape[o], y - at).depth);
      return EnergyChange{sign * energy, energy};
    });
  };
  const auto add_energies = [&](const JoinedBlocks& joined, const Vector3d& at, double sign) {
    add_all([&](double area, const Vector3d& y) {
      Penetration in;
      std::size_t box = 0;
      if (!find_way_out(joined, y - at, in, box)) return EnergyChange{};
      const double energy = joined.law[box].energy(area, in.depth);
      return EnergyChange{sign * energy, energy};
    });
  };
  for (std::size_t o = 0; o < obstacles_.size(); ++o) {
    const bool stays = now_.joined_in[o] == Arrangement::alone && next.joined_in[o] == Arrangement::alone &&
                       is_same(now_.shape[o], next.shape[o]);
    if (!stays) {
      add_energies_alone(now_, o, moved_[o], -1.0);
      add_energies_alone(next, o, there(o), 1.0);
      continue;
    }
    // an obstacle that moves one way has the effect of a body that moves the other way
    const Vector3d way = moved_[o] - there(o);
    if (way.isZero(0.0)) continue;
    add_all([&](double area, const Vector3d& y) {
      return change_on_way(laws_[o], area, now_.shape[o], y - moved_[o], way);
    });
  }
  for (const JoinedBlocks& joined : now_.joined) {
    const std::uint32_t o = joined.obstacle[0];
    if (std::ranges::none_of(next.joined, [&](const JoinedBlocks& later) { return is_same(joined, later); })) {
      add_energies(joined, moved_[o], -1.0);
      continue;
    }
    const Vector3d way = moved_[o] - there(o);
    if (way.isZero(0.0)) continue;
    add_all([&](double area, const Vector3d& y) { return change_on_way(joined, area, y - moved_[o], way); });
  }
  for (const JoinedBlocks& joined : next.joined)
    if (std::ranges::none_of(now_.joined, [&](const JoinedBlocks& earlier) { return is_same(joined, earlier); }))
      add_energies(joined, there(joined.obstacle[0]), 1.0);
  return {sum.value(), sizes};
}

Vector3d ObstacleContact::place_of(const SkinSample& sample, const StagePlaces& at) {
  Vector3d place = mean_of(sample, at.x);
  if (at.w.empty()) return place;
  return place + at.t * mean_of(sample, at.w);
}

bool ObstacleContact::find_alone(std::uint32_t o, const Vector3d& y, Penetration& found) const {
  const Vector3d place = y - moved_[o];
  if (!is_inside(now_.shape[o], place)) return false;
  found = penetration(now_.shape[o], place);
  return found.depth > 0.0;
}

void ObstacleContact::find_joined(std::uint32_t j, const Vector3d& y, Penetration& found,
                                  std::uint32_t& obstacle) const {
  const JoinedBlocks& joined = now_.joined[j];
  std::size_t box = 0;
  if (find_way_out(joined, y - moved_[joined.obstacle[0]], found, box)) obstacle = joined.obstacle[box];
}

Penetration ObstacleContact::penetration_in(std::uint32_t o, const Vector3d& y) const {
  const std::uint32_t j = now_.joined_in[o];
  if (j == Arrangement::hidden) return {};
  Penetration found;
  std::uint32_t with = Arrangement::alone;
  if (j != Arrangement::alone) find_joined(j, y, found, with);
  return with != Arrangement::alone ? found : penetration(now_.shape[o], y - moved_[o]);
}

bool ObstacleContact::find_penetration(std::uint32_t o, const Vector3d& y, Penetration& found) const {
  const std::uint32_t j = now_.joined_in[o];
  if (j == Arrangement::alone) return find_alone(o, y, found);
  if (j == Arrangement::hidden) return false;
  Penetration joint;
  std::uint32_t with = Arrangement::alone;
  find_joined(j, y, joint, with);
  if (with != o) return false;
  found = joint;
  return true;
}

bool ObstacleContact::passes_call() const {
  if (calls_to_pass_ == 0) return false;
  --calls_to_pass_;
  return true;
}

/// Is the box outside of all obstacles? `size` is that of the coordinates behind it.
bool ObstacleContact::is_clear(const BoxAround& box, double size) const {
  for (std::size_t o = 0; o < obstacles_.size(); ++o) {
    const double by = slack * (size + moved_[o].cwiseAbs().maxCoeff());
    if (is_outside(obstacles_[o].shape, {box.low - moved_[o], box.high - moved_[o]}, by)) continue;
    calls_to_pass_ = passed_calls;
    return false;
  }
  return true;
}

std::optional<BoxAround> ObstacleContact::clear_box(std::span<const Vector3d> x) const {
  if (passes_call()) return {};
  const BoxAround box = box_around(x);
  return is_clear(box, size_of(box)) ? std::optional(box) : std::nullopt;
}

bool ObstacleContact::is_clear_after(const BoxAround& box, std::span<const Vector3d> v, double t) const {
  if (passes_call()) return false;
  const BoxAround speeds = box_around(v);
  const Vector3d one = t * speeds.low, other = t * speeds.high;
  return is_clear({box.low + one.cwiseMin(other), box.high + one.cwiseMax(other)},
                  size_of(box) + size_of({one, other}));
}

bool ObstacleContact::is_clear(std::span<const Vector3d> x, std::span<const Vector3d> v, double t) const {
  if (x.empty()) return true;
  if (v.empty()) return clear_box(x).has_value();
  return is_clear_after(box_around(x), v, t);
}

template <class F>
void ObstacleContact::for_each_contact(const Vector3d& y, F&& f) const {
  for_each_penetration(y, [&](std::uint32_t o, const Penetration& found) { f(laws_[o], found, o); });
}

double ObstacleContact::frequency_squared(std::span<const double> inverse_mass, double share_of_depth) const {
  std::vector<double> row(inverse_mass.size(), 0.0);
  for (const SkinSample& s : samples_)
    for (const std::uint32_t i : s.corners())
      row[i] += inverse_mass[i] * largest_stiffness(s.area, share_of_depth) / static_cast<double>(s.count);
  return row.empty() ? 0.0 : *std::ranges::max_element(row);
}

double ObstacleContact::largest_stiffness(double area, double share_of_depth) const {
  double largest = 0.0;
  for (const ContactLaw& law : laws_) largest = std::max(largest, law.stiffness(area, share_of_depth * law.depth));
  return largest;
}

void ObstacleContact::add_forces(const StagePlaces& at, std::span<Vector3d> force) const {
  if (frozen_.rows.empty() && is_clear(at.x, at.w, at.t)) return;
  for (const SkinSample& s : samples_)
    for_each_contact(place_of(s, at), [&](const ContactLaw& law, const Penetration& in, std::uint32_t) {
      share_force(s, law.force(s.area, in.depth) * in.normal, force);
    });
  frozen_.add_forces(force);
}

void ObstacleContact::add_discrete_forces(const StagePlaces& at, std::span<Vector3d> force) const {
  for (const SkinSample& s : samples_) {
    const Vector3d from = mean_of(s, at.x), way = (2.0 * at.t) * mean_of(s, at.w);
    for (std::uint32_t o = 0; o < obstacles_.size(); ++o) {
      if (now_.joined_in[o] != Arrangement::alone) continue;
      const Vector3d f = mean_force_on_way(laws_[o], s.area, now_.shape[o], from - moved_[o], way);
      if (!f.isZero(0.0)) share_force(s, f, force);
    }
    for (const JoinedBlocks& joined : now_.joined) {
      const Vector3d f = mean_force_on_way(joined, s.area, from - moved_[joined.obstacle[0]], way);
      if (!f.isZero(0.0)) share_force(s, f, force);
    }
  }
  frozen_.add_forces(force);
}

void ObstacleContact::add_force_sizes(const StagePlaces& at, std::span<double> size) const {
  const auto share = [&size](const SkinSample& s, double force) {
    for (const std::uint32_t i : s.corners()) size[i] += force / static_cast<double>(s.count);
  };
  for (const SkinSample& s : samples_) {
    const Vector3d y = place_of(s, at);
    for_each_contact(y, [&](const ContactLaw& law, const Penetration& in, std::uint32_t o) {
      // the depth is a difference of coordinates
      double coordinates = y.norm() + origin_of(obstacles_[o].shape).norm() + moved_[o].norm();
      for (const std::uint32_t i : s.corners()) {
        coordinates += at.x[i].norm();
        if (!at.w.empty()) coordinates += std::abs(at.t) * at.w[i].norm();
      }
      share(s, law.force(s.area, in.depth) + law.stiffness(s.area, in.depth) * coordinates);
    });
  }
  frozen_.add_force_sizes(size);
}

double ObstacleContact::energy(std::span<const Vector3d> x, std::size_t first, std::size_t stride) const {
  CompensatedSum sum;
  for (std::size_t k = first; k < samples_.size(); k += stride)
    for_each_contact(mean_of(samples_[k], x), [&](const ContactLaw& law, const Penetration& in, std::uint32_t) {
      sum.add(law.energy(samples_[k].area, in.depth));
    });
  frozen_.add_energy(x, first, stride, sum);
  return sum.value();
}

EnergyChange ObstacleContact::energy_change(const StagePlaces& at, std::span<const Vector3d> step, double scale) const {
  EnergyChange sum;
  for (const SkinSample& s : samples_) {
    const Vector3d from = place_of(s, at), way = scale * mean_of(s, step);
    for (std::uint32_t o = 0; o < obstacles_.size(); ++o)
      if (now_.joined_in[o] == Arrangement::alone)
        sum += change_on_way(laws_[o], s.area, now_.shape[o], from - moved_[o], way);
    for (const JoinedBlocks& joined : now_.joined)
      sum += change_on_way(joined, s.area, from - moved_[joined.obstacle[0]], way);
  }
  frozen_.add_change(step, scale, sum);
  return sum;
}

double ObstacleContact::power(std::span<const std::uint32_t> pieces, std::span<const Vector3d> x,
                              std::span<const Vector3d> w) const {
  double sum = 0.0;
  for (const std::uint32_t k : pieces) {
    const SkinSample& s = samples_[k];
    const Vector3d speed = mean_of(s, w);
    for_each_contact(mean_of(s, x), [&](const ContactLaw& law, const Penetration& in, std::uint32_t) {
      sum += law.force(s.area, in.depth) * in.normal.dot(speed);
    });
    const auto first = std::ranges::lower_bound(frozen_.rows, k, {}, &ContactFriction::sample);
    for (auto f = first; f != frozen_.rows.end() && f->sample == k; ++f) sum += f->force.dot(speed);
  }
  return sum;
}

void ObstacleContact::for_each_tangent(const StagePlaces& at, Compression compression,
                                       const VisitTangent& visit) const {
  for (const SkinSample& s : samples_) {
    Matrix3d sum = Matrix3d::Zero();
    for_each_contact(place_of(s, at), [&](const ContactLaw& law, const Penetration& in, std::uint32_t) {
      sum += law.stiffness(s.area, in.depth) * (in.normal * in.normal.transpose());
      // a ball gives way to what slides off it, an edge between blocks does not
      if (compression == Compression::exact || in.curvature.trace() < 0.0)
        sum -= law.force(s.area, in.depth) * in.curvature;
    });
    visit_tangent(s, sum, visit);
  }
}

void ObstacleContact::for_each_constant_tangent(const VisitTangent& visit) const {
  for (const SkinSample& s : samples_) visit_tangent(s, largest_stiffness(s.area, 1.0) * Matrix3d::Identity(), visit);
}

std::size_t ObstacleContact::Arrangement::bytes() const {
  std::size_t sum = bytes_of(moved, shape, joined_in, joined);
  for (const JoinedBlocks& j : joined) sum += j.boxes.bytes() + bytes_of(j.obstacle, j.law);
  return sum;
}

std::size_t ObstacleContact::bytes() const {
  return laws_.capacity() * sizeof(ContactLaw) + obstacles_.capacity() * sizeof(Obstacle) +
         moved_.capacity() * sizeof(Vector3d) + frozen_.rows.capacity() * sizeof(ContactFriction) + now_.bytes();
}

}  // namespace dartboard
