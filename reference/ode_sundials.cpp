#include <fmt/format.h>

#include "core/plain/error.h"
#include "reference/ode_codes.h"
#include "reference/ode_intervals.h"

#ifdef DARTBOARD_HAVE_SUNDIALS
#include <arkode/arkode_erkstep.h>
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <cmath>
#include <memory>
#endif

namespace dartboard::reference {

#ifndef DARTBOARD_HAVE_SUNDIALS

bool have_sundials() { return false; }

namespace {
CodeRun not_compiled_in(const char* code, const NetworkMotion& motion) {
  check(motion);
  return {code, {}, 0, 0.0, "SUNDIALS was not found when this was configured"};
}
}  // namespace

CodeRun run_cvode_adams(const NetworkMotion& motion, double, double) { return not_compiled_in("CVODE Adams", motion); }
CodeRun run_arkode_fehlberg(const NetworkMotion& motion, double, double) {
  return not_compiled_in("ARKODE Fehlberg 8(7)", motion);
}

#else

namespace {

static_assert(sizeof(realtype) == sizeof(double));

constexpr long most_steps = 100'000'000;

void require(int flag, const char* call) {
  if (flag < 0) throw SolverError(fmt::format("{} answers {}", call, flag));
}

// The common part of both solvers: a context, the state as one of SUNDIALS' vectors, tolerances, and the rates.
class Common {
 public:
  Common(const SpringNetwork& network, const std::vector<double>& y, double absolute) : rates_(network) {
    SUNContext context = nullptr;
    require(-std::abs(SUNContext_Create(nullptr, &context)), "SUNContext_Create");
    context_ = {context, [](SUNContext c) { SUNContext_Free(&c); }};
    state_ = vector(static_cast<sunindextype>(y.size()));
    absolute_ = vector(static_cast<sunindextype>(y.size()));
    std::copy(y.begin(), y.end(), N_VGetArrayPointer(state_.get()));

    std::vector<Eigen::Vector3d> x(network.point_count());
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = {y[3 * i], y[3 * i + 1], y[3 * i + 2]};
    const double rate = fastest_rate(network, x), edge = mean_rest_length(network);
    double* tolerance = N_VGetArrayPointer(absolute_.get());
    for (std::size_t k = 0; k < y.size(); ++k)
      tolerance[k] = absolute * edge * (k < y.size() / 2 || rate == 0.0 ? 1.0 : rate);
  }

  static int evaluate(realtype, N_Vector y, N_Vector rate, void* self) {
    auto& common = *static_cast<Common*>(self);
    ++common.count_;
    common.rates_(N_VGetArrayPointer(y), N_VGetArrayPointer(rate));
    return 0;
  }

  // Errors are returned as codes and end in an exception; they are not printed.
  static void silent(int, const char*, const char*, char*, void*) {}

  SUNContext context() { return context_.get(); }
  N_Vector state() { return state_.get(); }
  N_Vector absolute() { return absolute_.get(); }
  std::uint64_t count() const { return count_; }
  void copy_state(std::vector<double>& y) const {
    const double* data = N_VGetArrayPointer(state_.get());
    std::copy(data, data + y.size(), y.begin());
  }

 private:
  using Vector = std::unique_ptr<_generic_N_Vector, void (*)(N_Vector)>;
  Vector vector(sunindextype n) { return {N_VNew_Serial(n, context_.get()), N_VDestroy}; }

