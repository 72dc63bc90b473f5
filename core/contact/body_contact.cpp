#include "core/contact/body_contact.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <tuple>

#include "core/base/bytes.h"
#include "core/contact/way_out.h"
#include "core/forces/compensated_sum.h"
#include "core/places/nearest_on_triangle.h"
#include "core/plain/error.h"

namespace dartboard {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Gaps between bodies below this share of the depth of a law are none.
constexpr double narrow = 0x1p-7;

/// The place of a vertex, as a function.
struct PlaceNow {
  const StagePlaces& at;
  Vector3d operator()(std::uint32_t i) const { return at.place(i); }
};

}  // namespace

BodyContact::BodyContact(const std::vector<SkinSample>& samples, const SkinSolids& solids,
                         const std::vector<ContactPair>& pairs, std::span<const std::uint8_t> still)
    : samples_(samples),
      solids_(solids),
      candidates_(samples, solids, groups_),
      ways_(std::make_unique<WaysOut>(samples, solids, candidates_)) {
  for (const ContactPair& pair : pairs) {
    pair.law.require_valid();
    groups_.set(pair.a, pair.b, static_cast<std::uint32_t>(laws_.size()));
    laws_.push_back(pair.law);
    friction_ = friction_ || pair.law.friction > 0.0;
    damping_ = damping_ || pair.law.restitution < 1.0;
  }
  ways_->set_still(still);
}

BodyContact::BodyContact(const std::vector<SkinSample>& samples, const SkinSolids& solids, const BodyContact& other)
    : samples_(samples),
      solids_(solids),
      laws_(other.laws_),
      groups_(other.groups_),
      friction_(other.friction_),
      damping_(other.damping_),
      candidates_(samples, solids, groups_),
      ways_(std::make_unique<WaysOut>(samples, solids, candidates_)) {
  set_margin(other.candidates_.margin_share());
  ways_->set_still(other.ways_->still());
}

BodyContact::~BodyContact() = default;

std::uint64_t BodyContact::ways_searched() const { return ways_->searched(); }

/// Tests one sample with some tetrahedra, in the order of their cells and parts. It may be inside several bodies at
/// once, or parts of one: of tetrahedra with common nodes the first counts.
template <class Tetrahedra, class F>
void BodyContact::look_at(std::uint32_t s, const Tetrahedra& tetrahedra, const Nearby& nearby, const StagePlaces& at,
                          const F& found) const {
  const SkinSample& sample = samples_[s];
  const PlaceNow place{at};
  const Vector3d y = mean_of(sample, place);
  const bool may_be_covered = ways_->may_be_covered();
  auto& within = ways_->within();
  std::array<double, 4> weights{};
  std::size_t count = 0;
  const auto is_next_to_one_within = [&](const SkinTetrahedron& tetrahedron, Side side) {
    return std::ranges::any_of(std::span(within).first(count), [&](const WaysOut::Within& w) {
      if (w.on_border && side == Side::inside) return false;
      const auto& nodes = solids_.tetrahedra()[w.touch.tetrahedron].nodes;
      return std::ranges::find_first_of(tetrahedron.nodes, nodes) != tetrahedron.nodes.end();
    });
  };
  for (const std::uint32_t t : tetrahedra) {
    if (count == WaysOut::most_within) break;
    const SkinTetrahedron& tetrahedron = solids_.tetrahedra()[t];
    const Side side = side_of(tetrahedron, y, place, weights);
    if (side == Side::inverted) ++inverted_;
    if (side != Side::inside && !(side == Side::border && may_be_covered)) continue;
    if (is_next_to_one_within(tetrahedron, side)) continue;
    WaysOut::Within& one = within[count++];
    BodyTouch& touch = one.touch;
    touch.sample = s;
    touch.tetrahedron = t;
    touch.inside = weights;
    touch.depth = 0.0;
    one.cover = BodyTouch::none;
    one.on_border = side == Side::border;
    touch.law = groups_.law(group_of(s), tetrahedron.group);
    touch.area = 0.5 * sample.area;
    if (may_be_covered) one.border = narrow * laws_[touch.law].depth;
    const bool is_followed = nearby.ways == Ways::followed && !one.on_border;
    one.has_depth = is_followed ? ways_->find(y, at, touch) : ways_->search(y, at, touch);
  }
  if (may_be_covered && count > 0)
    short_of_reach_ =
        !ways_->pass_covered(y, at, nearby.tetrahedra, nearby.reach, std::span(within).first(count)) || short_of_reach_;
  for (const WaysOut::Within& one : std::span(within).first(count))
    if (one.has_depth && !(one.on_border && one.cover == BodyTouch::none)) found(one.touch);
}

