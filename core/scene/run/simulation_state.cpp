#include <algorithm>

#include "core/base/archive.h"
#include "core/scene/run/simulation.h"
#include "core/scene/run/sleeping.h"

// The state of a simulation in a checkpoint. Left out is what its constructor finds in the scene: the step, the
// horizon, the choices of events and drives, warnings of the start.

namespace dartboard {

// Writing does not change the simulation.
void Simulation::save(Archive& archive) const { const_cast<Simulation*>(this)->state(archive); }

void Simulation::state(Archive& archive) {
  archive.part("simulation");
  archive(done_, taken_back_, taken_back_within_, guard_, coarse_);
  archive.part("body");
  body_->state(archive);
  timeline_->state(archive);
  if (sleeping_) {
    sleeping_->state(archive);
    if (archive.reads()) step_another_part();
  }
  if (contact_) {
    archive.part("contact");
    archive(*contact_);
  }
  archive.part("integrator");
  integrator_->state(archive);
  archive.part("work of forces");
  archive(applied_, potential_, kept_applied_);
  archive.part("watch over the motion");
  archive(watch_);
  if (!archive.reads()) return;
  if (done_ > step_count_) archive.fail("there are more steps than the run has");
  timeline_->extend();
  const VertexColumns& v = body_->vertices();
  const SpringSystem system = body_->system();
  if (v.position.size() != v.size() || v.velocity.size() != v.size() || v.inverse_mass.size() != v.size() ||
      v.point.size() != v.size() || (!v.pull.empty() && v.pull.size() != v.size()) ||
      (!v.held_axes.empty() && v.held_axes.size() != v.size()) || system.ends.size() != system.springs.size())
    archive.fail("columns of the body are not as long as each other");
  for (const SpringEnds& ends : system.ends)
    if (ends[0] >= v.size() || ends[1] >= v.size()) archive.fail("a spring ends at no vertex");
  const auto is_beyond = [&v](std::uint32_t k) { return k >= v.size(); };
  const auto look_at_samples = [&](const std::vector<SkinSample>& samples) {
    for (const SkinSample& sample : samples)
      if (sample.count > sample.nodes.size() || std::ranges::any_of(sample.corners(), is_beyond))
        archive.fail("a sample of the boundary is at no vertex");
  };
  const Contacts contacts = body_->contacts();
  for (const bool of_bodies : {false, true}) look_at_samples(contacts.samples(of_bodies));
  if (const BodyContact* contact = contacts.bodies) {
    for (const SkinTetrahedron& tetrahedron : contact->solids().tetrahedra())
      if (std::ranges::any_of(tetrahedron.nodes, is_beyond)) archive.fail("a cell at the boundary is at no vertex");
    for (const SkinTriangle& triangle : contact->solids().triangles())
      if (std::ranges::any_of(triangle.nodes, is_beyond)) archive.fail("a face of the boundary is at no vertex");
  }
  if (contact_) contact_->resume(stepped_motion().x);
  watch_.resume(stepped_system(), stepped_motion());
}

}  // namespace dartboard
