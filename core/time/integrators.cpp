#include "core/time/integrators.h"

#include <fmt/format.h>

#include <array>
#include <string>

#include "core/plain/error.h"
#include "core/time/explicit/blanes_moan_4.h"
#include "core/time/explicit/classical_runge_kutta.h"
#include "core/time/explicit/compensated_splitting.h"
#include "core/time/explicit/dormand_prince_54.h"
#include "core/time/explicit/explicit_euler.h"
#include "core/time/explicit/symplectic_euler.h"
#include "core/time/explicit/verlet.h"
#include "core/time/implicit/baraff_witkin.h"
#include "core/time/implicit/bdf2.h"
#include "core/time/implicit/one_stage.h"
#include "core/time/implicit/ros2.h"
#include "core/time/implicit/sdirk2.h"

namespace dartboard {
namespace {

template <class T>
std::unique_ptr<Integrator> make() {
  return std::make_unique<T>();
}

constexpr std::array table{
    IntegratorEntry{"explicit-euler", make<ExplicitEuler>},
    IntegratorEntry{"symplectic-euler", make<SymplecticEuler>},
    IntegratorEntry{"verlet", make<Verlet>},
    IntegratorEntry{"verlet-compensated", make_compensated_verlet},
    IntegratorEntry{"blanes-moan-4", make<BlanesMoan4>},
    IntegratorEntry{"blanes-moan-4-compensated", make_compensated_blanes_moan_4},
    IntegratorEntry{"rk4", make<ClassicalRungeKutta>},
    IntegratorEntry{"dormand-prince-54", make<DormandPrince54>},
    IntegratorEntry{"backward-euler", make<BackwardEuler>},
    IntegratorEntry{"baraff-witkin", make<BaraffWitkin>},
    IntegratorEntry{"local-global", make<LocalGlobal>},
    IntegratorEntry{"ros2", make<Ros2>},
    IntegratorEntry{"sdirk2", make<Sdirk2>},
    IntegratorEntry{"implicit-midpoint", make<ImplicitMidpoint>},
    IntegratorEntry{"energy-momentum", make<EnergyMomentum>},
    IntegratorEntry{"bdf2", make<Bdf2>},
};

}  // namespace

std::span<const IntegratorEntry> integrators() { return table; }

std::unique_ptr<Integrator> make_integrator(std::string_view name) {
  std::string known;
  for (const IntegratorEntry& entry : table) {
    if (entry.name == name) return entry.make();
    known += fmt::format("{}{}", known.empty() ? "" : ", ", entry.name);
  }
  throw InputError(fmt::format("there is no integrator '{}'; there are {}", name, known));
}

}  // namespace dartboard
