#include <fmt/format.h>

#include "core/scene/file/keys/scene_value.h"
#include "core/scene/file/read_parts.h"

namespace dartboard {
namespace {

/// Elements have a Young's modulus and a Poisson's ratio; springs have no 'poisson', their ratio is fixed.
Model read_model(const SceneValue& material) {
  const bool has_ratio = material.has("poisson");
  Model model = has_ratio ? Model::neo_hookean : Model::springs;
  if (material.has("model")) model = material.at("model").one_of<Model>(model_names);
  if (model == Model::springs && has_ratio)
    material.fail_at("poisson",
                     "cannot be combined with the model \"springs\", which have a ratio of 1/4, or 1/3 in a surface",
                     "another model, or no 'poisson'");
  if (model != Model::springs && !has_ratio)
    material.fail_at("model", "is " + material.at("model").shown() + " without 'poisson'",
                     "'young' and 'poisson' together with it");
  if (model != Model::springs && !material.has("young"))
    material.fail_at("poisson", "is given without 'young'", "Young's modulus together with it");
  return model;
}

double read_damping_time(const SceneValue& damping, Model model) {
  if (model == Model::springs)
    damping.fail("is " + damping.shown() + " without 'poisson'", "a number of N s/m of each spring, or elements");
  constexpr double longest = 1e9;  // [s]: a relaxation longer than any run is a mistake in a unit
  const double time = damping_time_of(damping.get<double>("ratio"), damping.get<double>("frequency"));
  if (!(time <= longest))
    damping.fail(fmt::format("has a ratio / (pi frequency) of {:.3g} s", time),
                 fmt::format("at most {:.0e} s", longest));
  return time;
}

}  // namespace

Material read_material(const SceneValue& value) {
  const SceneValue damping = value.at("damping");
  Material material{.density = value.get<double>("density"),
                    .stiffness = value.get<double>("stiffness"),
                    .damping = damping.json().is_number() ? damping.as<double>() : 0.0,
                    .viscosity = value.find<double>("viscosity").value_or(0.0),
                    .young = value.find<double>("young").value_or(0.0),
                    .poisson = value.find<double>("poisson").value_or(Material{}.poisson),
                    .model = read_model(value),
                    .width = value.find<double>("width").value_or(0.0)};
  if (material.model != Model::springs) material.stiffness = material.damping = 0.0;
  if (damping.json().is_object()) material.damping_time = read_damping_time(damping, material.model);
  return material;
}

}  // namespace dartboard
