#include "core/scene/body/body_of_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <type_traits>
#include <utility>

#include "core/base/bytes.h"
#include "core/base/overloads.h"
#include "core/plain/error.h"
#include "core/scene/body/events/ready.h"
#include "core/scene/body/frame_columns.h"
#include "core/scene/body/make_contact.h"

namespace dartboard {
namespace {

constexpr std::string_view name_of_kind(int dimension) {
  return dimension == 3 ? "solids" : dimension == 2 ? "surfaces" : "chains";
}

/// The needs of a part: its own of the map, those of the whole for columns, without what is held over all parts.
BodyNeeds needs_of_part(const ProblemPart& part, const BodyNeeds& whole) {
  BodyNeeds needs = whole;
  const bool has_cells = part.dimension > 1;
  needs.storage = storage_of(part.problem.mesh);
  needs.topology_changes = whole.topology_changes && has_cells;
  if (!has_cells) needs.diagonals = Diagonals::none;
  std::erase_if(needs.forces, &ForceNeed::over_parts);
  if (part.dimension != 3) needs.touches.clear();
  return needs;
}

/// Append a column of a part. A column of numbers that some parts leave out is zero there; vectors are in all or in
/// none.
template <class T>
void append_column(std::vector<T>& all, const std::vector<T>& part, std::size_t first, std::size_t count) {
  if (part.empty() && all.empty()) return;
  if constexpr (std::is_arithmetic_v<T>) all.resize(first, T{});
  all.insert(all.end(), part.begin(), part.end());
  if constexpr (std::is_arithmetic_v<T>) all.resize(first + count, T{});
}

}  // namespace

BodyOfParts::BodyOfParts(const Problem& problem, const BodyNeeds& needs, MakePart make)
    : gravity_(problem.surroundings.gravity) {
  for (ProblemPart& part : parts_of(problem)) {
    Member made;
    made.dimension = part.dimension;
    try {
      made.body = make(part.problem, needs_of_part(part, needs), part.cell);
    } catch (const InputError& error) {
      throw InputError(fmt::format("of the {}, counted by themselves: {}", name_of_kind(part.dimension), error.what()));
    }
    made.point = std::move(part.point);
    made.cell = std::move(part.cell);
    made.material = std::move(part.material);
    parts_.push_back(std::move(made));
  }
  take_vertices();
  for (Member& part : parts_) {
    const SimulatedBody& body = *part.body;
    for (const ForceTerm* term : body.terms_but_contact(body.system().terms)) {
      if (part.first > 0) term = part.terms.emplace_back(std::make_unique<ShiftedTerm>(*term)).get();
      forces_.add(term);
    }
  }
  for (const ForceNeed& need : needs.forces)
    if (need.over_parts) forces_.make({&need, 1}, {parts_.front().dimension, vertices_, {}});
  forces_.touch_obstacles(needs.obstacles, samples_);
  forces_.touch_bodies(leading().contacts().bodies);
  take_state();
}

SimulatedBody& BodyOfParts::leading() const { return *parts_.front().body; }

const BodyOfParts::Member& BodyOfParts::part_of(std::uint32_t vertex) const {
  return *std::prev(std::ranges::upper_bound(parts_, vertex, {}, &Member::first));
}

// ---- the state, here and in the parts

/// Parts whose vertices are released or pulled get these columns, too.
void BodyOfParts::give_state() const {
  for (const Member& part : parts_) {
    VertexColumns& to = part.body->vertices();
    const auto give = [&](auto VertexColumns::*column) {
      if (!(to.*column).empty())
        std::copy_n((vertices_.*column).begin() + part.first, (to.*column).size(), (to.*column).begin());
    };
    give(&VertexColumns::position);
    give(&VertexColumns::velocity);
    give(&VertexColumns::fixed);
    give(&VertexColumns::held_axes);
    give(&VertexColumns::pull);
  }
}

void BodyOfParts::take_vertices() {
  for_each_column(vertices_, VertexColumns::embedded(), [](auto& column, const auto&) { column.clear(); });
  std::size_t count = 0;
  for (Member& part : parts_) {
    const VertexColumns& from = part.body->vertices();
    part.first = static_cast<std::uint32_t>(count);
    for_each_column(from, VertexColumns::embedded(), [&](const auto& column, const auto& row) {
      append_column(vertices_.*(row.values), column, count, from.size());
    });
    for (std::size_t k = count; k < vertices_.point.size(); ++k)
      if (vertices_.point[k] != no_point) vertices_.point[k] = part.point[vertices_.point[k]];
    count += from.size();
  }
}

void BodyOfParts::take_state() {
  take_vertices();
  springs_ = {};
  ends_.clear();
  samples_.clear();
  for (Member& part : parts_) {
    const SpringSystem system = std::as_const(*part.body).system();
    for (const auto& [a, b] : system.ends) ends_.push_back({part.first + a, part.first + b});
    for (const Spring spring : system.springs) springs_.push_back(spring);
    for (const auto& term : part.terms) term->shift_to(part.first);
    if (const ObstacleContact* contact = part.body->contacts().obstacles)
      for (SkinSample sample : contact->samples()) {
        for (std::uint32_t k = 0; k < sample.count; ++k) sample.nodes[k] += part.first;
        samples_.push_back(sample);
      }
  }
  forces_.for_each([this](BodyForce& force) {
    force.rebuild({vertices_, [this](std::span<const std::uint32_t> cells) { return corners_of(cells); }});
  });
  for (std::size_t k = 0; k < tracked_.size(); ++k) {
    const Member& part = parts_[tracked_in_[k].part];
    const std::uint32_t vertex = part.body->tracked()[tracked_in_[k].place];
    tracked_[k] = vertex == no_vertex ? no_vertex : part.first + vertex;
  }
}

std::span<const Eigen::Vector3d> BodyOfParts::own(const Member& part, std::span<const Eigen::Vector3d> x) {
  return x.subspan(part.first, part.body->vertices().size());
}

bool BodyOfParts::does_work() const {
  return SimulatedBody::does_work() ||
         std::ranges::any_of(parts_, [](const Member& part) { return part.body->does_work(); });
}

void BodyOfParts::begin_work(std::span<const Eigen::Vector3d> x) const {
  SimulatedBody::begin_work(x);
  for (const Member& part : parts_) part.body->begin_work(own(part, x));
}

double BodyOfParts::work(std::span<const Eigen::Vector3d> x, double h) const {
  double sum = SimulatedBody::work(x, h);
  for (const Member& part : parts_) sum += part.body->work(own(part, x), h);
  return sum;
}

void BodyOfParts::track(std::uint32_t vertex) {
  SimulatedBody::track(vertex);
  const Member& part = part_of(vertex);
  tracked_in_.push_back({static_cast<std::size_t>(&part - parts_.data()), part.body->tracked().size()});
  part.body->track(vertex - part.first);
}

std::vector<std::vector<CellCorner>> BodyOfParts::corners_of(std::span<const std::uint32_t> mesh_cells) const {
  std::vector<std::vector<CellCorner>> all(mesh_cells.size());
  for (const Member& part : parts_) {
    auto corners = part.body->corners_of(mesh_cells);
    for (std::size_t k = 0; k < corners.size(); ++k)
      for (const auto& [point, vertex] : corners[k]) all[k].push_back({part.point[point], part.first + vertex});
  }
  return all;
}

// ---- events

/// The targets of each part in turn, after their number.
class BodyOfParts::Event final : public ReadyEvent {
 public:
  Event(BodyOfParts& on, std::vector<std::unique_ptr<ReadyEvent>> events) : on_(on), events_(std::move(events)) {}

