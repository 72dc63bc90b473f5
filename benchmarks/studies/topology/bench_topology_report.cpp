#include "benchmarks/studies/topology/bench_topology_report.h"

#include <fmt/format.h>

#include "benchmarks/studies/topology/topology_tasks.h"

namespace dartboard {
namespace {

/// A line of the table of targets: every body must keep to the bound, and where `faster` is not 0 be so much faster
/// than CGAL.
struct Target {
  std::string id, text;
  std::vector<std::string> figures;
  std::string unit;
  double ns_per_unit;  // that the figure is printed in
  double bound;        // in that unit; 0 for none
  double faster;
  const char* cause = "";  // why it falls short where it does
};
const std::vector<Target>& targets() {
  static const std::vector<Target> table{
      {"vertex-orbit",
       "vertex orbit",
       {"vertex-orbit"},
       "ns per dart",
       1.0,
       3.0,
       20.0,
       "a body of two thousand tetrahedra fits the caches in CGAL's map, too, so that no walk waits for memory"},
      {"full-check", "full validity check", {"full-check"}, "ns per dart", 1.0, 5.0, 20.0},
      {"local-check", "incremental check of an operation", {"local-check"}, "us per face", 1e3, 1.0, 0.0},
      {"build", "build from a mesh in memory", {"build"}, "us per tetrahedron", 1e3, 0.8, 0.0},
      {"unsew",
       "unsew a face and report what came apart",
       {"unsew-cut", "unsew-scattered"},
       "us per face",
       1e3,
       1.5,
       0.0},
      {"", "vertex to tetrahedra", {"vertex-to-tetrahedra"}, "us per vertex", 1e3, 0.0, 0.0},
      {"", "count all cells", {"count-cells"}, "ns per dart", 1.0, 0.0, 0.0},
  };
  return table;
}

std::string target_text(const Target& t) {
  if (t.bound == 0.0) return "-";
  return fmt::format("<= {:g} {}", t.bound, t.unit) + (t.faster > 0.0 ? fmt::format(", {:g}x CGAL", t.faster) : "");
}

struct Row {
  std::vector<std::string> cells;
  bool timed = false;
  Met met = Met::no;
};

Row row_of(const TopologyFigures& r, const Target& t, const std::string& figure, const std::string& body) {
  const std::string group = body + ":" + figure;
  const auto show = [&](const char* contender) {
    const auto ns = r.ns(group, contender);
    return ns ? fmt::format("{:.3g}", ns->median / t.ns_per_unit) : std::string("-");
  };
  Row row;
  const auto ns = r.ns(group, "tetrahedral");
  row.timed = ns && (t.faster == 0.0 || r.ns(group, "CGAL"));
  std::string ratio = "-", bare_ratio = "-";
  if (row.timed) row.met = t.bound == 0.0 ? Met::yes : at_most(*ns, t.bound * t.ns_per_unit);
  if (row.timed && r.ns(group, "CGAL")) {
    const Figure f = r.ratio(group, "CGAL", "tetrahedral");
    ratio = to_string(f);
    row.met = std::min(row.met, at_least(f, t.faster));
  }
  if (row.timed && r.ns(group, "bare CGAL"))
    bare_ratio = fmt::format("{:.3g}", r.ratio(group, "bare CGAL", "tetrahedral").median);
  const std::string verdict = t.bound == 0.0         ? "-"
                              : !row.timed           ? "not timed"
                              : row.met == Met::yes  ? "holds"
                              : row.met == Met::open ? "undecided"
                                                     : "falls short";
  const std::string which = t.figures.size() == 1 ? "" : figure == "unsew-cut" ? ", along a cut" : ", at random";
  row.cells = {t.text + which, body,  target_text(t),    show("general"), show("tetrahedral"),
               show("CGAL"),   ratio, show("bare CGAL"), bare_ratio,      verdict};
  return row;
}

/// Why a claim has no verdict.
std::string reason_not_timed(const TopologyFigures& r, const char* contender) {
  return r.all_bodies ? fmt::format("the {} do not find the same", contender)
                      : "a body was left out: run it without --only";
}

constexpr double memory_bound = 64.0, cut_bound = 1.5, scattered_bound = 3.0;
const std::string memory_target = fmt::format("<= {:g} bytes per tetrahedron", memory_bound);
const std::string &smallest = scaling_sizes.front(), &largest = scaling_sizes.back();

std::string scaling_group(bool cut) { return scaling + (cut ? ":unsew-cut" : ":unsew-scattered"); }

}  // namespace

Table figures_table(const TopologyFigures& r) {
  Table table({{"figure"},
               {"body"},
               {"target"},
               {"general", Align::right},
               {"tetrahedral", Align::right},
               {"CGAL", Align::right},
               {"its ratio to tetrahedral", Align::right},
               {"bare CGAL", Align::right},
               {"its ratio", Align::right},
               {"verdict"}});
  for (const auto& [body, bytes] : r.bytes)
    table.add_row({"memory, vertex and edge ids included", body, memory_target,
                   fmt::format("{:.4g}", bytes.at("general")), fmt::format("{:.4g}", bytes.at("tetrahedral")),
                   fmt::format("{:.4g}", bytes.at("CGAL")),
                   fmt::format("{:.3g}", bytes.at("CGAL") / bytes.at("tetrahedral")), "-", "-",
                   bytes.at("tetrahedral") <= memory_bound ? "holds" : "falls short"});
  for (const Target& t : targets())
    for (const std::string& figure : t.figures)
      for (const std::string& body : topology_bodies) table.add_row(row_of(r, t, figure, body).cells);
  return table;
}

Table scaling_table(const TopologyFigures& r) {
  Table table({{"unsew, tetrahedral map"},
               {"2,058 [us]", Align::right},
               {"48,000 [us]", Align::right},
               {"998,250 [us]", Align::right},
               {"largest / smallest", Align::right},
               {"target"}});
  for (const bool cut : {true, false}) {
    const std::string group = scaling_group(cut);
    std::vector<std::string> row{cut ? "along a cut" : "at random"};
    for (const std::string& n : scaling_sizes) {
      const auto ns = r.ns(group, n);
      row.push_back(ns ? fmt::format("{:.3g}", ns->median / 1e3) : "-");
    }
    row.push_back(r.ns(group, largest) ? to_string(r.ratio(group, largest, smallest)) : "-");
    row.push_back(fmt::format("<= {:g}", cut ? cut_bound : scattered_bound));
    table.add_row(row);
  }
  return table;
}

Table peers_table() {
  Table table({{"1,920 / 48,000 tetrahedra"},
               {"CGAL 5.5.1 g-map", Align::right},
               {"CGoGN_3", Align::right},
               {"OpenVolumeMesh", Align::right},
               {"tet-implicit probe", Align::right}});
  table.add_row({"memory [bytes per tetrahedron]", "1,830", "512", "416", "32"});
  table.add_row({"vertex orbit [ns per dart]", "48 / 95", "10 / 10", "-", "0.7-1.3"});
  table.add_row({"vertex to tetrahedra [us]", "19 / 22", "-", "0.65 / 1.75", "0.1"});
  table.add_row({"full validity [ns per dart]", "57-113 / 109-138", "none", "-", "0.6-0.7"});
  table.add_row({"count all cells [ns per dart]", "69-143 / 179-208", "-", "-", "29-63"});
  table.add_row({"unsew a face [us]", "10 / 51-72", "none", "none", "0.44 / 0.3"});
  table.add_row({"build [us per tetrahedron]", "2.0-3.3 / 3.3-3.7", "2.3 / 2.2", "5.8 / 5.9", "0.38 / 0.34"});
  return table;
}

std::string figures_note() {
  return "Figures are medians of processor time over processes; ratios are paired within rounds. Verdicts are for the "
         "tetrahedral storage and go by distribution-free intervals over processes. Before each run the map is put back and read "
         "through once, so that what fits the caches is there.\n"
         "\n"
         "CGAL's map carries what the memory counts for all, a number on each vertex and edge, and is_valid() checks "
         "those too; bare CGAL has no attributes, so it compares walks and conditions alone. CGAL's unsew renews the "
         "attributes of the cells that came apart, its only way to report them, while ours reports them, has written a "
         "journal and has checked the darts it touched. Not in the memory: a mark in use takes 4 bytes per dart of "
         "ours, 96 per tetrahedron, for each mark in use at once; CGAL's marks are in its darts.";
}

std::vector<Claim> claims_of(const TopologyFigures& r) {
  std::vector<Claim> claims;
  Claim memory = target("topology-memory", "memory of the tetrahedral storage with vertex and edge ids", memory_target);
  bool fits = true;
  for (const auto& [body, bytes] : r.bytes) {
    memory.measured += fmt::format("{}{:.4g}", memory.measured.empty() ? "" : " / ", bytes.at("tetrahedral"));
    fits = fits && bytes.at("tetrahedral") <= memory_bound;
  }
  if (r.bytes.size() == topology_bodies.size())
    judge(memory, met(fits));
  else
    memory.reason = reason_not_timed(r, "contenders");
  memory.bound_or_interval = "counted";
  claims.push_back(memory);

  for (const Target& t : targets()) {
    if (t.bound == 0.0) continue;
    Claim c = target("topology-" + t.id, t.text, target_text(t));
    bool timed = true;
    Met met = Met::yes;
    for (const std::string& figure : t.figures)
      for (const std::string& body : topology_bodies) {
        const Row row = row_of(r, t, figure, body);
        timed = timed && row.timed;
        met = std::min(met, row.met);
        c.measured += (c.measured.empty() ? "" : " / ") + row.cells[4];
        if (t.faster > 0.0)
          c.bound_or_interval +=
              fmt::format("{}{} (bare: {})", c.bound_or_interval.empty() ? "" : "; ", row.cells[6], row.cells[8]);
      }
    if (timed)
      judge(c, met, t.cause);
    else
      c.reason = reason_not_timed(r, "contenders");
    claims.push_back(c);
  }
  for (const bool cut : {true, false}) {
    const double bound = cut ? cut_bound : scattered_bound;
    Claim c = target(cut ? "topology-unsew-cut-scaling" : "topology-unsew-random-scaling",
                     std::string("time to unsew a face ") + (cut ? "along a cut" : "at random") +
                         ", of 998,250 tetrahedra over 2,058",
                     fmt::format("<= {:g}", bound));
    if (r.ns(scaling_group(cut), largest)) {
      const Figure f = r.ratio(scaling_group(cut), largest, smallest);
      c.measured = fmt::format("{:.3g}", f.median);
      c.bound_or_interval = to_string(f.interval);
      judge(c, at_most(f, bound));
    } else {
      c.reason = reason_not_timed(r, "storages");
    }
    claims.push_back(c);
  }
  return claims;
}

}  // namespace dartboard
