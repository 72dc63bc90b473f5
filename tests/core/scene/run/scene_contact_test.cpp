// The work of contact around a step, with integrators whose steps fail.

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "core/base/archive.h"
#include "core/scene/body/needs.h"
#include "core/scene/file/scene_problem.h"
#include "core/time/integrators.h"
#include "tests/support/moving_box.h"

namespace dartboard::scene_contact_test {
namespace {

using namespace moving;

/// Leaves places and velocities as they were, as the interface asks for.
class FailingIntegrator : public Integrator {
 public:
  const Scheme& scheme() const override { return real_->scheme(); }
  StepResult step(const SpringSystem&, Motion, double) override {
    return {StepCode::newton_stalled, Witness::none, 0, "residual", 1.0};
  }

 private:
  std::unique_ptr<Integrator> real_ = make_integrator("backward-euler");
};

/// The body and the state of contact after 20 steps, each of which may have been tried before in vain.
std::pair<std::uint64_t, std::string> after_steps(const SceneFile& scene, int failures) {
  const Problem problem = make_problem(scene);
  const auto body = make_simulated_body(problem, needs_of(scene, problem).body);
  const auto integrator = make_integrator("verlet");
  FailingIntegrator failing;
  SceneContact contact(body->contacts(), true);
  const double h = scene.step;
  contact.start(body->vertices().position, {}, h);
  contact.system_changed(body->system(), body->vertices().position);
  for (int n = 0; n < 20; ++n) {
    for (int k = 0; k < failures; ++k)
      EXPECT_FALSE(contact.step(failing, body->system(), body->motion(), n * h, h).ok());
    EXPECT_TRUE(contact.step(*integrator, body->system(), body->motion(), n * h, h).ok());
  }
  EXPECT_GT(contact.losses().damped, 0.0);
  EXPECT_GT(contact.losses().rubbed, 0.0);
  EXPECT_NE(contact.losses().supplied, 0.0);
  Archive archive;
  archive(contact);
  return {body->state_hash(), archive.written()};
}

TEST(SceneContact, HasNoTraceOfStepsThatFailed) {
  Json json = moving_box();
  json["contact"] = Json::parse(R"({"pressure": 2000, "depth": 0.01, "restitution": 0.3, "friction": 0.4,
    "obstacles": [{"plane": {"point": [0, 0, 0.001], "normal": [0, 0, 1]}, "velocity": [0.2, 0, 0.1]}]})");
  const SceneFile scene = parse(json);
  const auto once = after_steps(scene, 0);
  EXPECT_EQ(after_steps(scene, 1), once);
  EXPECT_EQ(after_steps(scene, 2), once);
}

}  // namespace
}  // namespace dartboard::scene_contact_test
