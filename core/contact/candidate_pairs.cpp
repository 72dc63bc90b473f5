#include "core/contact/candidate_pairs.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <tuple>

#include "core/base/bytes.h"
#include "core/plain/error.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

/// A tetrahedron that covers more cells of the grid than this is tested with every sample.
constexpr double most_cells = 512.0;
/// The most cells of the grid for each bucket, if neighbours are to be neighbours in memory.
constexpr double most_empty = 4.0;
/// The allowance for rounding in a margin, relative to the size of the coordinates.
constexpr double slack = 0x1p-30;
/// The most vertices between two nodes of tetrahedra that are looked at with them.
constexpr std::uint32_t most_between = 16;
/// A tetrahedron with less than this share of the volume of the cube around it is flat.
constexpr double flat = 1e-6;

/// [m] The largest way of a vertex.
template <class Runs>
double largest_way(const Runs& runs, std::span<const Vector3d> from, const StagePlaces& to) {
  double most = 0.0;
  for (const auto& run : runs)
    for (std::uint32_t k = 0; k < run.count; ++k)
      most = std::max(most, (to.place(run.first + k) - from[run.place + k]).squaredNorm());
  return std::sqrt(most);
}

}  // namespace

// ---- which groups

void ContactGroups::set(std::uint32_t a, std::uint32_t b, std::uint32_t law) {
  if (this->law(a, b) != none) throw InputError(fmt::format("bodies {} and {} have two laws of contact", a, b));
  if (const std::size_t count = std::max<std::size_t>(a, b) + 1; count > count_) {
    std::vector<std::uint32_t> larger(count * count, none);
    for (std::size_t i = 0; i < count_; ++i)
      for (std::size_t j = 0; j < count_; ++j) larger[i * count + j] = table_[i * count_ + j];
    table_ = std::move(larger);
    count_ = count;
  }
  table_[a * count_ + b] = table_[b * count_ + a] = law;
}

// ---- which pairs, whatever their places

void MayTouch::look_at(const SkinSample& sample) {
  sample_ = &sample;
  group_ = solids_.group_at(sample.nodes[0]);
  marked_ = false;
}

bool MayTouch::operator()(const SkinTetrahedron& tetrahedron) {
  if (groups_.law(group_, tetrahedron.group) == ContactGroups::none) return false;
  if (group_ != tetrahedron.group) return true;  // no cell joins two bodies
  if (!marked_) mark_near();
  return std::ranges::none_of(tetrahedron.nodes, [this](std::uint32_t i) { return near_[i] == current_; });
}

/// The corners of the cells at the sample's nodes.
void MayTouch::mark_near() {
  marked_ = true;
  ++current_;
  near_.resize(std::max(near_.size(), solids_.node_count()), 0);
  for (const std::uint32_t i : sample_->corners())
    solids_.for_each_tetrahedron_at(i, [this](std::uint32_t at) {
      solids_.for_each_tetrahedron_of(solids_.tetrahedra()[at].cell, [this](std::uint32_t part) {
        for (const std::uint32_t j : solids_.tetrahedra()[part].nodes) near_[j] = current_;
      });
    });
}

// ---- which pairs are near

CandidatePairs::CandidatePairs(const std::vector<SkinSample>& samples, const SkinSolids& solids,
                               const ContactGroups& groups)
    : samples_(samples), solids_(solids), may_touch_(solids, groups) {}

void CandidatePairs::set_margin(double share) {
  if (!(share > 0.0 && std::isfinite(share)))
    throw InputError(fmt::format("the margin of contacts is {} of the size of cells, expected more than 0", share));
  share_ = share;
  changes_ = solids_.changes() - 1;  // no list has this margin
}

