#include "core/contact/contacts.h"

#include <algorithm>

#include "core/base/bytes.h"

namespace dartboard {
namespace {

SkinSolids solids_of_part(const SkinSolids& whole, const VertexSubset& part) {
  SkinSolids solids;
  const auto count = static_cast<std::size_t>(
      std::ranges::count_if(part.number, [](std::uint32_t k) { return k != VertexSubset::none; }));
  solids.resize(count, whole.face_count(), whole.cell_count());
  const auto add = [&](auto row) {
    if (!part.has(row.nodes[0])) return;
    for (std::uint32_t& node : row.nodes) node = part.number[node];
    solids.add(row);
  };
  for (const SkinTetrahedron& row : whole.tetrahedra()) add(row);
  for (const SkinTriangle& row : whole.triangles()) add(row);
  return solids;
}

/// Copies of the samples at the vertices of a part, and their numbers in the whole.
void take_samples(const std::vector<SkinSample>& of_whole, const VertexSubset& part, std::vector<SkinSample>& samples,
                  std::vector<std::uint32_t>& whole) {
  for (std::uint32_t k = 0; k < of_whole.size(); ++k) {
    SkinSample sample = of_whole[k];
    if (!part.has(sample.nodes[0])) continue;
    for (std::size_t a = 0; a < sample.count; ++a) sample.nodes[a] = part.number[sample.nodes[a]];
    samples.push_back(sample);
    whole.push_back(k);
  }
}

}  // namespace

bool Contacts::has_friction() const {
  return (obstacles != nullptr && obstacles->has_friction()) || (bodies != nullptr && bodies->has_friction());
}

bool Contacts::has_damping() const {
  return (obstacles != nullptr && obstacles->has_damping()) || (bodies != nullptr && bodies->has_damping());
}

const std::vector<SkinSample>& Contacts::samples(bool of_bodies) const {
  static const std::vector<SkinSample> none;
  if (of_bodies) return bodies != nullptr ? bodies->samples() : none;
  return obstacles != nullptr ? obstacles->samples() : none;
}

ContactSite Contacts::normal_site(const Touch& touch) const {
  return touch.in_body != nullptr ? bodies->normal_site(*touch.in_body) : ContactSite(sample(touch));
}

ContactSite Contacts::tangential_site(const Touch& touch) const {
  return touch.in_body != nullptr ? bodies->tangential_site(*touch.in_body) : ContactSite(sample(touch));
}

ContactState Contacts::state_at(std::span<const Eigen::Vector3d> x) const {
  ContactState state;
  if (obstacles != nullptr) state.force_on.assign(obstacles->obstacles().size(), Eigen::Vector3d(0, 0, 0));
  CompensatedSum energy;
  for_each_touch({x}, [&](const Touch& t) {
    ++state.contacts;
    state.area += t.area;
    energy.add(t.law->energy(t.area, t.depth));
    state.deepest_share = std::max(state.deepest_share, t.depth / t.law->depth);
    if (t.in_body == nullptr) state.force_on[t.obstacle] -= t.law->force(t.area, t.depth) * t.normal;
    if (t.depth <= state.deepest) return;
    state.deepest = t.depth;
    state.sample = t.sample;
    state.obstacle = t.obstacle;
    if (t.in_body == nullptr) return;
    state.from = bodies->group_of(t.sample);
    state.into = bodies->group_entered(*t.in_body);
  });
  state.energy = energy.value();
  if (bodies == nullptr) return state;
  state.out_of_reach = bodies->out_of_reach().size();
  if (state.out_of_reach > 0) state.lost = bodies->out_of_reach().front().sample;
  state.inverted = bodies->inverted();
  return state;
}

double Contacts::frequency_squared(std::span<const double> inverse_mass, double share_of_depth) const {
  return (obstacles != nullptr ? obstacles->frequency_squared(inverse_mass, share_of_depth) : 0.0) +
         (bodies != nullptr ? bodies->frequency_squared(inverse_mass, share_of_depth) : 0.0);
}

std::size_t Contacts::bytes() const {
  return (obstacles != nullptr ? obstacles->bytes() : 0) + (bodies != nullptr ? bodies->bytes() : 0);
}

ContactOfPart::ContactOfPart(const Contacts& whole, const VertexSubset& part) {
  for (const bool of_bodies : {false, true})
    take_samples(whole.samples(of_bodies), part, samples_[of_bodies ? 1 : 0], whole_[of_bodies ? 1 : 0]);
  if (whole.obstacles != nullptr) {
    const auto laws = whole.obstacles->laws();
    const auto shapes = whole.obstacles->obstacles();
    obstacles_ = std::make_unique<ObstacleContact>(std::vector(laws.begin(), laws.end()),
                                                   std::vector(shapes.begin(), shapes.end()), samples_[0]);
    obstacles_->place_as(*whole.obstacles);
  }
  if (whole.bodies != nullptr) {
    solids_ = solids_of_part(whole.bodies->solids(), part);
    bodies_ = std::make_unique<BodyContact>(samples_[1], solids_, *whole.bodies);
  }
}

std::size_t ContactOfPart::bytes() const {
  return bytes_of(samples_[0], whole_[0], samples_[1], whole_[1]) + solids_.bytes() +
         Contacts(obstacles_.get(), bodies_.get()).bytes();
}

}  // namespace dartboard
