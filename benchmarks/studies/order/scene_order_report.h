#pragma once
// The report of `dartboard validate order SCENE...`: tables and claims on the scenes of a user.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "benchmarks/harness/claim.h"
#include "benchmarks/harness/table.h"
#include "validation/order/scene_order.h"

namespace dartboard {

/// A scene, the reference that its runs are compared with, and the orders that they show.
struct SceneOrders {
  std::string name;
  SceneReference reference;  // its states are not used here
  std::string failure{};     // the reason why there is no reference; empty where there is one
  std::vector<SceneOrder> orders{};
  OrderLimit limit{};  // what contact and loads leave of any order
};

/// One for each scene: it falls short where an order is missed, and is undecided where the motion leaves one open, or
/// where none is promised.
std::vector<Claim> claims_of(const std::vector<SceneOrders>& scenes);

Table scene_order_table(const std::vector<SceneOrders>& scenes);
Table scene_reference_table(const std::vector<SceneOrders>& scenes);

nlohmann::ordered_json to_json(const std::vector<SceneOrders>& scenes, const std::vector<Claim>& claims);

}  // namespace dartboard
