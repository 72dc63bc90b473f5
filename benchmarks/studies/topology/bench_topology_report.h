#pragma once
// The report of `dartboard bench topology`: tables and claims.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/harness/claim.h"
#include "benchmarks/harness/paired.h"
#include "benchmarks/harness/table.h"

namespace dartboard {

/// The measured bytes and times.
struct TopologyFigures {
  std::map<std::string, std::map<std::string, double>> bytes;  // per tetrahedron, by body and contender
  std::vector<std::string> disagreements;
  bool all_bodies = true;  // else some were left out, and claims on all of them are not tested
  std::map<std::string, std::vector<Sample>> samples;  // by "BODY:FIGURE"
  std::map<std::string, double> units;                 // by "BODY:FIGURE:CONTENDER"

  /// Processor time per unit [ns], its interval over processes; nothing if it was not timed.
  std::optional<Figure> ns(const std::string& group, const std::string& contender) const {
    const auto unit = units.find(group + ":" + contender);
    if (unit == units.end()) return std::nullopt;
    Figure f = cpu_figure(samples.at(group), contender);
    for (double* value : {&f.median, &f.interval.low, &f.interval.high}) *value /= unit->second;
    return f;
  }
  /// Time per unit of `a` over that of `b`.
  /// pre  both were timed
  Figure ratio(const std::string& group, const std::string& a, const std::string& b) const {
    Figure f = paired_ratio(samples.at(group), a, b).cpu;
    const double scale = units.at(group + ":" + b) / units.at(group + ":" + a);
    f.median *= scale;
    f.interval.low *= scale;
    f.interval.high *= scale;
    return f;
  }
};

std::vector<Claim> claims_of(const TopologyFigures& figures);

Table figures_table(const TopologyFigures& figures);
Table scaling_table(const TopologyFigures& figures);
/// Other programs, measured once by others on another machine (a shared virtual one, +-30 %): context and no more.
Table peers_table();
/// The basis of the figures.
std::string figures_note();

}  // namespace dartboard
