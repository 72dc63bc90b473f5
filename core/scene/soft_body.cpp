#include "core/scene/soft_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/plain/error.h"
#include "core/scene/body/frame_columns.h"
#include "core/scene/body/needs.h"
#include "core/scene/output/write_vtu.h"
#include "core/time/integrators.h"

namespace dartboard {
namespace {

std::unique_ptr<SimulatedBody> body_of(const Problem& problem) {
  for (const Material& material : problem.cell_materials().all())
    if (material.model == Model::springs && material.poisson != Material{}.poisson)
      throw InputError(fmt::format(
          "a Poisson's ratio of {} for springs, which have none; expected another Material::model", material.poisson));
  BodyNeeds needs = body_needs(problem, storage_of(problem.mesh) != Storage::links);
  needs.rest = true;  // for the displacement in frames
  return make_simulated_body(problem, needs);
}

}  // namespace

SoftBody::SoftBody(const Problem& problem, std::string_view integrator)
    : body_(body_of(problem)), integrator_(make_integrator(integrator)) {}

SoftBody::~SoftBody() = default;
SoftBody::SoftBody(SoftBody&&) noexcept = default;
SoftBody& SoftBody::operator=(SoftBody&&) noexcept = default;

void SoftBody::step(double h) {
  if (!(h > 0.0) || !std::isfinite(h)) throw InputError(fmt::format("a step of {} s; expected one above 0", h));
  const StepResult result = integrator_->step(system(), body_->motion(), h);
  if (!result.ok()) throw SolverError(to_string(result));
  time_ += h;
}

std::size_t SoftBody::dissociate(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) {
  return apply(Dissociate{PlaneSelection{point, normal}});
}

std::size_t SoftBody::apply(const Action& action) {
  const std::size_t made =
      body_->make_ready({.action = action, .from = time_, .until = time_, .every = {}, .path = ""})->apply();
  if (made == 0) return 0;
  for (const Added& added : added_)
    if (added.follow) added.follow(vertices());
  list_forces();
  restart();
  return made;
}

void SoftBody::add(std::unique_ptr<ForceTerm> force, std::function<void(const VertexColumns&)> follow) {
  added_.push_back({std::move(force), std::move(follow)});
  list_forces();
  restart();
}

void SoftBody::list_forces() {
  if (added_.empty()) return;
  const ForceTerms own = body_->system().terms;
  forces_.assign(own.begin(), own.end());
  for (const Added& added : added_) forces_.push_back(added.force.get());
}

std::optional<std::uint32_t> SoftBody::vertex_of(std::uint32_t point) const {
  const auto& points = vertices().point;
  const auto found = std::ranges::find(points, point);
  if (found == points.end()) return {};
  return static_cast<std::uint32_t>(found - points.begin());
}

const VertexColumns& SoftBody::vertices() const { return body_->vertices(); }
Motion SoftBody::motion() { return body_->motion(); }
SpringSystem SoftBody::system() const {
  SpringSystem system = body_->system();
  if (!added_.empty()) system.terms = forces_;
  return system;
}

Frame SoftBody::frame(const FrameFields& fields) const {
  Frame frame = body_->frame(fields);
  frame.time = time_;
  if (fields.held) frame.held = constraints_of(body_->vertices());
  put_in_order(frame, {});
  return frame;
}

void SoftBody::write(const std::filesystem::path& file, const FrameFields& fields) const {
  write_vtu(file, frame(fields));
}

}  // namespace dartboard
