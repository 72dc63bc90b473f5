#include "benchmarks/studies/step/bench_step_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <span>
#include <utility>

namespace dartboard {
namespace {

// Shares of the time of the graph: a tenth above what prototypes of the kernel took.
constexpr double most_damped = 0.58, most_undamped = 0.50;
constexpr double most_shuffled = 0.25, most_in_order = 0.50, most_by_threads = 0.30;
// What two threads gain over one.
constexpr double least_gain_large = 1.8, least_gain_medium = 1.5;
constexpr std::size_t large = 1'000'000, medium = 100'000;

using namespace step_task;

bool by_threads(const char* task) {
  return std::string_view(task) == threads || std::string_view(task) == copy_by_threads;
}

/// The fastest way on one thread.
const char* best_alone(const StepCounts& counts) { return counts.lanes ? padded : one; }

void not_tested(Claim& claim, std::string reason) {
  claim.verdict = Verdict::not_tested;
  claim.reason = std::move(reason);
}

/// Why a body and its task were not timed.
std::string reason_without(const StepCosts& c, const std::string& body, const char* task) {
  if (!c.counts.contains(body)) return too_quick;
  return by_threads(task) ? "there is one processor" : "the processor does not take four springs at a time";
}

Claim claim_over_graph(const StepCosts& c, const char* id, const std::string& body, const char* task, double most) {
  Claim made = target(id,
                      fmt::format("{}: a step {} over one of the naive graph", body,
                                  by_threads(task) ? "by all processors" : "four springs at a time"),
                      fmt::format("<= {:g}", most));
  if (!c.timed(body, task)) {
    not_tested(made, reason_without(c, body, task));
    return made;
  }
  const Figure f = c.over(body, task, graph);
  made.measured = fmt::format("{:.3f}", f.median);
  made.bound_or_interval = to_string(f.interval);
  judge(
      made, at_most(f, most),
      "where a body does not fit the caches, a step takes the time of its bytes: the table of limits has how near it is "
      "to that");
  return made;
}

/// How much faster all processors are than one. Every body of the size must gain so much.
Claim claim_on_gain(const StepCosts& c, const char* id, std::size_t tetrahedra, double least) {
  Claim made = target(id, fmt::format("a step of {} tetrahedra on one processor over one on all", tetrahedra),
                      fmt::format(">= {:g}", least));
  Met met = Met::yes;
  std::string copied;
  for (const bool shuffled : {false, true}) {
    const std::string body = step_box(tetrahedra, shuffled);
    if (!c.timed(body, threads)) {
      not_tested(made, reason_without(c, body, threads));
      return made;
    }
    const Figure f = c.over(body, best_alone(c.counts.at(body)), threads);
    made.measured += fmt::format("{}{:.2f}", shuffled ? " / " : "", f.median);
    made.bound_or_interval += (shuffled ? " / " : "") + to_string(f.interval);
    copied += fmt::format("{}{:.2f}", shuffled ? " / " : "", c.over(body, copy, copy_by_threads).median);
    met = std::min(met, at_least(f, least));
  }
  judge(made, met,
        "all processors copy columns as large " + copied +
            " times as fast as one: they share the memory, and only "
            "fewer bytes would gain more");
  return made;
}

/// Bodies that several threads share; the others are stepped by the same loops as on one.
Claim claim_on_no_loss(const StepCosts& c) {
  Claim made = target("step-threads-no-loss", "bodies that all processors share are not stepped slower than on one",
                      ">= 1 for each");
  Met met = Met::yes;
  std::size_t bodies = 0;
  double least = INFINITY;
  for (const auto& [body, counts] : c.counts) {
    if (!c.timed(body, threads)) continue;
    const Figure f = c.over(body, best_alone(counts), threads);
    met = std::min(met, at_least(f, 1.0));
    ++bodies;
    if (!(f.median >= least)) {
      least = f.median;
      made.bound_or_interval = to_string(f.interval) + " for " + body;
    }
  }
  if (bodies == 0) {
    not_tested(made, "there is one processor, or no body is large enough for several");
    return made;
  }
  made.measured = fmt::format("{:.2f}, the least of {} bodies", least, bodies);
  judge(made, met);
  return made;
}

const char* name_of(const char* task) {
  const std::string_view of = task;
  return of == graph    ? "naive graph"
         : of == arrays ? "cell arrays"
         : of == one    ? "columns, one at a time"
         : of == lanes  ? "columns, four at a time"
         : of == padded ? "padded columns, four at a time"
                        : "padded columns, all processors";
}

}  // namespace

std::vector<std::string> StepCosts::bodies() const {
  std::vector<std::string> names = step_bodies(largest);
  names.insert(names.end(), meshes.begin(), meshes.end());
  std::erase_if(names, [this](const std::string& name) { return !counts.contains(name); });
  return names;
}

bool StepCosts::timed(const std::string& body, const char* task) const {
  return counts.contains(body) && std::ranges::count(samples, body + task, &Sample::task) > 0;
}

Figure StepCosts::over(const std::string& body, const char* task, const char* baseline) const {
  const Ratio ratio = paired_ratio(samples, body + task, body + baseline);
  return by_threads(task) || by_threads(baseline) ? ratio.wall : ratio.cpu;
}

double StepCosts::spring_ns(const std::string& body, const char* task) const {
  const StepCounts& n = counts.at(body);
  const Times times = times_of(samples, body + task);
  return (by_threads(task) ? times.wall_median : times.cpu_median) / (4.0 * n.steps * static_cast<double>(n.springs));
}

double StepCosts::in_core_ns(const std::string& body) const {
  return times_of(samples, body + roots).cpu_median / counts.at(body).roots;
}

double StepCosts::copied_per_second(const std::string& body, const char* task) const {
  const Times times = times_of(samples, body + task);
  return counts.at(body).copied_bytes / (by_threads(task) ? times.wall_median : times.cpu_median);
}

double StepCosts::bytes_of_spring(const std::string& body) const {
  return counts.at(body).bytes / static_cast<double>(counts.at(body).springs);
}

double StepCosts::bandwidth_ns(const std::string& body, const char* task) const {
  return bytes_of_spring(body) / copied_per_second(body, task);
}

std::size_t StepCosts::count_bodies_that_differ() const {
  std::size_t differing = 0;
  for (const auto& [body, n] : counts) {
    std::set<std::uint64_t> hashes;
    for (const char* task : {one, lanes, padded, threads})
      for (const std::uint64_t hash : hashes_of(samples, body + task)) hashes.insert(hash);
    differing += hashes.size() > 1 ? 1 : 0;
  }
  return differing;
}

std::vector<Claim> claims_of(const StepCosts& c) {
  std::size_t differing = c.count_bodies_that_differ();
  for (const auto& [body, n] : c.counts) differing += n.differing;
  Claim agreement = target("step-agreement",
                           "columns end in the same bits one and four at a time, padded or not, and by several "
                           "threads, and agree with the naive graph within the bound of rounding",
                           "0 differ");
  agreement.measured = fmt::format("{} differ", differing);
  agreement.bound_or_interval = fmt::format("of {} bodies", c.counts.size());
  judge(agreement, met(differing == 0 && !c.counts.empty()));
  std::vector<Claim> claims{
      agreement,
      claim_over_graph(c, "step-liver-damped", paper_step_body(true), padded, most_damped),
      claim_over_graph(c, "step-liver-undamped", paper_step_body(false), padded, most_undamped),
      claim_over_graph(c, "step-shuffled", step_box(large, true), padded, most_shuffled),
      claim_over_graph(c, "step-in-order", step_box(large, false), padded, most_in_order),
      claim_over_graph(c, "step-in-order-threads", step_box(large, false), threads, most_by_threads),
      claim_on_gain(c, "step-threads-large", large, least_gain_large),
      claim_on_gain(c, "step-threads-medium", medium, least_gain_medium),
      claim_on_no_loss(c)};
  if (claims.front().verdict == Verdict::falls_short)
    for (Claim& claim : std::span(claims).subspan(1))
      not_tested(claim, "the motions do not agree, so their times mean nothing");
  return claims;
}

Table steps_table(const StepCosts& c) {
  Table table({{"body"},
               {"tetrahedra", Align::right},
               {"springs", Align::right},
               {"stepped as"},
               {"ns per spring and evaluation", Align::right},
               {"over the graph", Align::right},
               {"interval", Align::right}});
  for (const std::string& body : c.bodies()) {
    const StepCounts& n = c.counts.at(body);
    for (const char* task : {graph, arrays, one, lanes, padded, threads}) {
      if (!c.timed(body, task)) continue;
      const Figure f = by_threads(task) || std::string_view(task) != graph ? c.over(body, task, graph) : Figure{};
      const bool baseline = std::string_view(task) == graph;
      table.add_row({body, std::to_string(n.tetrahedra), std::to_string(n.springs), name_of(task),
                     fmt::format("{:.2f}", c.spring_ns(body, task)), baseline ? "1" : fmt::format("{:.3f}", f.median),
                     baseline ? "" : to_string(f.interval)});
    }
  }
  return table;
}

Table limits_table(const StepCosts& c) {
  Table table({{"body"},
               {"processors"},
               {"bytes per spring", Align::right},
               {"copied GB/s", Align::right},
               {"ns by bandwidth", Align::right},
               {"ns by root and division", Align::right},
               {"ns taken", Align::right},
               {"over the larger limit", Align::right}});
  for (const std::string& body : c.bodies()) {
    const auto add = [&](const char* task, const char* copied, unsigned threads_used) {
      const double bandwidth = c.bandwidth_ns(body, copied), in_core = c.in_core_ns(body) / threads_used,
                   taken = c.spring_ns(body, task);
      table.add_row({body, std::to_string(threads_used), fmt::format("{:.0f}", c.bytes_of_spring(body)),
                     fmt::format("{:.1f}", c.copied_per_second(body, copied)), fmt::format("{:.2f}", bandwidth),
                     fmt::format("{:.2f}", in_core), fmt::format("{:.2f}", taken),
                     fmt::format("{:.2f}", taken / std::max(bandwidth, in_core))});
    };
    add(best_alone(c.counts.at(body)), copy, 1);
    if (c.timed(body, threads)) add(threads, copy_by_threads, c.counts.at(body).threads);
  }
  return table;
}

std::string step_costs_note(const StepCosts& costs) {
  const char* of_files =
      costs.meshes.empty()
          ? ""
          : "Meshes of files have each tetrahedron cut into eight until there are 10^5, in the order of the file. ";
  return fmt::format(
      "RK4: four evaluations a step, each of all springs and all vertices. Processor time, of several threads the "
      "wall clock's; tasks take turns within rounds, ratios are paired, intervals are over processes. A scene's "
      "columns are stored along a curve where its mesh is in no good order, the graph in the order of the mesh. {}"
      "Bytes are those that loops read and write, each column once for each loop; the bandwidth is that of copying "
      "columns as large as those of the body by as many threads. The other limit is the throughput of one square root "
      "and one division for each spring.",
      of_files);
}

Plot roofline_plot(const StepCosts& c) {
  Plot plot;
  plot.title = "RK4 over springs, and its limits";
  plot.subtitle = "boxes in grid order (filled) and shuffled";
  plot.x_axis = "springs";
  plot.y_axis = "ns per spring and evaluation";
  double low = INFINITY, high = 0.0, fewest = INFINITY, most = 0.0;
  const auto add = [&](PlotSeries series, bool shuffled, const auto& ns_of) {
    for (std::size_t size = 1'000; size <= c.largest; size *= 10) {
      const std::string body = step_box(size, shuffled);
      if (!c.counts.contains(body)) continue;
      const double ns = ns_of(body), springs = static_cast<double>(c.counts.at(body).springs);
      if (std::isnan(ns)) continue;
      series.points.push_back({springs, ns});
      low = std::min(low, ns);
      high = std::max(high, ns);
      fewest = std::min(fewest, springs);
      most = std::max(most, springs);
    }
    if (!series.points.empty()) plot.series.push_back(std::move(series));
  };
  add({.title = "limit: a square root and a division", .points = {}, .colour = "#404040", .symbol = 0, .width = 3.0},
      false, [&](const std::string& body) { return c.in_core_ns(body); });
  add({.title = "limit: bytes as one thread copies",
       .points = {},
       .colour = "#404040",
       .symbol = 0,
       .width = 3.0,
       .dash = "-"},
      false, [&](const std::string& body) { return c.bandwidth_ns(body); });
  const std::pair<const char*, const char*> shown[]{
      {graph, "#7f7f7f"}, {one, "#ff7f0e"}, {lanes, "#9467bd"}, {padded, "#1f77b4"}, {threads, "#2ca02c"}};
  for (const auto& [task, colour] : shown)
    for (const bool shuffled : {false, true})
      add({.title = shuffled ? "" : name_of(task),
           .points = {},
           .colour = colour,
           .symbol = shuffled ? 6 : 7,
           .size = 1.5,
           .width = 1.5,
           .dash = shuffled ? "." : ""},
          shuffled, [&, task = task](const std::string& body) {
            return c.timed(body, task) ? c.spring_ns(body, task) : std::nan("");
          });
  if (plot.series.empty()) return plot;
  plot.x_low = 0.6 * fewest;
  plot.x_high = 1.7 * most;
  plot.y_low = 0.6 * low;
  plot.y_high = 1.6 * high;
  return plot;
}

}  // namespace dartboard