/// The nodes of tetrahedra, once for each state of the skin.
void CandidatePairs::watch() {
  if (made_ > 0 && changes_ == solids_.changes()) return;
  place_of_node_.assign(solids_.node_count(), SkinSolids::none);
  for (const SkinTetrahedron& t : solids_.tetrahedra())
    for (const std::uint32_t i : t.nodes) place_of_node_[i] = 0;
  watched_.clear();
  std::uint32_t places = 0;
  for (std::uint32_t i = 0; i < place_of_node_.size(); ++i) {
    if (place_of_node_[i] == SkinSolids::none) continue;
    if (watched_.empty() || i - (watched_.back().first + watched_.back().count) > most_between) {
      watched_.push_back({i, 0, places});
    }
    Run& run = watched_.back();
    run.count = i + 1 - run.first;
    place_of_node_[i] = run.place + run.count - 1;
    places = run.place + run.count;
  }
  where_.resize(places);
}

BoxAround CandidatePairs::ways_from(const std::vector<Vector3d>& from, const StagePlaces& to) const {
  BoxAround ways;
  for (const Run& run : watched_) add_ways(ways, std::span(from).subspan(run.place, run.count), to, run.first);
  return ways;
}

bool CandidatePairs::holds(const StagePlaces& at) {
  if (changes_ != solids_.changes() || sample_count_ != samples_.size() || made_ == 0) return false;
  moved_together_ = where_.empty() ? 0.0 : ways_from(where_, at).diagonal();
  // where pairs may meet, a sharper bound saves more than it costs
  if (!(moved_together_ < least_gap_))
    moved_together_ = std::min(moved_together_, 2.0 * largest_way(watched_, where_, at));
  return moved_together_ < margin_;
}

double CandidatePairs::room_at(const StagePlaces& at) {
  return holds(at) ? std::max(0.0, std::min(least_gap_, margin_) - moved_together_) : 0.0;
}

bool CandidatePairs::make_fresh(const StagePlaces& at) {
  if (is_fresh()) return false;
  watch();
  copy_places(at, where_);
  make();
  return true;
}

void CandidatePairs::make_sure(const StagePlaces& at, bool follows) {
  if (!holds(at)) {
    moved_together_ = BoxAround::infinity;
    make_fresh(at);
  }
  if (follows) {
    follow(at);
  } else {
    last_.clear();
    call_ += 2;
  }
}

void CandidatePairs::copy_places(const StagePlaces& at, std::vector<Vector3d>& to) const {
  for (const Run& run : watched_)
    for (std::uint32_t k = 0; k < run.count; ++k) to[run.place + k] = at.place(run.first + k);
}

// Bodies that fly together have ways that are alike, so that little is left of them beside the middle of all.
void CandidatePairs::follow(const StagePlaces& at) {
  ++call_;
  if (last_.size() != where_.size() || last_changes_ != changes_) {
    ++call_;
    last_.resize(where_.size());
    ways_.resize(solids_.node_count());
    last_changes_ = changes_;
    copy_places(at, last_);
    return;
  }
  const BoxAround all = ways_from(last_, at);
  const Vector3d middle = 0.5 * (all.low + all.high);
  for (const Run& run : watched_)
    for (std::uint32_t k = 0; k < run.count; ++k) {
      Vector3d& last = last_[run.place + k];
      const Vector3d now = at.place(run.first + k), way = (now - last) - middle;
      // no less than the length, and no root
      double& sum = ways_[run.first + k];
      sum = std::abs(way.x()) + std::abs(way.y()) + std::abs(way.z());
      if (std::isnan(sum)) sum = BoxAround::infinity;
      last = now;
    }
}

std::size_t CandidatePairs::bucket_of(double x, double y, double z) const {
  const auto whole = [](double c) { return static_cast<std::uint64_t>(static_cast<std::int64_t>(c)); };
  return static_cast<std::size_t>(whole(x) + stride_y_ * whole(y) + stride_z_ * whole(z)) & (bucket_first_.size() - 2);
}