  std::unique_ptr<_SUNContext, void (*)(SUNContext)> context_{nullptr, nullptr};
  Vector state_{nullptr, nullptr}, absolute_{nullptr, nullptr};
  NetworkRates<double> rates_;
  std::uint64_t count_ = 0;
};

class CvodeSolver {
 public:
  CvodeSolver(const SpringNetwork& network, const std::vector<double>& y, double t, double relative, double absolute)
      : common_(std::make_unique<Common>(network, y, absolute)),
        memory_(CVodeCreate(CV_ADAMS, common_->context()), [](void* m) { CVodeFree(&m); }),
        fixed_point_(SUNNonlinSol_FixedPoint(common_->state(), 0, common_->context()),
                     [](SUNNonlinearSolver s) { SUNNonlinSolFree(s); }) {
    void* m = memory_.get();
    require(CVodeSetErrHandlerFn(m, Common::silent, nullptr), "CVodeSetErrHandlerFn");
    require(CVodeInit(m, Common::evaluate, t, common_->state()), "CVodeInit");
    require(CVodeSetUserData(m, common_.get()), "CVodeSetUserData");
    require(CVodeSVtolerances(m, relative, common_->absolute()), "CVodeSVtolerances");
    require(CVodeSetNonlinearSolver(m, fixed_point_.get()), "CVodeSetNonlinearSolver");
    require(CVodeSetMaxNumSteps(m, most_steps), "CVodeSetMaxNumSteps");
  }
  void advance(std::vector<double>& y, double, double end) {
    realtype t = 0.0;
    require(CVodeSetStopTime(memory_.get(), end), "CVodeSetStopTime");
    require(CVode(memory_.get(), end, common_->state(), &t, CV_NORMAL), "CVode");
    common_->copy_state(y);
  }
  std::uint64_t evaluations() const { return common_->count(); }

 private:
  std::unique_ptr<Common> common_;
  std::unique_ptr<void, void (*)(void*)> memory_;
  std::unique_ptr<_generic_SUNNonlinearSolver, void (*)(SUNNonlinearSolver)> fixed_point_;
};

class ArkodeSolver {
 public:
  ArkodeSolver(const SpringNetwork& network, const std::vector<double>& y, double t, double relative, double absolute)
      : common_(std::make_unique<Common>(network, y, absolute)),
        memory_(ERKStepCreate(Common::evaluate, t, common_->state(), common_->context()),
                [](void* m) { ERKStepFree(&m); }) {
    void* m = memory_.get();
    if (m == nullptr) throw SolverError("ERKStepCreate fails");
    require(ERKStepSetErrHandlerFn(m, Common::silent, nullptr), "ERKStepSetErrHandlerFn");
    require(ERKStepSetUserData(m, common_.get()), "ERKStepSetUserData");
    require(ERKStepSVtolerances(m, relative, common_->absolute()), "ERKStepSVtolerances");
    require(ERKStepSetTableNum(m, ARKODE_FEHLBERG_13_7_8), "ERKStepSetTableNum");
    require(ERKStepSetMaxNumSteps(m, most_steps), "ERKStepSetMaxNumSteps");
  }
  void advance(std::vector<double>& y, double, double end) {
    realtype t = 0.0;
    require(ERKStepSetStopTime(memory_.get(), end), "ERKStepSetStopTime");
    require(ERKStepEvolve(memory_.get(), end, common_->state(), &t, ARK_NORMAL), "ERKStepEvolve");
    common_->copy_state(y);
  }
  std::uint64_t evaluations() const { return common_->count(); }

 private:
  std::unique_ptr<Common> common_;
  std::unique_ptr<void, void (*)(void*)> memory_;
};

template <class Solver>
CodeRun run(std::string code, const NetworkMotion& motion, double relative, double absolute) {
  check(motion);
  if (!(relative > 0.0) || !(absolute > 0.0)) throw InputError("the tolerance must be positive");
  CodeRun run{fmt::format("{}, tolerance {:.0e}", code, relative), {}, 0, 0.0, ""};
  try {
    run_intervals<double>(motion, centre_of(motion.start), run,
                          [relative, absolute](const SpringNetwork& network, const std::vector<double>& y, double t) {
                            return Solver(network, y, t, relative, absolute);
                          });
  } catch (const SolverError& error) {
    run.states.clear();
    run.failure = error.what();
  }
  return run;
}

}  // namespace

bool have_sundials() { return true; }

CodeRun run_cvode_adams(const NetworkMotion& motion, double relative, double absolute) {
  return run<CvodeSolver>("CVODE Adams", motion, relative, absolute);
}
CodeRun run_arkode_fehlberg(const NetworkMotion& motion, double relative, double absolute) {
  return run<ArkodeSolver>("ARKODE Fehlberg 8(7)", motion, relative, absolute);
}

#endif

}  // namespace dartboard::reference
