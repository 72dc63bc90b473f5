#include "core/scene/body/frame_columns.h"

#include <cmath>
#include <limits>

namespace dartboard {
namespace {

double or_infinity(double x) { return std::isfinite(x) ? x : std::numeric_limits<double>::infinity(); }

}  // namespace

void fill_columns(Frame& frame, const FrameFields& fields, const VertexColumns& vertices, const SpringSystem& system,
                  const RestVolumes& volumes) {
  const auto& ends = system.ends;
  const SpringSpan& springs = system.springs;
  const auto& x = vertices.position;
  frame.fields = fields;
  frame.mesh.points = x;
  frame.velocity = vertices.velocity;
  frame.mass = vertices.mass;
  const bool is_chain = !frame.links.empty();
  if (fields.displacement)
    for (std::size_t k = 0; k < x.size(); ++k) frame.displacement.push_back(x[k] - vertices.rest[k]);
  if (fields.stress && !is_chain) {
    std::vector<Eigen::Matrix3d> stress;
    vertex_stresses(ends, springs, volumes, x, stress, system.terms);
    for (const Eigen::Matrix3d& sigma : stress) {
      const StressMeasures measures = measures_of(sigma);
      frame.largest_principal_stress.push_back(measures.largest_principal);
      frame.largest_stress_magnitude.push_back(measures.largest_magnitude);
      frame.von_mises_stress.push_back(measures.von_mises);
    }
  }
  if (fields.springs && !is_chain) frame.springs.assign(ends.begin(), ends.end());
  const bool has_tensions = fields.stress && is_chain;
  if (!has_tensions && !fields.springs) return;
  for (std::size_t k = 0; k < springs.size(); ++k) {
    const Spring spring = springs[k];
    const double stretch = (x[ends[k][1]] - x[ends[k][0]]).norm() - spring.rest_length;
    if (has_tensions) frame.tension.push_back(or_infinity(spring.stiffness * stretch));
    if (fields.springs) frame.strain.push_back(or_infinity(stretch / spring.rest_length));
  }
}

void fill_contact(Frame& frame, const ObstacleContact* obstacles, const BodyContact* bodies) {
  const auto& x = frame.mesh.points;
  frame.contact_force.assign(x.size(), Eigen::Vector3d(0, 0, 0));
  frame.contact_depth.assign(x.size(), 0.0);
  if (obstacles != nullptr) {
    obstacles->add_forces({.x = x}, frame.contact_force);
    obstacles->vertex_depths(x, frame.contact_depth);
  }
  if (bodies == nullptr) return;
  bodies->add_forces({.x = x}, frame.contact_force);
  bodies->raise_vertex_depths(x, frame.contact_depth);
}

}  // namespace dartboard