// Two passes over all cells that the boxes cover: to count, and to fill.
void CandidatePairs::put_into_grid() {
  const std::size_t buckets = std::bit_ceil(2 * std::max<std::size_t>(boxes_.size(), 1));
  bucket_first_.assign(buckets + 1, 0);
  everywhere_.clear();
  // Cells next to each other have buckets next to each other where the body fills its box: one that is searched in
  // order stays within few lines of memory. Bodies far apart are scattered.
  Vector3d lowest(0, 0, 0), highest(0, 0, 0);
  for (const Box& box : boxes_) {
    lowest = &box == boxes_.data() ? box.low : Vector3d(lowest.cwiseMin(box.low));
    highest = &box == boxes_.data() ? box.high : Vector3d(highest.cwiseMax(box.high));
  }
  const Vector3d across = ((highest - lowest) / cell_size_).array().floor() + 2.0;
  const bool fills = across.prod() <= most_empty * static_cast<double>(buckets);  // false for NaN
  stride_y_ = fills ? static_cast<std::uint64_t>(across[0]) : 0x9E3779B97F4A7C15u;
  stride_z_ = fills ? static_cast<std::uint64_t>(across[0] * across[1]) : 0xBF58476D1CE4E5B9u;
  const auto for_each_bucket = [&](const Box& box, auto&& visit) {
    const Vector3d low = (box.low / cell_size_).array().floor(), high = (box.high / cell_size_).array().floor();
    const Vector3d cells = high - low + Vector3d(1, 1, 1);
    // also false for NaN
    if (!(cells[0] * cells[1] * cells[2] <= most_cells && low.cwiseAbs().maxCoeff() < 1e15)) return false;
    for (double z = low[2]; z <= high[2]; ++z)
      for (double y = low[1]; y <= high[1]; ++y)
        for (double x = low[0]; x <= high[0]; ++x) visit(bucket_of(x, y, z));
    return true;
  };
  for (std::uint32_t t = 0; t < boxes_.size(); ++t)
    if (!for_each_bucket(boxes_[t], [this](std::size_t bucket) { ++bucket_first_[bucket]; })) everywhere_.push_back(t);
  for (std::size_t k = 0; k < buckets; ++k) bucket_first_[k + 1] += bucket_first_[k];
  bucket_entry_.resize(bucket_first_[buckets]);
  // each bucket is filled from the back, so that the mark of its end becomes that of its beginning
  for (std::uint32_t t = 0; t < boxes_.size(); ++t)
    for_each_bucket(boxes_[t], [this, t](std::size_t bucket) { bucket_entry_[--bucket_first_[bucket]] = t; });
}

/// A bound of the rounding of distances from the box [m].
double CandidatePairs::rounding_of(const Box& box) const {
  const double far = box.low.cwiseAbs().cwiseMax(box.high.cwiseAbs()).maxCoeff();
  return slack * (1.0 + share_) * cell_size_ + 0x1p-44 * far;
}

/// At most the distance between a place and a tetrahedron, by the box around it and by its faces, less the rounding.
double CandidatePairs::gap_between(const Vector3d& y, const SkinTetrahedron& t) const {
  const auto place = [&](std::size_t k) -> const Vector3d& { return where_[place_of_node_[t.nodes[k]]]; };
  const Vector3d &p = place(0), a = place(1) - p, b = place(2) - p, c = place(3) - p, r = y - p;
  const Vector3d low = a.cwiseMin(b).cwiseMin(c).cwiseMin(0.0), high = a.cwiseMax(b).cwiseMax(c).cwiseMax(0.0);
  double gap = (low - r).cwiseMax(r - high).cwiseMax(0.0).norm();
  const double size = (high - low).maxCoeff();
  const std::array<Vector3d, 3> normals{b.cross(c), c.cross(a), a.cross(b)};
  const double volume = a.dot(normals[0]);
  // the faces of a flat one have no certain directions
  if (!(std::abs(volume) > flat * size * size * size)) return 0.0;
  const double side = volume > 0.0 ? 1.0 : -1.0;
  double inside = 0.0;
  for (const Vector3d& normal : normals) {
    const double beyond = side * r.dot(normal);
    inside += beyond;
    gap = std::max(gap, -beyond / normal.norm());
  }
  gap = std::max(gap, (inside - std::abs(volume)) / (b - a).cross(c - a).norm());
  return std::max(0.0, gap - 1e-8 * size - rounding_of({p + low, p + high}));
}