  std::size_t apply(EventTargets* taken) override {
    return operate([taken](ReadyEvent& event) {
      if (taken == nullptr) return event.apply();
      EventTargets targets;
      const std::size_t made = event.apply(&targets);
      taken->push_back(static_cast<std::uint32_t>(targets.size()));
      taken->insert(taken->end(), targets.begin(), targets.end());
      return made;
    });
  }
  std::size_t repeat(const EventTargets& taken) override {
    return operate([next = taken.begin()](ReadyEvent& event) mutable {
      const auto begin = next + 1;
      next = begin + *next;
      return event.repeat({begin, next});
    });
  }
  std::optional<std::size_t> facets() const override {
    std::optional<std::size_t> sum;
    on_.give_state();
    for (const auto& event : events_)
      if (const auto facets = event->facets()) sum = sum.value_or(0) + *facets;
    return sum;
  }
  void state(Archive& archive) override {
    for (const auto& event : events_) event->state(archive);
  }
  std::size_t bytes() const override {
    std::size_t sum = 0;
    for (const auto& event : events_) sum += event->bytes();
    return sum;
  }

 private:
  template <class Operation>
  std::size_t operate(Operation operation) {
    on_.give_state();
    std::size_t made = 0;
    for (const auto& event : events_) made += operation(*event);
    if (made > 0) on_.take_state();
    return made;
  }

