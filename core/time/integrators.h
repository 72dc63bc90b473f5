#pragma once
// Every time integrator there is, by name.

#include <memory>
#include <span>
#include <string_view>

#include "core/time/method/integrator.h"

namespace dartboard {

struct IntegratorEntry {
  std::string_view name;  // that of its scheme
  std::unique_ptr<Integrator> (*make)();
};

/// From the simplest to the most elaborate.
std::span<const IntegratorEntry> integrators();

/// throws  InputError for a name that is not in the table; the message lists those that are
std::unique_ptr<Integrator> make_integrator(std::string_view name);

}  // namespace dartboard
