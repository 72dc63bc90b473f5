#include "core/scene/body/body_forces.h"

#include <algorithm>
#include <utility>

#include "core/scene/body/make_contact.h"

namespace dartboard {

void BodyForces::make(std::span<const ForceNeed> needs, const ForceSite& site) {
  for (const ForceNeed& need : needs)
    if (auto force = need.make(site)) {
      terms_.push_back(&force->term());
      kept_.push_back({need.kind, std::move(force)});
    }
}

void BodyForces::touch_obstacles(const std::vector<SceneObstacle>& obstacles, const std::vector<SkinSample>& samples) {
  if (obstacles.empty()) return;
  obstacles_ = make_contact(obstacles, samples);
  terms_.push_back(obstacles_.get());
}

void BodyForces::touch_bodies(std::unique_ptr<BodyContact> contact) {
  own_bodies_ = std::move(contact);
  touch_bodies(own_bodies_.get());
}

void BodyForces::touch_bodies(BodyContact* of_part) {
  bodies_ = of_part;
  if (of_part != nullptr) terms_.push_back(of_part);
}

BodyForce* BodyForces::with_loads() const {
  const auto found = std::ranges::find_if(kept_, [](const Kept& kept) { return !kept.force->loads().empty(); });
  return found == kept_.end() ? nullptr : found->force.get();
}

bool BodyForces::do_work() const {
  return std::ranges::any_of(kept_, [](const Kept& kept) { return kept.force->does_work(); });
}

void BodyForces::begin_work(std::span<const Eigen::Vector3d> x) const {
  for_each([x](BodyForce& force) { force.begin_work(x); });
}

double BodyForces::work(std::span<const Eigen::Vector3d> x, double h) const {
  double sum = 0.0;
  for_each([&](const BodyForce& force) { sum += force.work(x, h); });
  return sum;
}

void BodyForces::state(Archive& archive) {
  for_each([&archive](BodyForce& force) { force.state(archive); });
  if (obstacles_) archive(*obstacles_);
}

void BodyForces::report(MemoryReport& report) const {
  for (const Kept& kept : kept_) report.push_back({Part::force, kept.force->bytes(), kept.kind});
}

}  // namespace dartboard
