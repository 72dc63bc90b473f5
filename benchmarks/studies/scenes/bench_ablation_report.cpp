#include "benchmarks/studies/scenes/bench_ablation_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "benchmarks/studies/scenes/ablation_study.h"
#include "benchmarks/studies/scenes/output_tasks.h"

namespace dartboard {
namespace {

std::string percent(double ratio) { return fmt::format("{:+.2f} %", 100.0 * (ratio - 1.0)); }
std::string percent(const Interval& i) {
  return fmt::format("[{:+.2f}, {:+.2f}] at {:.1f} %", 100.0 * (i.low - 1.0), 100.0 * (i.high - 1.0),
                     100.0 * i.coverage);
}

}  // namespace

Table features_table(const AblationFigures& r) {
  Table table({{"feature"},
               {"switched"},
               {"bytes per tetrahedron", Align::right},
               {"us per step", Align::right},
               {"of a step", Align::right},
               {"interval", Align::right}});
  const auto rows = [&](const std::vector<AblationPair>& pairs, const char* switched) {
    for (const AblationPair& pair : pairs) {
      const Ratio ratio = paired_ratio(r.samples, pair.task, pair.baseline);
      table.add_row({pair.feature, switched,
                     fmt::format("{:+.1f}",
                                 r.bytes.at(pair.task).per_tetrahedron() - r.bytes.at(pair.baseline).per_tetrahedron()),
                     fmt::format("{:+.2f}", r.step_us(pair.task) - r.step_us(pair.baseline)), percent(ratio.cpu.median),
                     percent(ratio.cpu.interval)});
    }
  };
  rows(switched_on(), "on, from bare");
  rows(switched_off(), "off, from full");
  return table;
}

Table staircase_table(const AblationFigures& r) {
  Table table({{"not requested, or always there"},
               {"task"},
               {"over"},
               {"us per step", Align::right},
               {"of a step", Align::right},
               {"interval", Align::right}});
  for (const AblationPair& pair : staircase()) {
    const Ratio ratio = paired_ratio(r.samples, pair.task, pair.baseline);
    table.add_row({pair.feature, pair.task, pair.baseline, fmt::format("{:.2f}", r.step_us(pair.task)),
                   percent(ratio.cpu.median), percent(ratio.cpu.interval)});
  }
  return table;
}

Table output_table(const AblationFigures& r) {
  Table table({{"task"},
               {"ms of its thread", Align::right},
               {"over the integrator", Align::right},
               {"interval", Align::right},
               {"ms by the clock", Align::right},
               {"over the integrator", Align::right},
               {"interval", Align::right}});
  for (const std::string& task : {output_run, output_run_by_two, output_integrator, output_bytes}) {
    const Ratio ratio = paired_ratio(r.samples, task, output_integrator);
    const Times times = times_of(r.samples, task);
    table.add_row({task, fmt::format("{:.3g}", times.cpu_median / 1e6), fmt::format("{:.3f}", ratio.cpu.median),
                   to_string(ratio.cpu.interval), fmt::format("{:.3g}", times.wall_median / 1e6),
                   fmt::format("{:.3f}", ratio.wall.median), to_string(ratio.wall.interval)});
  }
  return table;
}

std::string features_note() {
  return "Each feature in a scene of the paper's body, undamped and at rest but for a spin where bare. Ratios are "
         "paired within rounds, intervals are over processes. The map and the watch on stress are those of events that "
         "never happen within the run: nothing but their presence is timed. Frames and diagnostics: every tenth step, "
         "in memory. Bytes are asked of the built objects: the elements of all containers at the start. On a map, "
         "frames are read off its darts; with it the full scene pays for that too.";
}

std::vector<Claim> claims_of(const AblationFigures& r) {
  std::vector<Claim> claims;
  const Ratio all = paired_ratio(r.samples, "simulation", "loop");
  claims.push_back(target("bare-scene-speed",
                          "a scene without topological events over the same integrator on plain arrays in a loop",
                          "<= 1.02", fmt::format("{:.4f}", all.cpu.median), to_string(all.cpu.interval),
                          at_most(all.cpu, 1.02), "the staircase shows where"));
  // memory held by a map, and columns of terms that are zero
  const AblationBytes bare = r.bytes.at("bare");
  claims.push_back(target("bare-scene-holds-no-dart",
                          "such a scene holds no dart, and no column of what it does not request", "0 bytes",
                          fmt::format("{} bytes", bare.not_asked_for), "exact", met(bare.not_asked_for == 0), ""));
  claims.push_back(target("unasked-damping-bytes", "damping that is not requested takes no byte", "0 bytes",
                          fmt::format("{} bytes for {} springs; {} where it is requested", bare.damping, bare.springs,
                                      r.bytes.at("bare + damping").damping),
                          "exact", met(bare.damping == 0), "springs hold it"));
  const std::map<std::string, std::string> ids{{"loop", "unasked-terms-time"},
                                               {"loop and detector", "detector-time"},
                                               {"watched loop", "speed-check-time"},
                                               {"simulation", "unasked-events-and-output-time"}};
  for (const AblationPair& pair : staircase()) {
    if (pair.task == "simulation" && pair.baseline == "loop") continue;
    const Ratio ratio = paired_ratio(r.samples, pair.task, pair.baseline);
    Claim claim = target(ids.at(pair.task), fmt::format("{}: time when not requested", pair.feature),
                         "<= 0.5 % of a step", percent(ratio.cpu.median), percent(ratio.cpu.interval),
                         at_most(ratio.cpu, 1.005), fmt::format("'{}' over '{}'", pair.task, pair.baseline));
    claim.verdict = verdict_on_time(ratio.cpu);
    if (claim.verdict == Verdict::undecided && claim.reason.empty())
      claim.reason = fmt::format("'{}' does less than '{}' and is slower: no lower bound", pair.baseline, pair.task);
    claims.push_back(std::move(claim));
  }
  const Figure output = paired_ratio(r.samples, output_run_by_two, output_integrator).wall;
  claims.push_back(
      target("output-liver-cut",
             fmt::format("{} over the same steps of its integrator alone, by the clock", output_run_by_two), "<= 1.5",
             fmt::format("{:.3f}", output.median), to_string(output.interval), at_most(output, 1.5),
             fmt::format("stresses of its frames, and their files; by one thread {:.3f}, their bytes alone, copied, "
                         "{:.3f} of the integrator",
                         paired_ratio(r.samples, output_run, output_integrator).wall.median,
                         paired_ratio(r.samples, output_bytes, output_integrator).wall.median)));
  return claims;
}

Plot ablation_plot(const AblationFigures& r) {
  Plot plot;
  plot.title = "What a feature costs: on from a bare scene, off from a full one";
  plot.subtitle = "interval over processes; bytes per tetrahedron";
  plot.x_axis = "time per step with it, over that without";
  PlotSeries on{.title = "on, from bare", .points = {}, .colour = "#1f77b4", .symbol = 7, .size = 1.4},
      off{.title = "off, from full", .points = {}, .colour = "#d62728", .symbol = 5, .size = 1.4};
  double low = 1.0, high = 1.0;
  const std::size_t count = switched_on().size();
  const auto add = [&](const std::vector<AblationPair>& pairs, PlotSeries& series, double aside) {
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const Ratio ratio = paired_ratio(r.samples, pairs[k].task, pairs[k].baseline);
      const double bytes =
          r.bytes.at(pairs[k].task).per_tetrahedron() - r.bytes.at(pairs[k].baseline).per_tetrahedron();
      const double y = static_cast<double>(count - k) + aside;
      const Interval& i = ratio.cpu.interval;
      series.points.push_back({ratio.cpu.median, y});
      plot.series.push_back({.title = "",
                             .points = {{i.low, y}, {i.high, y, bytes == 0.0 ? "" : fmt::format("{:+.1f} B", bytes)}},
                             .colour = series.colour,
                             .symbol = 0,
                             .width = 2.0});
      low = std::min(low, i.low);
      high = std::max(high, i.high);
    }
  };
  add(switched_on(), on, 0.12);
  add(switched_off(), off, -0.12);
  for (std::size_t k = count; k-- > 0;) plot.rows.push_back(switched_on()[k].feature);
  plot.series.push_back({.title = "",
                         .points = {{1.0, 0.5}, {1.0, static_cast<double>(count) + 0.5}},
                         .colour = "#404040",
                         .symbol = 0,
                         .width = 1.0});
  plot.series.push_back(std::move(on));
  plot.series.push_back(std::move(off));
  plot.x_low = 0.9 * low;
  plot.x_high = 1.3 * high;
  plot.y_low = 0.5;
  plot.y_high = static_cast<double>(count) + 0.5;
  return plot;
}

}  // namespace dartboard