void BodyContact::find_touching(const StagePlaces& at) const {
  candidates_.make_sure(at, follows_);
  find_among_candidates(at);
  // what may cover a way need not be in a list that is nearly used up
  if (short_of_reach_ && candidates_.make_fresh(at)) find_among_candidates(at);
}

void BodyContact::find_among_candidates(const StagePlaces& at) const {
  touching_.clear();
  lost_.clear();
  inverted_ = 0;
  short_of_reach_ = false;
  ways_->move();
  if (candidates_.none_can_have_met()) {
    follows_ = false;
    return;
  }
  const auto list = candidates_.tetrahedra();
  const auto add = [this](const BodyTouch& touch) {
    (touch.triangle == BodyTouch::none ? lost_ : touching_).push_back(touch);
  };
  for (const CandidatePairs::Row row : candidates_.rows()) {
    // without a branch: which of them are near is not foreseen
    std::size_t count = 0;
    near_.resize(std::max<std::size_t>(near_.size(), row.count));
    std::uint32_t* const near = near_.data();
    for (std::size_t pair = row.first; pair < row.first + row.count; ++pair) {
      near[count] = list[pair];
      count += candidates_.can_have_met(pair) ? 1 : 0;
    }
    if (count == 0) continue;
    const std::size_t touches = touching_.size(), lost = lost_.size(), inverted = inverted_;
    Nearby nearby{Ways::followed, list.subspan(row.first, row.count), candidates_.reach()};
    for (;;) {
      look_at(row.sample, std::span(near, count), nearby, at, add);
      if (!short_of_reach_ || !candidates_.is_fresh()) break;
      // deeper than the list reaches
      short_of_reach_ = false;
      touching_.resize(touches);
      lost_.resize(lost);
      inverted_ = inverted;
      find_partners(row.sample);
      nearby = {Ways::searched, partners_};
    }
  }
  follows_ = !touching_.empty();
}

/// All tetrahedra of groups that the sample may touch.
void BodyContact::find_partners(std::uint32_t sample) const {
  const std::uint32_t group = group_of(sample);
  partners_.clear();
  for (std::uint32_t t = 0; t < solids_.tetrahedra().size(); ++t)
    if (groups_.law(group, solids_.tetrahedra()[t].group) != ContactGroups::none) partners_.push_back(t);
}

void BodyContact::exchange_with_aside() const {
  touching_.swap(touching_aside_);
  lost_.swap(lost_aside_);
  std::swap(inverted_, inverted_aside_);
  put_aside_ = !put_aside_;
}

/// A run asks for the contacts at the end of a step some times: for forces, losses and warnings.
void BodyContact::find_touching_now(const StagePlaces& at) const {
  if (!at.w.empty()) {
    if (!searched_.empty() && !put_aside_) exchange_with_aside();
    find_touching(at);
    return;
  }
  if (searched_changes_ == solids_.changes() && !at.x.empty() && searched_.size() == at.x.size() &&
      std::memcmp(searched_.data(), at.x.data(), at.x.size_bytes()) == 0) {
    if (put_aside_) exchange_with_aside();
    return;
  }
  find_touching(at);
  if (candidates_.none_can_have_met())
    searched_.clear();  // to look once more costs no more than to compare places
  else
    searched_.assign(at.x.begin(), at.x.end());
  searched_changes_ = solids_.changes();
  put_aside_ = false;
}

