#include "core/time/integrators.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

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

template <class T>
std::unique_ptr<Integrator> make_with(LinearSolver solver) {
  ImplicitOptions options = T().options();
  options.solver = solver;
  return std::make_unique<T>(options);
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
    IntegratorEntry{"backward-euler", make<BackwardEuler>, make_with<BackwardEuler>},
    IntegratorEntry{"baraff-witkin", make<BaraffWitkin>, make_with<BaraffWitkin>},
    IntegratorEntry{"local-global", make<LocalGlobal>},
    IntegratorEntry{"ros2", make<Ros2>, make_with<Ros2>},
    IntegratorEntry{"sdirk2", make<Sdirk2>, make_with<Sdirk2>},
    IntegratorEntry{"implicit-midpoint", make<ImplicitMidpoint>, make_with<ImplicitMidpoint>},
    IntegratorEntry{"energy-momentum", make<EnergyMomentum>, make_with<EnergyMomentum>},
    IntegratorEntry{"bdf2", make<Bdf2>, make_with<Bdf2>},
};

constexpr std::array solvers{
    SolverEntry{"kept-factor", LinearSolver::kept_factor},
    SolverEntry{"fresh-factor", LinearSolver::fresh_factor},
    SolverEntry{"conjugate-gradients", LinearSolver::conjugate_gradients},
};

template <class Entries>
std::string names_of(const Entries& entries) {
  std::string names;
  for (const auto& entry : entries) names += fmt::format("{}{}", names.empty() ? "" : ", ", entry.name);
  return names;
}

const IntegratorEntry& entry_of(std::string_view name) {
  for (const IntegratorEntry& entry : table)
    if (entry.name == name) return entry;
  throw InputError(fmt::format("there is no integrator '{}'; there are {}", name, names_of(table)));
}

}  // namespace

std::span<const IntegratorEntry> integrators() { return table; }

std::span<const SolverEntry> linear_solvers() { return solvers; }

std::unique_ptr<Integrator> make_integrator(std::string_view name) { return entry_of(name).make(); }

const Scheme& scheme_of(std::string_view name) { return make_integrator(name)->scheme(); }

std::unique_ptr<Integrator> make_integrator(std::string_view name, std::string_view solver) {
  const IntegratorEntry& entry = entry_of(name);
  if (solver.empty()) return entry.make();
  const auto found = std::ranges::find(solvers, solver, &SolverEntry::name);
  if (found == solvers.end())
    throw InputError(fmt::format("there is no linear solver '{}'; there are {}", solver, names_of(solvers)));
  if (entry.make_with == nullptr) {
    std::vector<IntegratorEntry> choosing(table.begin(), table.end());
    std::erase_if(choosing, [](const IntegratorEntry& e) { return e.make_with == nullptr; });
    throw InputError(fmt::format("{} has no linear solver to choose; {} have", name, names_of(choosing)));
  }
  return entry.make_with(found->solver);
}

}  // namespace dartboard
