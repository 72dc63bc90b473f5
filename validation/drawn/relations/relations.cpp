#include "validation/drawn/relations/relations.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "validation/drawn/relations/comparison.h"

namespace dartboard {

RelationFound breaks(std::string words) { return {RelationOutcome::breaks, std::move(words)}; }
RelationFound does_not_apply(std::string words) { return {RelationOutcome::does_not_apply, std::move(words)}; }
RelationFound unless(const std::optional<std::string>& difference) {
  return difference ? breaks(*difference) : RelationFound{};
}

double distance(const DrawnMotion& a, const DrawnMotion& b) {
  double largest = 0.0;
  for (std::size_t k = 0; k < std::min(a.quantities.size(), b.quantities.size()); ++k) {
    const std::vector<double>&x = a.quantities[k].values, &y = b.quantities[k].values;
    if (!a.quantities[k].name.starts_with("positions") || x.empty()) continue;
    double sum = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) sum += std::pow(x[i] - y[i], 2);
    largest = std::max(largest, std::sqrt(3.0 * sum / static_cast<double>(x.size())));
  }
  return largest;
}

RelationFound unless_rounding(const JudgedScene& s, View view, const DrawnMotion& found, bool order_counts) {
  const DrawnMotion own = view(s.motion());
  std::optional<DrawnMotion> halved;
  if (order_counts) {
    if (!s.file().events.empty()) return does_not_apply("an order counts, and an event");
    if (s.file().unstable_step == UnstableStep::substep)
      return does_not_apply("an order counts, and steps are divided already");
    halved = view(s.in_shorter_steps(2));
    if (halved->end != own.end || halved->quantities.size() != own.quantities.size())
      return does_not_apply("an order counts, and the step");
  }
  if (s.scheme().implicit && !own.end.empty() && !found.end.empty())
    return does_not_apply("rounding decides when its equations have no solution");
  // equations are solved to a tolerance
  const double factor = s.scheme().implicit ? 1024.0 : 64.0;
  Allowances allowed(own.quantities.size(), 0.0);
  if (halved) add_differences(allowed, own, *halved, 8.0);
  std::optional<std::string> difference;
  for (const bool other_way : {false, true}) {
    const auto more = allowances(own, view(s.disturbed(other_way)), s.scales(), factor);
    if (!more) return does_not_apply("rounding decides what happens to it");
    std::ranges::transform(allowed, *more, allowed.begin(), [](double a, double b) { return std::max(a, b); });
    difference = differs_by_more(own, found, allowed);
    if (!difference) return {};
  }
  if (s.file().unstable_step == UnstableStep::substep)
    return does_not_apply("the number of parts of its steps rests on an estimate, which depends on axes and numbers");
  return unless(difference);
}

std::span<const Relation> relations() {
  static const std::vector<Relation> all = [] {
    std::vector<Relation> rows;
    for (const auto& some : {relations_of_runs(), relations_of_forms(), relations_of_physics(), relations_of_keys()})
      rows.insert(rows.end(), some.begin(), some.end());
    return rows;
  }();
  return all;
}

}  // namespace dartboard