std::span<const BodyTouch> BodyContact::touching(const StagePlaces& at) const {
  find_touching_now(at);
  return touching_;
}

std::vector<BodyTouch> BodyContact::touching_by_brute_force(const StagePlaces& at,
                                                            std::vector<BodyTouch>* out_of_reach) const {
  const auto& tetrahedra = solids_.tetrahedra();
  std::vector<std::uint32_t> order(tetrahedra.size()), may;
  for (std::uint32_t t = 0; t < order.size(); ++t) order[t] = t;
  std::ranges::sort(order, {},
                    [&tetrahedra](std::uint32_t t) { return std::pair(tetrahedra[t].cell, tetrahedra[t].part); });
  MayTouch may_touch(solids_, groups_);
  std::vector<BodyTouch> touches;
  const std::size_t inverted = inverted_;  // among the candidates
  ways_->move();
  for (std::uint32_t s = 0; s < samples_.size(); ++s) {
    may_touch.look_at(samples_[s]);
    may.clear();
    for (const std::uint32_t t : order)
      if (may_touch(tetrahedra[t])) may.push_back(t);
    look_at(s, may, {Ways::searched, may}, at, [&](const BodyTouch& touch) {
      if (touch.triangle != BodyTouch::none) touches.push_back(touch);
      if (touch.triangle == BodyTouch::none && out_of_reach != nullptr) out_of_reach->push_back(touch);
    });
  }
  inverted_ = inverted;
  return touches;
}

ContactSite BodyContact::normal_site(const BodyTouch& touch) const {
  ContactSite site(samples_[touch.sample]);
  const SkinTriangle& triangle = solids_.triangles()[touch.triangle];
  for (std::size_t k = 0; k < 3; ++k) site.add(triangle.nodes[k], -touch.nearest[k]);
  return site;
}

ContactSite BodyContact::tangential_site(const BodyTouch& touch) const {
  ContactSite site(samples_[touch.sample]);
  const SkinTetrahedron& tetrahedron = solids_.tetrahedra()[touch.tetrahedron];
  for (std::size_t k = 0; k < 4; ++k) site.add(tetrahedron.nodes[k], -touch.inside[k]);
  return site;
}

/// Is the sample of an earlier touch inside still, by at least half as much, and beyond the tetrahedra along the
/// boundary? The boundary triangles at the tetrahedron that it was inside of decide: those that are nearest to it,
/// together, as at an edge it may be behind one of two. In a tetrahedron there that it does not touch, as beside the
/// tip of a cut, it is not lost.
bool BodyContact::is_deep_inside(const BodyTouch& earlier, const StagePlaces& at) const {
  const PlaceNow place{at};
  const SkinSample& sample = samples_[earlier.sample];
  const Vector3d y = mean_of(sample, place);
  BodyTouch touch{.sample = earlier.sample, .tetrahedron = earlier.tetrahedron};
  if (!ways_->search(y, at, touch)) return false;
  if (!(touch.depth > 0.5 * earlier.depth)) return false;
  Vector3d outwards(0, 0, 0);
  bool is_known = false;
  for (const std::uint32_t node : solids_.tetrahedra()[touch.tetrahedron].nodes) {
    solids_.for_each_tetrahedron_at(node, [&](std::uint32_t k) {
      std::array<double, 4> weights{};
      is_known = is_known || side_of(solids_.tetrahedra()[k], y, place, weights) == Side::inside;
    });
    solids_.for_each_triangle_at(node, [&](std::uint32_t k) {
      const auto& corner = solids_.triangles()[k].nodes;
      const Vector3d a = place(corner[0]) - y, b = place(corner[1]) - y, c = place(corner[2]) - y;
      constexpr double rounding = 1.0 + 1e-9;
      if (nearest_on_triangle(a, b, c).way.norm() <= rounding * touch.depth)
        outwards += (b - a).cross(c - a).normalized();
    });
  }
  return !is_known && outwards.dot(touch.normal) > 0.0;
}

