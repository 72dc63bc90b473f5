#pragma once
// The matrix of extremes while it is being filled, axis by axis.

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/time/integrators.h"
#include "validation/extremes/extreme_run.h"

namespace dartboard {

using SetupMaker = std::function<ExtremeSetup(std::string_view scene)>;

/// Collects the runs of one axis: a value times scenes times all integrators. A quick one takes every third value.
class ExtremeMatrix {
 public:
  ExtremeMatrix(std::string_view axis, bool quick) : axis_(axis), quick_(quick) {}

  /// The setup of one value.
  struct Row {
    std::string value;
    SetupMaker make;
  };

  void add(const std::string& value, std::span<const std::string_view> scenes, const SetupMaker& make) {
    if (quick_ && count_++ % 3 != 0) return;
    rows_.push_back({value, make});
    for (const std::string_view scene : scenes)
      for (const IntegratorEntry& entry : integrators()) {
        ExtremeCase which{axis_, std::string(scene), std::string(entry.name), value, {}};
        which.make_run = [which, make](const MakeIntegrator& integrator) {
          return run_extreme(which, make(which.scene), integrator);
        };
        cases_.push_back(std::move(which));
      }
  }
  void add_run(const std::string& value, std::string_view scene,
               const std::function<ExtremeCell(const ExtremeCase&, const MakeIntegrator&)>& run_it) {
    if (quick_ && count_++ % 3 != 0) return;
    for (const IntegratorEntry& entry : integrators()) {
      ExtremeCase which{axis_, std::string(scene), std::string(entry.name), value, {}};
      which.make_run = [which, run_it](const MakeIntegrator& make) { return run_it(which, make); };
      cases_.push_back(std::move(which));
    }
  }
  std::vector<ExtremeCase> take() { return std::move(cases_); }
  /// The rows that were added with a maker of setups, in this order.
  const std::vector<Row>& rows() const { return rows_; }

 private:
  std::string axis_;
  bool quick_;
  std::size_t count_ = 0;
  std::vector<ExtremeCase> cases_;
  std::vector<Row> rows_;
};

inline constexpr std::string_view extreme_solids[]{"box", "sheet"};

// One function per family of axes; each checks the name itself where it serves several.
void add_numbers(ExtremeMatrix& matrix, std::string_view axis);
void add_shapes(ExtremeMatrix& matrix);
void add_vertices(ExtremeMatrix& matrix);
void add_denormals(ExtremeMatrix& matrix);
void add_bad_numbers(ExtremeMatrix& matrix, bool injected);
void add_events(ExtremeMatrix& matrix);
void add_elements(ExtremeMatrix& matrix);
void add_regions(ExtremeMatrix& matrix);

}  // namespace dartboard
