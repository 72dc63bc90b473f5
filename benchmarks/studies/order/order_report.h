#pragma once
// The report of `dartboard validate order`: tables and claims.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/harness/claim.h"
#include "benchmarks/harness/table.h"
#include "validation/order/convergence_order.h"
#include "validation/order/cut_jump.h"
#include "validation/order/discrete_exact.h"
#include "validation/order/force_gradient.h"
#include "validation/order/implicit_gains.h"

namespace dartboard {

/// The reference of a scene.
struct OrderReference {
  OrderCase which = OrderCase::undamped;
  reference::CertifiedMotion certified;
};

/// The measured orders and errors.
struct OrderResults {
  std::vector<OrderReference> references;
  std::vector<OrderStudy> studies;
  std::vector<DiscreteExact> discrete;
  std::vector<std::string> no_discrete;  // integrators that do not state their amplification
  ForceGradient force;
  std::vector<CutJump> jumps;
  ConservedDrift drift;
  KeptFactor factor;
};

std::vector<Claim> claims_of(const OrderResults& results);

/// Says on whose agreement the references are based: "by independent codes".
std::string references_heading(const OrderResults& results);

/// The observed orders in x or in v, halving by halving, each with the mark of its regime.
std::string orders_text(const OrderStudy& study, double OrderPoint::*order);
/// "0.7 .. 0.02": h omega of the longest and of the shortest steps; "-" without runs.
std::string steps_text(const OrderStudy& study);

Table order_table(const OrderResults& results);
Table oracle_table(const OrderResults& results);
Table discrete_table(const OrderResults& results);

/// The orders and errors of each run; `scene` is its name.
nlohmann::ordered_json to_json(const OrderStudy& study, std::string_view scene);
nlohmann::ordered_json to_json(const OrderResults& results, const std::vector<Claim>& claims);

}  // namespace dartboard
