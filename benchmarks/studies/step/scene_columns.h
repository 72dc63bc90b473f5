#pragma once
// The columns of a scene's body of springs, stepped in one manner.

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "core/mechanics/vertex_columns.h"
#include "core/plain/problem.h"
#include "core/time/explicit/classical_runge_kutta.h"
#include "core/time/system/spring_system.h"
#include "validation/contenders/contenders.h"

namespace dartboard {

/// Springs that a sample takes through a step, so that small bodies take as long as large ones.
inline constexpr std::size_t springs_in_sample = 150'000;
/// For bounds of rounding, which grow with the exponential of the number of steps.
inline constexpr int steps_compared = 4;

/// How the columns of a scene are stepped.
struct Manner {
  const char* task;
  bool lanes = true;
  unsigned threads = 1;
  bool padded = true;  // in rows of four numbers, where lanes are on
};

/// Can the processor take four springs at a time? They are on then.
bool has_lanes();
unsigned count_processors();

/// Lanes and threads as they were, whatever happens.
class MannerBefore {
 public:
  MannerBefore();
  MannerBefore(const MannerBefore&) = delete;
  MannerBefore& operator=(const MannerBefore&) = delete;
  ~MannerBefore();

 private:
  bool lanes_;
  unsigned threads_;
};

/// Several of these may share the columns, those of a `SimulatedBody` or of another class with `vertices` and `system`.
class SceneColumns : public ContenderBody {
 public:
  template <class Body>
  SceneColumns(std::shared_ptr<Body> body, double h, Manner manner)
      : vertices_([body]() -> VertexColumns& { return body->vertices(); }),
        system_([body] { return body->system(); }),
        integrator_(std::make_unique<ClassicalRungeKutta>(manner.padded)),
        h_(h),
        manner_(manner) {}

  void step(int n) override;
  /// The system has changed.
  void restart() { integrator_->restart(); }
  PointState state() const override;
  void set_state(const PointState& state) override;
  std::vector<Eigen::Vector3d> forces() override;
  /// From now on step in this manner; several threads are awake then.
  void choose() const;

 private:
  std::function<VertexColumns&()> vertices_;
  std::function<SpringSystem()> system_;
  std::unique_ptr<ClassicalRungeKutta> integrator_;
  double h_;
  Manner manner_;
};

}  // namespace dartboard
