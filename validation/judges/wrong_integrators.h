#pragma once
// Integrators that are wrong on purpose: every judge of integrators has to notice them.

#include <memory>
#include <span>
#include <string_view>

#include "core/time/integrators.h"

namespace dartboard {

enum class Wrong : std::uint8_t {
  does_nothing,       // returns at once
  half_the_force,     // of springs, dampers and gravity
  wrong_sign,         // of the springs
  one_order_less,     // the error of a step is larger by a factor of 1 / (h omega)
  loses_damping,      // of dampers and viscosity
  as_if_unstretched,  // springs pull as their linearisation about the rest length does
  drifts,             // positions by a millionth of themselves in each step
};

struct WrongIntegrator {
  Wrong kind;
  std::string_view name, what;
};
/// All of them.
std::span<const WrongIntegrator> wrong_integrators();

/// An integrator of this name, wrong in this way.
///
/// throws  InputError as make_integrator does
std::unique_ptr<Integrator> make_wrong(Wrong kind, std::string_view integrator);

/// An entry for the table of integrators, for studies that iterate over it.
IntegratorEntry wrong_entry(Wrong kind, std::string_view integrator);

}  // namespace dartboard