  BodyOfParts& on_;
  std::vector<std::unique_ptr<ReadyEvent>> events_;
};

std::unique_ptr<ReadyEvent> BodyOfParts::make_ready(const SceneEvent& event) {
  const std::string path = event.action_path();
  const auto refuse = [&path](std::string_view key, std::string_view found, std::string_view expected) {
    throw InputError(fmt::format("{}{}: {}; expected {}", path, key, found, expected));
  };
  if (const auto* release = std::get_if<Release>(&event.action)) return ready(vertices_, *release, path);
  bool solids_alone =
      std::holds_alternative<Tear>(event.action) || std::holds_alternative<TearWhereStressed>(event.action);
  if (const auto* tear = std::get_if<Tear>(&event.action))
    if (const auto* point = std::get_if<std::uint32_t>(&tear->vertex))
      refuse("/vertex", fmt::format("is {}, in bodies of several dimensions", *point), "a place");
  if (const auto* cut = std::get_if<Dissociate>(&event.action))
    if (std::holds_alternative<FacetPoints>(cut->faces))
      refuse("/points", "are given in bodies of several dimensions", "a plane or a blade");
  std::uint32_t cells = 0;
  for (const Member& part : parts_)
    if (part.dimension > 1) cells += static_cast<std::uint32_t>(part.cell.size());
  const auto examine = [&](const CellSelection& selection, std::string_view key) {
    if (std::holds_alternative<RandomSelection>(selection))
      refuse(fmt::format("{}/random", key), "draws among cells of several dimensions", "a place or numbers of cells");
    if (const auto* by_id = std::get_if<IdSelection>(&selection)) {
      for (std::size_t k = 0; k < by_id->ids.size(); ++k)
        if (by_id->ids[k] >= cells)
          refuse(fmt::format("{}/ids/{}", key, k), fmt::format("is {}", by_id->ids[k]),
                 fmt::format("a cell of the mesh, less than {}", cells));
    } else {
      solids_alone = solids_alone || std::holds_alternative<Refine>(event.action);
    }
  };
  if (const auto* remove = std::get_if<Remove>(&event.action)) examine(remove->cells, "");
  if (const auto* refine = std::get_if<Refine>(&event.action)) examine(refine->cells, "/cells");

  std::vector<std::unique_ptr<ReadyEvent>> events;
  for (const Member& part : parts_) {
    if (part.dimension == 1 || (solids_alone && part.dimension != parts_.front().dimension)) continue;
    SceneEvent own = event;
    const auto keep_own = [&part](CellSelection& selection) {
      auto* by_id = std::get_if<IdSelection>(&selection);
      if (by_id == nullptr) return true;
      std::erase_if(by_id->ids, [&](std::uint32_t c) { return !std::ranges::binary_search(part.cell, c); });
      return !by_id->ids.empty();
    };
    if (auto* remove = std::get_if<Remove>(&own.action); remove != nullptr && !keep_own(remove->cells)) continue;
    if (auto* refine = std::get_if<Refine>(&own.action); refine != nullptr && !keep_own(refine->cells)) continue;
    events.push_back(part.body->make_ready(own));
  }
  return std::make_unique<Event>(*this, std::move(events));
}

// ---- what it reports

std::string BodyOfParts::map_name() const {
  std::string names;
  for (const Member& part : parts_)
    if (const std::string name = part.body->map_name(); name != "no map")
      names += (names.empty() ? "" : " and ") + name;
  return names.empty() ? "no map" : names;
}

double BodyOfParts::mass() const {
  double sum = 0.0;
  for (const Member& part : parts_) sum += part.body->mass();
  return sum;
}

double BodyOfParts::removed_mass() const {
  double sum = 0.0;
  for (const Member& part : parts_) sum += part.body->removed_mass();
  return sum;
}

CellCounts BodyOfParts::counts() const {
  CellCounts sum;
  for (const Member& part : parts_) {
    const CellCounts counts = part.body->counts();
    sum.vertices += counts.vertices;
    sum.edges += counts.edges;
    sum.faces += counts.faces;
    sum.cells += counts.cells;
    sum.components += counts.components;
  }
  return sum;
}

double BodyOfParts::boundary() const {
  give_state();
  return leading().boundary();
}

double BodyOfParts::largest_stress() const {
  give_state();
  return leading().largest_stress();
}

Frame BodyOfParts::frame(const FrameFields& fields) const {
  give_state();
  FrameFields own = fields;
  own.contact = false;
  Frame all;
  struct Lists {
    std::vector<std::uint32_t> mesh_cell, component;
    std::vector<std::uint8_t> material;
    std::vector<double> strain;
  } of_links, of_springs;
  const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  std::uint32_t components = 0;
  for (const Member& part : parts_) {
    Frame frame = part.body->frame(own);
    const std::uint32_t first = part.first;
    for (std::int64_t& p : frame.mesh_point)
      if (p >= 0) p = part.point[static_cast<std::size_t>(p)];
    for (std::uint32_t& component : frame.component) component += components;
    components += static_cast<std::uint32_t>(part.body->counts().components);
    if (!part.material.empty()) {
      if (frame.material.empty()) frame.material.assign(frame.component.size(), 0);
      for (std::uint8_t& number : frame.material) number = part.material[number];
    }
    const bool chains = part.dimension == 1;
    for (std::size_t c = 0; c < frame.mesh.cell_count(); ++c) {
      std::vector<std::uint32_t> nodes;
      for (const std::uint32_t k : frame.mesh.cell(c)) nodes.push_back(first + k);
      all.mesh.add_cell(frame.mesh.kinds[c], nodes);
    }
    append(chains ? of_links.mesh_cell : all.mesh_cell, frame.mesh_cell);
    append(chains ? of_links.component : all.component, frame.component);
    append(chains ? of_links.material : all.material, frame.material);
    append(chains ? of_links.strain : of_springs.strain, frame.strain);
    for (const auto& [a, b] : frame.links) all.links.push_back({first + a, first + b});
    for (const auto& [a, b] : frame.springs) all.springs.push_back({first + a, first + b});
    for (RefinedFacet facet : frame.refined_facets) {
      for (std::uint32_t& k : facet.points) k += first;
      for (std::int64_t& p : facet.lies_in) p = part.point[static_cast<std::size_t>(p)];
      all.refined_facets.push_back(facet);
    }
    append(all.mesh.points, frame.mesh.points);
    append(all.velocity, frame.velocity);
    append(all.mass, frame.mass);
    append(all.mesh_point, frame.mesh_point);
    append(all.displacement, frame.displacement);
    append(all.tension, frame.tension);
    if (part.body.get() == &leading()) all.largest_stress = frame.largest_stress;
    append(all.stress, frame.stress);
    if (fields.stress) all.stress.resize(all.mesh.points.size(), Eigen::Matrix3d::Zero());  // chains have tensions
  }
  if (all.mesh.cell_count() == 0) all.stress.clear();
  append(all.mesh_cell, of_links.mesh_cell);
  append(all.component, of_links.component);
  append(all.material, of_links.material);
  all.strain = std::move(of_links.strain);
  append(all.strain, of_springs.strain);
  all.fields = fields;
  if (fields.contact) fill_contact(all, contacts());
  return all;
}

std::string BodyOfParts::violation() const {
  for (const Member& part : parts_)
    if (std::string found = part.body->violation(); !found.empty()) return found;
  return {};
}

void BodyOfParts::state(Archive& archive) {
  if (!archive.reads()) give_state();
  for (const Member& part : parts_) part.body->state(archive);
  forces_.state(archive);
  if (archive.reads()) take_state();
}

MemoryReport BodyOfParts::memory() const {
  std::size_t numbers = 0;
  for (const Member& part : parts_) {
    numbers += bytes_of(part.point, part.cell, part.material);
    for (const auto& term : part.terms) numbers += term->bytes();
  }
  MemoryReport report{{Part::vertices, bytes_of_vertices(vertices_) + numbers},
                      {Part::viscosity, bytes_of(vertices_.viscosity)},
                      {Part::fixed, bytes_of(vertices_.fixed, vertices_.held_axes)},
                      {Part::rest, bytes_of(vertices_.rest)},
                      {Part::pull, bytes_of(vertices_.pull)},
                      {Part::springs, springs_.bytes() - springs_.damping_bytes() + bytes_of(ends_)},
                      {Part::damping, springs_.damping_bytes()}};
  forces_.report(report);
  if (const ObstacleContact* obstacles = contacts().obstacles)
    report.push_back({Part::contact, bytes_of(samples_) + obstacles->bytes()});
  for (const Member& part : parts_)
    for (const MemoryItem& item : part.body->memory()) report.push_back(item);
  return report;
}

}  // namespace dartboard
