#include "validation/tradeoff/cvode_adams.h"

#include "core/plain/error.h"
#include "core/time/method/trial_state.h"

#ifdef DARTBOARD_HAVE_SUNDIALS
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <cstring>
#endif

namespace dartboard {
namespace {
const Scheme cvode_adams{.name = "cvode-adams",
                         .what = "SUNDIALS CVODE, Adams methods of orders 1 to 12, on the same forces",
                         .order = 12,
                         .stages = 1,
                         .one_step = false,
                         .source = "Hindmarsh et al., ACM TOMS 31 (2005)"};
}

#ifndef DARTBOARD_HAVE_SUNDIALS

struct CvodeAdams::Implementation {};
bool CvodeAdams::available() { return false; }
StepResult CvodeAdams::advance(const SpringSystem&, Motion, double, const Tolerance&) {
  throw InputError("SUNDIALS was not found when this was configured");
}
void CvodeAdams::restart() {}

#else

static_assert(sizeof(realtype) == sizeof(double) && sizeof(Eigen::Vector3d) == 3 * sizeof(double));

struct CvodeAdams::Implementation {
  const SpringSystem* system = nullptr;
  Terms terms;
  std::uint64_t evaluations = 0;
  double t = 0.0;
  // in this order: the context is freed last
  std::unique_ptr<_SUNContext, void (*)(SUNContext)> context{nullptr, [](SUNContext c) { SUNContext_Free(&c); }};
  std::unique_ptr<_generic_N_Vector, void (*)(N_Vector)> y{nullptr, N_VDestroy}, absolute{nullptr, N_VDestroy};
  std::unique_ptr<_generic_SUNNonlinearSolver, void (*)(SUNNonlinearSolver)> solver{
      nullptr, [](SUNNonlinearSolver s) { SUNNonlinSolFree(s); }};
  std::unique_ptr<void, void (*)(void*)> memory{nullptr, [](void* m) { CVodeFree(&m); }};

  static void require(int flag, const char* call) {
    if (flag < 0) throw SolverError(std::string(call) + " fails");
  }
  static int rates(realtype, N_Vector y, N_Vector rate, void* self) {
    auto& me = *static_cast<Implementation*>(self);
    ++me.evaluations;
    const std::size_t n = me.system->vertex_count();
    const auto* x = reinterpret_cast<const Eigen::Vector3d*>(N_VGetArrayPointer(y));
    auto* dx = reinterpret_cast<Eigen::Vector3d*>(N_VGetArrayPointer(rate));
    std::memcpy(N_VGetArrayPointer(rate), N_VGetArrayPointer(y) + 3 * n, 3 * n * sizeof(double));
    accelerations(*me.system, me.terms, {x, n}, {x + n, n}, {dx + n, n});
    return 0;
  }

  void begin(const SpringSystem& s, Motion motion, const Tolerance& tolerance) {
    SUNContext made = nullptr;
    if (SUNContext_Create(nullptr, &made) != 0) throw SolverError("SUNContext_Create fails");
    // objects of the old context are freed before it
    solver.reset();
    absolute.reset();
    y.reset();
    context.reset(made);
    terms = terms_of(s);
    const auto n = static_cast<sunindextype>(3 * motion.x.size());
    y.reset(N_VNew_Serial(2 * n, context.get()));
    absolute.reset(N_VNew_Serial(2 * n, context.get()));
    std::ranges::copy(motion.x, reinterpret_cast<Eigen::Vector3d*>(N_VGetArrayPointer(y.get())));
    std::ranges::copy(motion.v, reinterpret_cast<Eigen::Vector3d*>(N_VGetArrayPointer(y.get()) + n));
    std::fill_n(N_VGetArrayPointer(absolute.get()), n, tolerance.position);
    std::fill_n(N_VGetArrayPointer(absolute.get()) + n, n, tolerance.velocity);
    memory.reset(CVodeCreate(CV_ADAMS, context.get()));
    void* m = memory.get();
    require(CVodeSetErrHandlerFn(
                m, [](int, const char*, const char*, char*, void*) {}, nullptr),
            "CVodeSetErrHandlerFn");
    require(CVodeInit(m, rates, 0.0, y.get()), "CVodeInit");
    t = 0.0;
    require(CVodeSetUserData(m, this), "CVodeSetUserData");
    require(CVodeSVtolerances(m, 0.0, absolute.get()), "CVodeSVtolerances");
    solver.reset(SUNNonlinSol_FixedPoint(y.get(), 0, context.get()));
    require(CVodeSetNonlinearSolver(m, solver.get()), "CVodeSetNonlinearSolver");
    require(CVodeSetMaxNumSteps(m, 100'000'000), "CVodeSetMaxNumSteps");
  }
};

bool CvodeAdams::available() { return true; }

void CvodeAdams::restart() { implementation_->memory.reset(); }

StepResult CvodeAdams::advance(const SpringSystem& system, Motion motion, double duration, const Tolerance& tolerance) {
  if (motion.x.empty()) return {};  // all cells have been removed
  Implementation& me = *implementation_;
  me.system = &system;
  if (!me.memory) me.begin(system, motion, tolerance);
  long before = 0, after = 0;
  CVodeGetNumSteps(me.memory.get(), &before);
  me.evaluations = 0;
  const double end = me.t + duration;
  Implementation::require(CVodeSetStopTime(me.memory.get(), end), "CVodeSetStopTime");
  realtype reached = 0.0;
  const int flag = CVode(me.memory.get(), end, me.y.get(), &reached, CV_NORMAL);
  me.t = end;
  CVodeGetNumSteps(me.memory.get(), &after);
  work_.steps += static_cast<std::uint64_t>(after - before);
  work_.force_evaluations += me.evaluations;
  if (flag < 0) {
    ++work_.failed_steps;
    StepResult failed;
    failed.code = StepCode::step_underflow;
    failed.quantity = "CVODE's answer";
    failed.value = flag;
    return failed;
  }
  const std::size_t n = motion.x.size();
  const double* y = N_VGetArrayPointer(me.y.get());
  std::copy_n(reinterpret_cast<const Eigen::Vector3d*>(y), n, motion.x.begin());
  std::copy_n(reinterpret_cast<const Eigen::Vector3d*>(y) + n, n, motion.v.begin());
  return check_finite(motion.x, motion.v);
}

#endif

CvodeAdams::CvodeAdams() : implementation_(std::make_unique<Implementation>()) {}
CvodeAdams::~CvodeAdams() = default;
const Scheme& CvodeAdams::scheme() const { return cvode_adams; }
StepResult CvodeAdams::step(const SpringSystem&, Motion, double) { throw InputError("cvode-adams has no fixed steps"); }

}  // namespace dartboard
