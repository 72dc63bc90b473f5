#include "benchmarks/studies/step/changing_bodies.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "benchmarks/harness/json_fields.h"
#include "benchmarks/studies/step/kept_columns.h"
#include "benchmarks/studies/step/scene_columns.h"
#include "benchmarks/studies/step/step_bodies.h"
#include "core/mechanics/adapt.h"
#include "core/operations/dissociate_face.h"
#include "core/scene/body/events/changing_body.h"
#include "core/scene/body/simulated_body.h"
#include "core/topology/facets.h"
#include "core/topology/storage/hash.h"
#include "core/views/spring_ends.h"
#include "validation/contenders/contenders.h"

namespace dartboard {
namespace {

constexpr std::size_t share_of_faces = 100;  // one in so many may be dissociated

/// A scene's body, which follows its changes.
class FollowingBody {
 public:
  explicit FollowingBody(const Problem& problem)
      : body_(make_simulated_body(problem, true)), on_(dynamic_cast<ChangingBody<TetMap>&>(*body_)) {}
  void change(Dart face) { on_.follow(dissociate_face(on_.body().map, face)); }
  VertexColumns& vertices() { return body_->vertices(); }
  SpringSystem system() const { return body_->system(); }
  const MassSpringBody<TetMap, Held::by_every_dart>& body() const { return on_.body(); }
  const SimulatedBody& scene() const { return *body_; }

 private:
  std::unique_ptr<SimulatedBody> body_;
  ChangingBody<TetMap>& on_;
};

/// A body without views that follow: after each change the ends of all springs are read from the map. Masses and
/// springs are adapted, or all of them are computed anew, too: then nothing that integrators read follows but positions
/// and velocities.
class BodyReadAnew {
 public:
  BodyReadAnew(MassSpringBody<TetMap, Held::by_every_dart> body, bool all) : body_(std::move(body)), all_(all) {
    ends_.rebuild(body_);
  }
  void change(Dart face) {
    adapt(body_, dissociate_face(body_.map, face));
    if (all_) compute_anew();
    ends_.rebuild(body_);
  }
  VertexColumns& vertices() { return body_.vertices; }
  SpringSystem system() const {
    return system_of(body_.vertices, ends_.ends, body_.springs, body_.surroundings.gravity, {});
  }

 private:
  void compute_anew() {
    for (std::uint32_t k = 0; k < body_.vertices.size(); ++k)
      body_.set_mass(k, body_.mass_of(Vertex{body_.vertices.dart[k]}));
    for (std::uint32_t k = 0; k < body_.springs.size(); ++k)
      body_.springs.set(k, body_.spring_of(Edge{body_.edge_dart[k]}, body_.springs[k].rest_length));
  }

  MassSpringBody<TetMap, Held::by_every_dart> body_;
  bool all_;
  SpringEndsView ends_;
};

/// A body from which faces are taken apart one by one, and its motion.
template <class Body>
class Changing {
 public:
  Changing(std::shared_ptr<Body> body, double h, const char* task)
      : body_(std::move(body)), columns_(body_, h, {task}) {}

  void change(const std::vector<Dart>& faces, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) body_->change(faces[done_++]);
  }
  void change_and_step(const std::vector<Dart>& faces, int steps) {
    for (int k = 0; k < steps; ++k) {
      change(faces, 1);
      columns_.restart();
      columns_.step(1);
    }
  }
  /// Faces so far.
  std::size_t done() const { return done_; }
  SceneColumns& columns() { return columns_; }
  std::uint64_t hash() const {
    Hash h;
    h.add(body_->vertices().position);
    h.add(body_->vertices().velocity);
    return h.value();
  }

 private:
  std::shared_ptr<Body> body_;
  SceneColumns columns_;
  std::size_t done_ = 0;
};

/// A body whose changes are timed.
struct Subject {
  Problem problem;
  std::shared_ptr<FollowingBody> body;
  std::vector<Dart> faces;  // those that may come apart, in an order drawn at random
  ChangingCounts counts;
  bool is_small;

  Subject(const std::string& name, const ChangingPlan& plan)
      : problem(find_step_body(name, plan.seed).make()),
        body(std::make_shared<FollowingBody>(problem)),
        is_small(problem.mesh.cell_count() <= plan.most_made_anew) {
    faces = inner_facets(body->body().map);
    SplitMix64 random(plan.seed);
    shuffle(faces, random);
    faces.resize(faces.size() / share_of_faces);
    const std::size_t springs = body->body().springs.size();
    counts = {.changing = name,
              .tetrahedra = problem.mesh.cell_count(),
              .springs = springs,
              .steps = static_cast<int>(std::clamp<std::size_t>(springs_in_sample / springs, 1, faces.size())),
              .faces = faces.size()};
  }
};

/// A body that is made anew where it is small or has lost its faces.
template <class Body>
class Renewed {
 public:
  Renewed(const Subject& subject, const char* task, std::function<std::shared_ptr<Body>()> make)
      : subject_(subject), task_(task), make_(std::move(make)) {
    renew();
  }
  void restore(const PointState& start) {
    if (subject_.is_small || now_->done() + static_cast<std::size_t>(subject_.counts.steps) > subject_.faces.size())
      renew();
    now_->columns().set_state(start);
  }
  Changing<Body>& now() { return *now_; }

