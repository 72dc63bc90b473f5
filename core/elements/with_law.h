#pragma once
// From a material to its elastic law.

#include <utility>

#include "core/elements/elastic_laws.h"
#include "core/plain/error.h"
#include "core/plain/material.h"

namespace dartboard {

/// f(law) of a material of elements.
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

}  // namespace dartboard