std::span<const BodyTouch> BodyContact::find_lost(std::span<const Vector3d> x) {
  const StagePlaces at{x};
  const auto now = touching(at);
  gone_.assign(lost_.begin(), lost_.end());
  if (before_changes_ == solids_.changes()) {
    auto still = now.begin();
    for (const BodyTouch& t : before_) {
      while (still != now.end() && still->sample < t.sample) ++still;
      if (still != now.end() && still->sample == t.sample) continue;
      if (std::ranges::find(lost_, t.sample, &BodyTouch::sample) != lost_.end()) continue;
      if (is_deep_inside(t, at)) gone_.push_back(t);
    }
  }
  before_changes_ = solids_.changes();
  before_.assign(now.begin(), now.end());
  return gone_;
}

double BodyContact::least_altitude(std::span<const Vector3d> x) const {
  double least = std::numeric_limits<double>::infinity();
  for (const SkinTetrahedron& t : solids_.tetrahedra()) {
    const Vector3d &p = x[t.nodes[0]], a = x[t.nodes[1]] - p, b = x[t.nodes[2]] - p, c = x[t.nodes[3]] - p;
    const double volume = std::abs(a.dot(b.cross(c)));
    double largest = (b - a).cross(c - a).norm();  // twice the area of a face
    for (const double area : {a.cross(b).norm(), b.cross(c).norm(), c.cross(a).norm()})
      largest = std::max(largest, area);
    if (largest > 0.0) least = std::min(least, volume / largest);
  }
  return least;
}

double BodyContact::largest_stiffness(std::uint32_t sample, double share_of_depth) const {
  const std::uint32_t group = group_of(sample);
  double largest = 0.0;
  for (std::uint32_t other = 0; other < groups_.count(); ++other)
    if (const std::uint32_t law = groups_.law(group, other); law != ContactGroups::none)
      largest = std::max(largest, laws_[law].stiffness(0.5 * samples_[sample].area, share_of_depth * laws_[law].depth));
  return largest;
}

// In a contact k w w' n n' with the weights w of a site, the row of a node has |w| times the sum of all |w|, which is
// 2. Weights of the samples at a node are 1/n, and those of triangles there at most 1.
double BodyContact::frequency_squared(std::span<const double> inverse_mass, double share_of_depth) const {
  std::vector<double> own(inverse_mass.size(), 0.0);
  double single = 0.0;
  for (std::uint32_t k = 0; k < samples_.size(); ++k) {
    const double stiffness = largest_stiffness(k, share_of_depth);
    single = std::max(single, stiffness);
    for (const std::uint32_t i : samples_[k].corners()) own[i] += stiffness / static_cast<double>(samples_[k].count);
  }
  double highest = 0.0;
  for (std::size_t i = 0; i < own.size(); ++i)
    if (own[i] > 0.0) highest = std::max(highest, 2.0 * inverse_mass[i] * (own[i] + std::max(own[i], single)));
  return highest;
}

double BodyContact::frequency_squared_at(std::span<const Vector3d> x, std::span<const double> inverse_mass) const {
  std::vector<double> row(inverse_mass.size(), 0.0);
  for (const BodyTouch& t : touching({x})) {
    // along the line, and across it: a force that turns with its line
    const double stiffness =
        std::max(laws_[t.law].stiffness(t.area, t.depth), laws_[t.law].force(t.area, t.depth) / t.depth);
    const ContactSite site = normal_site(t);
    for (std::size_t k = 0; k < site.count; ++k)
      row[site.nodes[k]] += 2.0 * inverse_mass[site.nodes[k]] * stiffness * std::abs(site.weights[k]);
  }
  return row.empty() ? 0.0 : *std::ranges::max_element(row);
}

// ---- the force term

BodyContact::Nodes BodyContact::nodes(std::size_t piece) const {
  if (piece < samples_.size()) return samples_[piece].corners();
  piece -= samples_.size();
  if (piece < solids_.triangles().size()) return solids_.triangles()[piece].nodes;
  return solids_.tetrahedra()[piece - solids_.triangles().size()].nodes;
}

