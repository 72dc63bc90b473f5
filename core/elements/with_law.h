#pragma once
// From the materials of cells to their elastic laws.

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>
#include <cstddef>
#include <utility>
#include <variant>
#include <vector>

#include "core/elements/elastic_laws.h"
#include "core/plain/cell_materials.h"
#include "core/plain/error.h"
#include "core/plain/material.h"

namespace dartboard {

/// Calls f(law) with the law of a material of elements.
/// throws  InputError for a material of springs
template <class F>
auto with_law_of(const Material& material, F&& f) {
  const Lame lame = lame_of(material.young, material.poisson);
  switch (material.model) {
    case Model::neo_hookean: return std::forward<F>(f)(NeoHookean(lame));
    case Model::corotational: return std::forward<F>(f)(Corotational(lame));
    case Model::stvk: return std::forward<F>(f)(StVenantKirchhoff(lame));
    case Model::springs: break;
  }
  throw InputError("a material of springs has no elastic law; expected a model of elements");
}

/// The law of a cell of springs, in a body where other cells are elements.
struct NoLaw {
  double energy(const Eigen::Matrix3d&) const { return 0.0; }
  EnergyChange change(const Eigen::Matrix3d&, const Eigen::Matrix3d&) const { return {}; }
  Eigen::Matrix3d stress(const Eigen::Matrix3d&) const { return Eigen::Matrix3d::Zero(); }
  Hessian hessian(const Eigen::Matrix3d&, Compression) const { return Hessian::Zero(); }
  double modulus() const { return 0.0; }
};

/// The present volume of an element over that at rest. A cell of springs may be turned inside out without any effect.
template <class Law>
double volume_ratio(const Law&, const Eigen::Matrix3d& f) {
  return f.determinant();
}
inline double volume_ratio(const NoLaw&, const Eigen::Matrix3d& f) { return std::abs(f.determinant()); }

/// Any of these laws.
class AnyLaw {
 public:
  explicit AnyLaw(const Material& material) {
    if (material.model != Model::springs) with_law_of(material, [this](const auto& law) { law_ = law; });
  }

  double energy(const Eigen::Matrix3d& f) const {
    return std::visit([&](const auto& law) { return law.energy(f); }, law_);
  }
  EnergyChange change(const Eigen::Matrix3d& f, const Eigen::Matrix3d& d) const {
    return std::visit([&](const auto& law) { return law.change(f, d); }, law_);
  }
  Eigen::Matrix3d stress(const Eigen::Matrix3d& f) const {
    return std::visit([&](const auto& law) -> Eigen::Matrix3d { return law.stress(f); }, law_);
  }
  Hessian hessian(const Eigen::Matrix3d& f, Compression compression) const {
    return std::visit([&](const auto& law) -> Hessian { return law.hessian(f, compression); }, law_);
  }
  double modulus() const {
    return std::visit([](const auto& law) { return law.modulus(); }, law_);
  }
  const auto& law() const { return law_; }
  friend double volume_ratio(const AnyLaw& any, const Eigen::Matrix3d& f) {
    return std::visit([&](const auto& law) { return volume_ratio(law, f); }, any.law_);
  }

 private:
  std::variant<NoLaw, NeoHookean, Corotational, StVenantKirchhoff> law_;
};

/// The law of a cell's material and the volume of a kilogram [m^3/kg], in a homogeneous body.
template <class Law>
class OneLaw {
 public:
  OneLaw(const Law& law, double density) : law_(law), per_mass_(1.0 / density) {}
  const Law& operator[](std::size_t) const { return law_; }
  double per_mass(std::size_t) const { return per_mass_; }

 private:
  Law law_;
  double per_mass_;
};

/// The laws and the volumes of a kilogram by cell, in a body of several materials.
class LawOfCell {
 public:
  explicit LawOfCell(const CellMaterials& materials) : materials_(materials) {
    for (const Material& material : materials.all()) {
      laws_.emplace_back(material);
      per_mass_.push_back(1.0 / material.density);
    }
  }
  const AnyLaw& operator[](std::size_t cell) const { return laws_[materials_.number(cell)]; }
  double per_mass(std::size_t cell) const { return per_mass_[materials_.number(cell)]; }

 private:
  CellMaterials materials_;
  std::vector<AnyLaw> laws_;
  std::vector<double> per_mass_;
};

/// Calls f(laws) with the laws of a body's cells, by cell.
/// throws  InputError if all cells are springs
template <class F>
auto with_laws_of(const CellMaterials& materials, F&& f) {
  if (!materials.is_one()) return std::forward<F>(f)(LawOfCell(materials));
  const Material& one = materials[0];
  return with_law_of(one, [&](const auto& law) { return std::forward<F>(f)(OneLaw(law, one.density)); });
}

}  // namespace dartboard