 private:
  void renew() { now_ = std::make_unique<Changing<Body>>(make_(), subject_.problem.h, task_); }

  const Subject& subject_;
  const char* task_;
  std::function<std::shared_ptr<Body>()> make_;
  std::unique_ptr<Changing<Body>> now_;
};

void measure_subject(const Subject& subject, const PairedOptions& options,
                     const std::function<void(const Sample&)>& sink) {
  using namespace changing_task;
  const Problem& problem = subject.problem;
  const std::vector<Dart>& faces = subject.faces;
  const auto fresh = subject.body->body();
  const auto follower =
      std::make_shared<Renewed<FollowingBody>>(subject, followed, [&, unused = subject.body]() mutable {
        return unused ? std::exchange(unused, nullptr) : std::make_shared<FollowingBody>(problem);
      });
  const auto reader = [&](const char* task) {
    return std::make_shared<Renewed<BodyReadAnew>>(
        subject, task, [&fresh, all = task == all_anew] { return std::make_shared<BodyReadAnew>(fresh, all); });
  };
  const std::shared_ptr<ContenderBody> other = contender(baseline_id).make(problem);
  // in motion, and with the damping at work
  SceneColumns& columns = follower->now().columns();
  columns.choose();
  columns.step(10);
  const PointState start = columns.state();

  const int steps = subject.counts.steps;
  const std::string& name = subject.counts.changing;
  const auto changes = [&](const char* task, const auto& body) -> TimedTask {
    return {name + task, [body, &start] { body->restore(start); },
            [body, &faces, steps] { body->now().change_and_step(faces, steps); },
            [body] { return body->now().hash(); }};
  };
  const TimedTask tasks[]{
      changes(followed, follower),
      {name + alone, [follower, &start] { follower->now().columns().set_state(start); },
       [follower, steps] { follower->now().columns().step(steps); }, [follower] { return follower->now().hash(); }},
      changes(ends_anew, reader(ends_anew)),
      changes(all_anew, reader(all_anew)),
      {name + naive, [other, &start] { other->set_state(start); }, [other, steps] { other->step(steps); },
       [other] { return state_hash(other->state()); }}};
  run_rounds(tasks, options, sink);
}

}  // namespace

std::vector<std::string> changing_bodies(std::size_t largest) {
  std::vector<std::string> bodies{paper_step_body(true)};
  for (std::size_t size = 10'000; size <= std::min<std::size_t>(largest, 1'000'000); size *= 10)
    bodies.push_back(step_box(size, false));
  return bodies;
}

void compare_changing(const ChangingPlan& plan, const std::function<void(const ChangingCounts&)>& sink) {
  const MannerBefore before;
  for (const std::string& name : changing_bodies(plan.largest)) {
    Subject subject(name, plan);
    const double h = subject.problem.h;
    std::vector<Changing<BodyReadAnew>> readers;
    for (const bool all : {false, true})
      readers.emplace_back(std::make_shared<BodyReadAnew>(subject.body->body(), all), h, changing_task::all_anew);
    Changing follower(subject.body, h, changing_task::followed);
    const std::size_t changes = std::min<std::size_t>(subject.faces.size() / 2, 20);
    follower.change(subject.faces, changes);
    const SimulatedBody& now = subject.body->scene();
    const Problem present = present_problem(now.frame({}).mesh, now.vertices(), subject.problem);
    SceneColumns fresh(std::shared_ptr<SimulatedBody>(make_simulated_body(present, false)), h, {"fresh"});
    subject.counts.differing =
        count_differing(kept_columns(now.vertices(), now.system(), h), std::vector<ContenderBody*>{&fresh});
    follower.columns().choose();
    follower.change_and_step(subject.faces, steps_to_start);
    for (Changing<BodyReadAnew>& reader : readers) {
      reader.change(subject.faces, changes);
      reader.change_and_step(subject.faces, steps_to_start);
      subject.counts.differing += follower.hash() == reader.hash() ? 0 : 1;
    }
    sink(subject.counts);
  }
}

void measure_changing(const ChangingPlan& plan, const std::function<void(const Sample&)>& sink) {
  const MannerBefore before;
  for (const std::string& name : changing_bodies(plan.largest)) {
    const Subject subject(name, plan);
    const int rounds = subject.counts.tetrahedra < 500'000 ? plan.rounds : std::max(1, plan.rounds / 5);
    measure_subject(subject, {.rounds = rounds, .warmup = 1, .process = plan.process, .seed = plan.seed}, sink);
  }
}

DARTBOARD_JSON_FIELDS(ChangingCounts, changing, tetrahedra, springs, steps, faces, differing)

}  // namespace dartboard