void BodyContact::add_forces(const StagePlaces& at, std::span<Vector3d> force) const {
  for (const BodyTouch& t : touching(at)) normal_site(t).add_to(force, laws_[t.law].force(t.area, t.depth) * t.normal);
  frozen_.add_forces(force);
}

void BodyContact::add_discrete_forces(const StagePlaces&, std::span<Vector3d>) const {
  throw SolverError("contact between bodies has kinks, through which there is no discrete gradient");
}

void BodyContact::add_force_sizes(const StagePlaces& at, std::span<double> size) const {
  for (const BodyTouch& t : touching(at)) {
    // the depth is a difference of coordinates, and its rounding turns the line
    const ContactSite site = normal_site(t);
    double coordinates = 0.0;
    for (std::size_t k = 0; k < site.count; ++k) coordinates = std::max(coordinates, at.place(site.nodes[k]).norm());
    const double force = laws_[t.law].force(t.area, t.depth);
    site.add_size_to(size, force + 4.0 * (laws_[t.law].stiffness(t.area, t.depth) + force / t.depth) * coordinates);
  }
  frozen_.add_force_sizes(size);
}

double BodyContact::energy(std::span<const Vector3d> x, std::size_t first, std::size_t stride) const {
  CompensatedSum sum;
  for (const BodyTouch& t : touching({x}))
    if (t.sample >= first && (t.sample - first) % stride == 0) sum.add(laws_[t.law].energy(t.area, t.depth));
  frozen_.add_energy(x, first, stride, sum);
  return sum.value();
}

EnergyChange BodyContact::energy_change(const StagePlaces& at, std::span<const Vector3d> step, double scale) const {
  EnergyChange sum;
  // by sample and law: the depth before and after
  find_touching(at);
  earlier_.assign(touching_.begin(), touching_.end());
  searched_.clear();
  after_.resize(at.x.size());
  for (std::uint32_t i = 0; i < after_.size(); ++i) after_[i] = at.place(i) + scale * step[i];
  find_touching({after_});
  const auto add = [&](const BodyTouch* before, const BodyTouch* after) {
    const BodyTouch& any = before != nullptr ? *before : *after;
    const ContactLaw& law = laws_[any.law];
    const double d0 = before != nullptr ? before->depth : 0.0, d1 = after != nullptr ? after->depth : 0.0;
    const double force = law.mean_force(any.area, d0, d1);
    double coordinates = 0.0;
    for (const std::uint32_t i : samples_[any.sample].corners())
      coordinates = std::max(coordinates, at.place(i).norm());
    sum.value += force * (d1 - d0);
    sum.sizes += force * (std::abs(d1 - d0) + 4.0 * coordinates);
  };
  auto after = touching_.begin();
  for (const BodyTouch& before : earlier_) {
    for (; after != touching_.end() && after->sample < before.sample; ++after) add(nullptr, &*after);
    const bool same = after != touching_.end() && after->sample == before.sample;
    if (same && after->law == before.law) {
      add(&before, &*after);
    } else {
      add(&before, nullptr);
      if (same) add(nullptr, &*after);
    }
    if (same) ++after;
  }
  for (; after != touching_.end(); ++after) add(nullptr, &*after);
  frozen_.add_change(step, scale, sum);
  return sum;
}

