#pragma once
// `dartboard validate elements`: what does each model of a body cost, in truth and in time?

#include <functional>
#include <string>
#include <vector>

#include "benchmarks/report/report.h"
#include "benchmarks/report/study_log.h"
#include "benchmarks/studies/elements/element_costs.h"
#include "validation/elements/cantilever.h"

namespace dartboard {

struct ElementsPlan {
  bool quick = false;  // coarser meshes, fewer rounds
  // Makes the displacements of a deck, as run_calculix does; empty: CalculiX is not asked.
  std::function<std::string(const std::string& deck)> calculix{};
  std::string calculix_version{};
};

/// The answers of one mesh, over those of the reference, less 1.
struct ModelErrors {
  Model model;
  CellKind cells;
  int across;
  double poisson;
  std::size_t nodes;
  double tip, bending, torsion, axial;
};
ModelErrors errors_of(Model model, CellKind cells, int across, double poisson, const CantileverAnswers& truth);

struct ElementsResults {
  int across = 4;                                                             // of the mesh on which costs are measured
  double trusted = 0.01;                                                      // how far the two references may be apart
  std::vector<std::pair<PublishedCantilever, CantileverAnswers>> references;  // by another code, and ours
  std::vector<ModelErrors> errors;
  std::vector<ModelCost> costs;
};

std::vector<Claim> claims_of(const ElementsResults& results);
Table errors_table(const ElementsResults& results);
Table references_table(const ElementsResults& results);
Table costs_table(const ElementsResults& results);
/// The model nearer to the truth for the same work, in words.
std::string in_words(const ElementsResults& results);

Report elements_study(const ElementsPlan& plan, StudyLog& log);

}  // namespace dartboard