void CandidatePairs::make() {
  const auto place = [this](std::uint32_t i) -> const Vector3d& { return where_[place_of_node_[i]]; };
  const auto& tetrahedra = solids_.tetrahedra();
  rows_.clear();
  tetrahedra_.clear();
  gaps_.clear();
  moved_together_ = 0.0;
  changes_ = solids_.changes();
  sample_count_ = samples_.size();
  ++made_;

  boxes_.resize(tetrahedra.size());
  double sizes = 0.0, count = 0.0;
  for (std::size_t t = 0; t < tetrahedra.size(); ++t) {
    Box& box = boxes_[t];
    box.low = box.high = place(tetrahedra[t].nodes[0]);
    for (const std::uint32_t i : tetrahedra[t].nodes) {
      box.low = box.low.cwiseMin(place(i));
      box.high = box.high.cwiseMax(place(i));
    }
    if (const double size = (box.high - box.low).maxCoeff(); std::isfinite(size)) {
      sizes += size;
      count += 1.0;
    }
  }
  cell_size_ = count > 0.0 && sizes > 0.0 ? sizes / count : 1.0;
  margin_ = least_gap_ = share_ * cell_size_;
  for (Box& box : boxes_) {
    const double by = margin_ + rounding_of(box);
    box.low.array() -= by;
    box.high.array() += by;
  }
  put_into_grid();

  for (std::uint32_t s = 0; s < samples_.size(); ++s) {
    const SkinSample& sample = samples_[s];
    if (sample.nodes[0] >= place_of_node_.size() || place_of_node_[sample.nodes[0]] == SkinSolids::none) continue;
    const Vector3d y = mean_of(sample, place);
    if (!y.allFinite() || !(y.cwiseAbs().maxCoeff() < 1e15 * cell_size_)) continue;
    may_touch_.look_at(sample);
    found_.clear();
    const auto try_one = [&](std::uint32_t t) {
      const Box& box = boxes_[t];
      if ((y.array() < box.low.array()).any() || (y.array() > box.high.array()).any()) return;
      if (may_touch_(tetrahedra[t])) found_.push_back(t);
    };
    const Vector3d cell = (y / cell_size_).array().floor();
    const std::size_t bucket = bucket_of(cell[0], cell[1], cell[2]);
    for (std::size_t k = bucket_first_[bucket]; k < bucket_first_[bucket + 1]; ++k) try_one(bucket_entry_[k]);
    for (const std::uint32_t t : everywhere_) try_one(t);
    if (found_.empty()) continue;
    // two cells of the grid may share a bucket
    std::ranges::sort(found_, [&tetrahedra](std::uint32_t a, std::uint32_t b) {
      return std::tie(tetrahedra[a].cell, tetrahedra[a].part) < std::tie(tetrahedra[b].cell, tetrahedra[b].part);
    });
    found_.erase(std::unique(found_.begin(), found_.end()), found_.end());
    rows_.push_back({s, static_cast<std::uint32_t>(tetrahedra_.size()), static_cast<std::uint32_t>(found_.size())});
    tetrahedra_.insert(tetrahedra_.end(), found_.begin(), found_.end());
    for (const std::uint32_t t : found_) {
      gaps_.push_back(static_cast<float>((1.0 - 1e-6) * gap_between(y, tetrahedra[t])));
      least_gap_ = std::min(least_gap_, static_cast<double>(gaps_.back()));
    }
  }
}

std::size_t CandidatePairs::bytes() const {
  return bytes_of(rows_, tetrahedra_, gaps_, watched_, where_, last_, ways_, place_of_node_, boxes_) +
         bytes_of(bucket_first_, bucket_entry_, everywhere_) + may_touch_.bytes();
}

}  // namespace dartboard