double BodyContact::power(std::span<const std::uint32_t> pieces, std::span<const Vector3d> x,
                          std::span<const Vector3d> w) const {
  const auto touches = touching({x});
  if (touches.empty() && frozen_.rows.empty()) return 0.0;
  const std::size_t triangles = samples_.size(), tetrahedra = triangles + solids_.triangles().size();
  asked_.assign(size(), 0);
  for (const std::uint32_t piece : pieces) asked_[piece] = 1;
  double sum = 0.0;
  const auto speed = [w](const auto& nodes, const auto& weights) {
    Vector3d mean(0, 0, 0);
    for (std::size_t k = 0; k < weights.size(); ++k) mean += weights[k] * w[nodes[k]];
    return mean;
  };
  const auto of_sample = [this, w](std::uint32_t sample) {
    return mean_of(samples_[sample], [w](std::uint32_t i) -> const Vector3d& { return w[i]; });
  };
  for (const BodyTouch& t : touches) {
    const Vector3d force = laws_[t.law].force(t.area, t.depth) * t.normal;
    if (asked_[t.sample] != 0) sum += force.dot(of_sample(t.sample));
    if (asked_[triangles + t.triangle] != 0) sum -= force.dot(speed(solids_.triangles()[t.triangle].nodes, t.nearest));
  }
  for (const ContactFriction& f : frozen_.rows) {
    if (asked_[f.sample] != 0) sum += f.force.dot(of_sample(f.sample));
    if (asked_[tetrahedra + f.tetrahedron] == 0) continue;
    for (std::size_t k = samples_[f.sample].count; k < f.site.count; ++k)
      sum += f.site.weights[k] * f.force.dot(w[f.site.nodes[k]]);
  }
  return sum;
}

// With w the weights of a site, (w . v)^2 <= 2 (own part)^2 + 2 (other part)^2.
void BodyContact::for_each_tangent(const StagePlaces& at, Compression, const VisitTangent& visit) const {
  find_touching_now(at);
  const auto tangent_of = [this](const BodyTouch& t) -> Matrix3d {
    // along the line; its rotation is neglected
    return 2.0 * laws_[t.law].stiffness(t.area, t.depth) * (t.normal * t.normal.transpose());
  };
  auto touch = touching_.begin();
  for (std::uint32_t k = 0; k < samples_.size(); ++k) {
    const bool touches = touch != touching_.end() && touch->sample == k;
    visit_tangent(samples_[k], touches ? tangent_of(*touch++) : Matrix3d(Matrix3d::Zero()), visit);
  }
  by_triangle_.clear();
  for (std::uint32_t k = 0; k < touching_.size(); ++k) by_triangle_.emplace_back(touching_[k].triangle, k);
  std::ranges::sort(by_triangle_);
  auto next = by_triangle_.begin();
  std::array<Matrix3d, 10> blocks;
  for (std::uint32_t k = 0; k < solids_.triangles().size(); ++k) {
    std::fill_n(blocks.begin(), 6, Matrix3d::Zero());
    for (; next != by_triangle_.end() && next->first == k; ++next) {
      const BodyTouch& t = touching_[next->second];
      const Matrix3d tangent = tangent_of(t);
      for (std::size_t a = 0, place = 0; a < 3; ++a)
        for (std::size_t b = 0; b <= a; ++b, ++place) blocks[place] += t.nearest[a] * t.nearest[b] * tangent;
    }
    visit(solids_.triangles()[k].nodes, std::span(blocks).first(6));
  }
  blocks.fill(Matrix3d::Zero());
  for (const SkinTetrahedron& t : solids_.tetrahedra()) visit(t.nodes, blocks);
}

void BodyContact::for_each_constant_tangent(const VisitTangent& visit) const {
  // twice for its own side, and the same again for the effect of the other side's samples on its nodes
  for (std::uint32_t k = 0; k < samples_.size(); ++k)
    visit_tangent(samples_[k], 4.0 * largest_stiffness(k, 1.0) * Matrix3d::Identity(), visit);
  std::array<Matrix3d, 10> blocks;
  blocks.fill(Matrix3d::Zero());
  for (const SkinTriangle& t : solids_.triangles()) visit(t.nodes, std::span(blocks).first(6));
  for (const SkinTetrahedron& t : solids_.tetrahedra()) visit(t.nodes, blocks);
}

std::size_t BodyContact::bytes() const {
  return bytes_of(laws_, frozen_.rows, touching_, lost_, earlier_, before_, gone_) +
         bytes_of(searched_, after_, touching_aside_, lost_aside_, near_, partners_, asked_, by_triangle_) +
         groups_.bytes() + candidates_.bytes() + ways_->bytes();
}

}  // namespace dartboard
