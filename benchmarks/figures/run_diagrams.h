#pragma once
// The diagnostics and the probes of a run as curves over time.

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/scene/body/diagnostics.h"
#include "core/scene/file/scene_file.h"
#include "core/scene/run/probes.h"
#include "core/scene/run/scene_run.h"

namespace dartboard {

struct RunCurve {
  std::string name;
  std::vector<double> values{};  // by time; not finite where there is none
  bool is_part = false;          // of a sum: drawn as an area on those before it
};

struct RunDiagram {
  std::string title, unit{}, note{};
  std::vector<double> times{};  // [s]
  std::vector<RunCurve> curves{};
};

/// The account of energy, of which the parts are stacked; momentum, contact, stresses, counts of cells that change; the
/// displacement of each probe that is there at the start.
///
/// A potential has no zero of its own: it counts from its lowest value.
std::vector<RunDiagram> diagrams_of(std::span<const Diagnostics> rows, std::span<const ProbeRow> probes,
                                    const SceneFile& scene, int dimension);

/// The rows of diagnostics.csv and of probes.csv.
class RowsOfRun : public RunWatcher {
 public:
  void diagnostics(const Diagnostics& row) override { rows_.push_back(row); }
  void probes(const ProbeRow& row) override { probes_.push_back(row); }
  /// With rows between the start and the end there is something to draw.
  bool are_curves() const { return rows_.size() > 2; }
  std::vector<RunDiagram> diagrams(const SceneFile& scene, int dimension) const {
    return diagrams_of(rows_, probes_, scene, dimension);
  }

 private:
  std::vector<Diagnostics> rows_;
  std::vector<ProbeRow> probes_;
};

/// Draw them side by side; `name`.png, `name`.svg, and the data and script they are drawn from.
///
/// returns a sentence on what went wrong, as `draw` does
/// throws  IoError when the files cannot be written
std::string draw_diagrams(std::span<const RunDiagram> diagrams, const std::string& title,
                          const std::filesystem::path& folder, const std::string& name,
                          const std::string& gnuplot = "gnuplot");

}  // namespace dartboard
