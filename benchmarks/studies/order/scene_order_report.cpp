#include "benchmarks/studies/order/scene_order_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "benchmarks/harness/json_number.h"
#include "benchmarks/studies/order/order_report.h"
#include "core/plain/nan_maximum.h"

namespace dartboard {
namespace {

std::string in_words(const SceneOrder& order) {
  switch (order.answer) {
    case OrderAnswer::shown: return "shown";
    case OrderAnswer::missed: return "MISSED: " + order.study.reason;
    case OrderAnswer::open: return "open: " + order.study.reason;
  }
  return "?";
}

/// "order 1.5 at most through speed that is lost, with exponent 3"; empty without a limit
std::string limit_in_words(const OrderLimit& limit) {
  if (limit.because.empty()) return {};
  if (!limit.is_promised()) return "no order is promised through " + limit.because;
  return fmt::format("order {:g} at most through {}", limit.most, limit.because);
}

Claim claim_of(const SceneOrders& scene) {
  const std::string limit = limit_in_words(scene.limit);
  Claim claim{.id = "order-on-" + scene.name,
              .text = fmt::format("every integrator shows its order on {}, in x and in v", scene.name),
              .paper_value = "three successive halvings within 0.1"};
  if (!limit.empty()) {
    claim.text += "; " + limit;
    claim.paper_value = "five errors or more fall with it, or faster, within 0.3";
  }
  std::replace(claim.id.begin(), claim.id.end(), ' ', '-');
  if (scene.orders.empty()) {
    claim.reason = scene.failure;
    return claim;
  }
  if (!scene.limit.is_promised()) claim.reason = limit;
  const auto count = [&](OrderAnswer answer) { return std::ranges::count(scene.orders, answer, &SceneOrder::answer); };
  double farthest = 0.0;
  for (const SceneOrder& order : scene.orders) {
    const OrderStudy& s = order.study;
    if (order.answer == OrderAnswer::shown)
      farthest = max_or_nan(farthest, std::abs(std::min(s.p_x, s.p_v) - s.theory));
    else
      claim.reason += fmt::format("{}{}: {}", claim.reason.empty() ? "" : "; ", s.integrator, s.reason);
  }
  const auto shown = count(OrderAnswer::shown);
  claim.measured = fmt::format("{} of {} integrators", shown, scene.orders.size());
  if (shown > 0 && limit.empty()) claim.measured += fmt::format(", farthest {:.3f}", farthest);
  claim.bound_or_interval = "reference: " + scene.reference.what;
  claim.verdict = count(OrderAnswer::missed) > 0 ? Verdict::falls_short
                  : count(OrderAnswer::open) > 0 ? Verdict::undecided
                                                 : Verdict::holds;
  return claim;
}

}  // namespace

std::vector<Claim> claims_of(const std::vector<SceneOrders>& scenes) {
  std::vector<Claim> claims;
  for (const SceneOrders& scene : scenes) claims.push_back(claim_of(scene));
  return claims;
}

Table scene_order_table(const std::vector<SceneOrders>& scenes) {
  Table table({{"scene"},
               {"integrator"},
               {"theory", Align::right},
               {"h omega", Align::right},
               {"p in x, by halving"},
               {"p in v"},
               {"order"}});
  for (const SceneOrders& scene : scenes)
    for (const SceneOrder& order : scene.orders)
      table.add_row({scene.name, order.study.integrator, fmt::format("{:g}", order.study.theory),
                     steps_text(order.study), orders_text(order.study, &OrderPoint::p_x),
                     orders_text(order.study, &OrderPoint::p_v), in_words(order)});
  return table;
}

Table scene_reference_table(const std::vector<SceneOrders>& scenes) {
  Table table({{"scene"}, {"floor / edges", Align::right}, {"CPU s", Align::right}, {"reference"}});
  for (const SceneOrders& scene : scenes)
    if (scene.failure.empty())
      table.add_row({scene.name, fmt::format("{:.1e}", scene.reference.floor),
                     fmt::format("{:.1f}", scene.reference.cpu_s), scene.reference.what});
    else
      table.add_row({scene.name, "-", "-", scene.failure});
  return table;
}

nlohmann::ordered_json to_json(const std::vector<SceneOrders>& scenes, const std::vector<Claim>& claims) {
  nlohmann::ordered_json json{{"holds", exit_code(claims) == 0}, {"claims", nlohmann::json(claims)}};
  for (const SceneOrders& scene : scenes) {
    nlohmann::ordered_json one{{"scene", scene.name}};
    if (!scene.limit.because.empty()) one["limit"] = {{"most", scene.limit.most}, {"because", scene.limit.because}};
    if (scene.failure.empty())
      one["reference"] = {{"kind", name(scene.reference.kind)},
                          {"floor", number(scene.reference.floor)},
                          {"gain", number(scene.reference.gain)},
                          {"what", scene.reference.what}};
    else
      one["failure"] = scene.failure;
    json["references"].push_back(one);
    for (const SceneOrder& order : scene.orders) {
      json["orders"].push_back(to_json(order.study, scene.name));
      json["orders"].back()["answer"] = order.answer == OrderAnswer::shown    ? "shown"
                                        : order.answer == OrderAnswer::missed ? "missed"
                                                                              : "open";
    }
  }
  return json;
}

}  // namespace dartboard
