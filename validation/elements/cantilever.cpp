#include "validation/elements/cantilever.h"

#include <algorithm>

#include "reference/elements/held_factor.h"

namespace dartboard {
namespace {

CantileverAnswers answers(const LinearBar& bar) {
  const reference::HeldFactor solid(bar.solid);
  CantileverAnswers a;
  a.nodes = static_cast<std::size_t>(bar.shear.size() / 3);
  a.work = bar.shear.dot(solid.displacements(bar.shear));
  std::ranges::copy(solid.frequencies(a.frequency.size()), a.frequency.begin());
  return a;
}

}  // namespace

CantileverAnswers quadratic_cantilever(int across, double poisson) {
  return answers(quadratic_bar(cantilever::bar, across, poisson));
}

std::unique_ptr<SimulatedBody> cantilever_body(Model model, int across, double poisson, CellKind cells) {
  return bar_body(cantilever::bar, {model, cells}, across, poisson);
}

CantileverAnswers cantilever_of(Model model, int across, double poisson, CellKind cells) {
  const auto body = cantilever_body(model, across, poisson, cells);
  return answers(linear_bar(cantilever::bar, {model, cells}, across, *body));
}

double confined_modulus(double poisson) { return confined_modulus(cantilever::young, poisson); }

double confined_modulus_of(Model model, double poisson) {
  return confined_modulus_of(cantilever::bar, *cantilever_body(model, 2, poisson));
}

}  // namespace dartboard
