#include "benchmarks/studies/reproduce/real_time.h"

#include <fmt/format.h>

#include <cmath>

#include "benchmarks/harness/clock.h"
#include "benchmarks/harness/json_fields.h"
#include "benchmarks/harness/paired.h"
#include "benchmarks/paper/paper_claims.h"
#include "core/mechanics/adapt.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/operations/remove_volume.h"
#include "core/walks/cell_arrays.h"
#include "core/walks/runge_kutta_4.h"

namespace dartboard {
namespace {

constexpr double cells_of_paper = 1856.0;

/// A ball with the spacing and the material of the paper's body, so that the step stays as far from its limit.
Problem ball(int layers) {
  Problem problem;
  problem.mesh = tetrahedron_ball(layers, 0.01 * layers);
  problem.material = {.density = 1000.0, .stiffness = 5.0, .damping = 0.005, .viscosity = 0.5};
  return problem;
}

FrameTime time_frame(const Problem& problem, double h) {
  auto body = build_body<Map3, Held::by_every_dart>(problem);
  CellArrays arrays;
  arrays.rebuild(body);
  RungeKutta4 integrator;
  integrator.step(arrays, body, h);  // first touch of its memory
  const int steps = steps_of_frame(h);
  const auto start = thread_cpu_ns();
  adapt(body, remove_volume(body.map, body.cell_dart[0]));
  arrays.rebuild(body);
  for (int k = 0; k < steps; ++k) integrator.step(arrays, body, h);
  return {problem.mesh.cell_count(), static_cast<double>(thread_cpu_ns() - start) * 1e-9};
}

}  // namespace

DARTBOARD_JSON_FIELDS(FrameTime, cells, seconds)

int steps_of_frame(double h) { return static_cast<int>(std::ceil(frame_s / h)); }

double cells_in_real_time(std::span<const FrameTime> frames) {
  FrameTime before{0, 0.0};
  for (const FrameTime& frame : frames) {
    if (frame.seconds > frame_s) {
      const double share = (frame_s - before.seconds) / (frame.seconds - before.seconds);
      return static_cast<double>(before.cells) + share * static_cast<double>(frame.cells - before.cells);
    }
    before = frame;
  }
  return static_cast<double>(before.cells);
}

std::vector<FrameTime> time_frames(double h) {
  std::vector<FrameTime> frames;
  for (const int layers : {4, 6, 8, 10, 12, 14, 16, 18, 20}) {
    frames.push_back(time_frame(ball(layers), h));
    if (frames.back().seconds > frame_s) break;
  }
  return frames;
}

Claim answer_real_time(std::span<const std::vector<FrameTime>> rounds, bool quick) {
  std::vector<double> cells;
  for (const auto& frames : rounds) cells.push_back(cells_in_real_time(frames));
  const Figure figure = figure_of(cells);
  Claim claim =
      answered("real-time", at_least(figure, cells_of_paper),
               fmt::format("{:.0f} tetrahedra, a removal in each frame", figure.median), to_string(figure.interval));
  if (quick && claim.surprises()) {
    claim.verdict = Verdict::undecided;
    claim.reason = "a quick run is too short to contradict what is known: leave out --quick";
  }
  return claim;
}

Claim measure_real_time(double h, bool quick, StudyLog& log) {
  const std::vector<std::vector<FrameTime>> rounds = log.once("frames of bodies that grow", [h] {
    std::vector<std::vector<FrameTime>> timed;
    for (int round = 0; round < 7; ++round) timed.push_back(time_frames(h));
    return timed;
  });
  return answer_real_time(rounds, quick);
}

}  // namespace dartboard
