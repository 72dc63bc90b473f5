#include "validation/topology/lockstep.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <utility>

#include "core/plain/error.h"

namespace dartboard {

std::string to_string(const Disagreement& d) {
  return fmt::format("{}: {}: {}; {}", d.line.empty() ? "at rest" : fmt::format("after \"{}\"", d.line), d.what, d.ours,
                     d.theirs);
}

std::vector<std::unique_ptr<MapTwin>> core_twins(const Mesh& mesh, ScriptStorage storage) {
  std::vector<std::unique_ptr<MapTwin>> twins;
  const bool surface = mesh.cell_count() > 0 && mesh.dimension() == 2;
  if (surface && storage == ScriptStorage::tetrahedral) throw InputError("a surface cannot be stored as tetrahedra");
  twins.push_back(surface ? make_core_twin<Map2>(mesh) : make_core_twin<Map3>(mesh));
  if (storage == ScriptStorage::tetrahedral) twins.push_back(make_core_twin<TetMap>(mesh));
  return twins;
}

Lockstep::Lockstep(const Mesh& mesh, ScriptStorage storage, ScriptOracles oracles, const MakeTwins& ours)
    : twins_(ours(mesh, storage)), core_count_(twins_.size()), n_(twins_[0]->dimension()) {
  const AlphaList expected = alphas_of(mesh);
  if (oracles != ScriptOracles::none) twins_.push_back(make_cgal_gmap_twin(expected));
  if (oracles == ScriptOracles::both)
    if (auto cmap = make_cgal_cmap_twin(expected, &no_cmap_)) twins_.push_back(std::move(cmap));
  for (const Dart d : expected.darts) appear(d);
  const auto counts = twins_[0]->count_cells();
  cells_.assign(counts.begin(), counts.begin() + n_ + 1);
}

bool Lockstep::carries_sew(int i, Dart a, Dart b) const {
  return std::all_of(twins_.begin(), twins_.end(), [&](const auto& t) { return t->can_carry_sew(i, a, b); });
}
bool Lockstep::carries_unsew(int i) const {
  return i <= n_ && std::all_of(twins_.begin(), twins_.end(), [&](const auto& t) { return t->can_carry_unsew(i); });
}
bool Lockstep::carries(CellKind kind) const {
  return std::all_of(twins_.begin(), twins_.end(), [&](const auto& t) { return t->can_carry(kind); });
}

void Lockstep::appear(Dart d) {
  next_name_ = std::max(next_name_, d.index + 1u);
  if (place_.size() < next_name_) {
    const std::size_t size = next_name_ + next_name_ / 2;
    place_.resize(size);
    stamp_.resize(size, 0);
    covered_.resize(size, 0);
  }
  place_[d.index] = static_cast<std::uint32_t>(live_.size());
  live_.push_back(d);
}

void Lockstep::vanish(Dart d) {
  live_[place_[d.index]] = live_.back();
  place_[live_.back().index] = place_[d.index];
  live_.pop_back();
}

Disagreement Lockstep::differ(std::string what, std::string ours, const MapTwin& twin, std::string theirs) const {
  return {0, "", std::move(what), fmt::format("{} says {}", twins_[0]->library(), ours),
          fmt::format("{} says {}", twin.library(), theirs)};
}

std::optional<Disagreement> Lockstep::apply(Operation& operation) {
  outcome_ = Outcome::applied;
  std::optional<Disagreement> found;
  try {
    found = apply_checked(operation);
  } catch (const std::exception& error) {
    found = Disagreement{0, "", "a twin threw", "no exception was expected", error.what()};
  }
  if (found) found->line = to_string(operation);
  return found;
}

std::optional<Disagreement> Lockstep::apply_checked(Operation& op) {
  if (op.kind == Operation::Kind::add) return do_add(op);
  for (const Dart d : {op.a, op.b}) {
    if (d == no_dart) continue;  // not an operand
    for (const auto& twin : twins_)
      if (twin->is_live(d) != twins_[0]->is_live(d))
        return differ(to_string(d) + " is live", twins_[0]->is_live(d) ? "yes" : "no", *twin,
                      twin->is_live(d) ? "yes" : "no");
    if (!twins_[0]->is_live(d)) {
      outcome_ = Outcome::illegal;
      return std::nullopt;
    }
  }
  switch (op.kind) {
    case Operation::Kind::sew: return do_sew(op);
    case Operation::Kind::unsew: return do_unsew(op, op.i);
    case Operation::Kind::dissociate: return do_unsew(op, n_);
    default: return do_remove(op.a);
  }
}

std::optional<Disagreement> Lockstep::do_sew(const Operation& op) {
  if (op.i > n_ || !carries_sew(op.i, op.a, op.b)) {
    outcome_ = Outcome::not_carried;
    return std::nullopt;
  }
  const auto line = darts_touched(*twins_[0], op.i, op.a, op.a);
  const bool fold = std::find(line.begin(), line.end(), op.b) != line.end();
  const bool legal = twins_[0]->can_sew(op.i, op.a, op.b);
  for (const auto& twin : twins_) {
    const bool verdict = twin == twins_[0] ? legal : twin->can_sew(op.i, op.a, op.b);
    bool expected = legal;
    if (fold && twin->refuses_folds())  // CGAL's exceptions, see make_cgal_gmap_twin
      expected = op.a == op.b && op.i == 1 && twin->alpha(1, op.a) == op.a;
    if (verdict != expected)
      return differ("whether it is legal", legal ? "yes" : "no", *twin,
                    fmt::format("{}, expected {}", verdict ? "yes" : "no", expected ? "yes" : "no"));
  }
  if (!legal) {
    outcome_ = Outcome::illegal;
    return std::nullopt;
  }
  const auto touched = darts_touched(*twins_[0], op.i, op.a, op.b);
  const auto before = count_cells_around(*twins_[0], touched);
  for (const auto& twin : twins_) twin->sew(op.i, op.a, op.b);
  if (auto found = compare_around(touched, op.i)) return found;
  return count_change(touched, before, {});
}

std::optional<Disagreement> Lockstep::do_unsew(const Operation& op, int i) {
  if (!carries_unsew(i)) {
    outcome_ = Outcome::not_carried;
    return std::nullopt;
  }
  const Dart opposite = twins_[0]->alpha(i, op.a);
  for (const auto& twin : twins_)
    if (const Dart theirs = twin->alpha(i, op.a); theirs != opposite)
      return differ(fmt::format("alpha{}({})", i, to_string(op.a)), to_string(opposite), *twin, to_string(theirs));
  if (opposite == op.a) {
    outcome_ = Outcome::illegal;
    return std::nullopt;
  }
  const auto line = darts_touched(*twins_[0], i, op.a, op.a);
  const bool fold = std::find(line.begin(), line.end(), opposite) != line.end();
  const auto touched = darts_touched(*twins_[0], i, op.a, opposite);
  const auto before = count_cells_around(*twins_[0], touched);
  if (op.kind == Operation::Kind::dissociate) {
    SplitCounts ours{};
    const auto say = [](const SplitCounts& s) {
      return fmt::format("{} vertices, {} edges, {} faces", s[0], s[1], s[2]);
    };
    for (const auto& twin : twins_) {
      const SplitCounts split = twin->dissociate(op.a);
      if (twin == twins_[0]) ours = split;
      if (split != ours) return differ("what came apart", say(ours), *twin, say(split));
    }
    const auto after = count_cells_around(*twins_[0], touched);
    SplitCounts counted{};
    for (std::size_t k = 0; k < static_cast<std::size_t>(n_); ++k) counted[k] = after[k] - before[k];
    if (counted != ours) return differ("what came apart", say(ours), *twins_[0], say(counted) + " by its orbits");
  } else {
    for (const auto& twin : twins_) twin->unsew(i, op.a);
  }
  if (auto found = compare_around(touched, i)) return found;
  return count_change(touched, before, i == n_ && !fold ? std::span<const Dart>(line) : std::span<const Dart>());
}

std::optional<Disagreement> Lockstep::do_remove(Dart d) {
  std::vector<Dart> cell, neighbours;
  twins_[0]->orbit(cell_involutions(n_, n_), d, cell);
  std::sort(cell.begin(), cell.end());
  for (const Dart e : cell) {
    const Dart opposite = twins_[0]->alpha(n_, e);
    if (!std::binary_search(cell.begin(), cell.end(), opposite)) neighbours.push_back(opposite);
  }
  auto all = cell;
  all.insert(all.end(), neighbours.begin(), neighbours.end());
  const auto before = count_cells_around(*twins_[0], all);
  for (const auto& twin : twins_) twin->remove(d);
  for (const Dart e : cell) {
    vanish(e);
    for (const auto& twin : twins_)
      if (twin->is_live(e)) return differ(to_string(e) + " is live", "no", *twin, "yes");
  }
  for (const auto& twin : twins_)
    if (twin->dart_count() != live_.size())
      return differ("darts", std::to_string(live_.size()) + " expected", *twin, std::to_string(twin->dart_count()));
  if (auto found = compare_around(neighbours, n_)) return found;
  return count_change(neighbours, before, {});
}

std::optional<Disagreement> Lockstep::do_add(Operation& op) {
  if (op.a == no_dart) op.a = {next_name_};
  if (!carries(op.cell)) {
    outcome_ = Outcome::not_carried;
    return std::nullopt;
  }
  constexpr std::uint32_t widest_gap = 1u << 24;  // names are indices: a script may skip some, not fill the memory
  if (op.a.index < next_name_ || op.a.index - next_name_ > widest_gap) {
    outcome_ = Outcome::illegal;
    return std::nullopt;
  }
  for (const auto& twin : twins_) twin->add(op.cell, op.a);
  std::vector<Dart> darts;
  for (std::uint32_t p = 0; p < shape_of(op.cell).node.size(); ++p) {
    darts.push_back({op.a.index + p});
    appear(darts.back());
  }
  for (const auto& twin : twins_)
    if (twin->dart_count() != live_.size())
      return differ("darts", std::to_string(live_.size()) + " expected", *twin, std::to_string(twin->dart_count()));
  if (auto found = compare_around(darts, -1)) return found;
  return count_change(darts, std::vector<long>(static_cast<std::size_t>(n_) + 1, 0), {});
}

// An i-sew or unsew changes no i-cell: `changed` is i, or -1.
std::optional<Disagreement> Lockstep::compare_around(std::span<const Dart> touched, int changed) {
  const MapTwin& ours = *twins_[0];
  for (const Dart d : touched)
    for (int i = 0; i <= n_; ++i) {
      const Dart expected = ours.alpha(i, d);
      for (const auto& twin : twins_)
        if (const Dart found = twin->alpha(i, d); found != expected)
          return differ(fmt::format("alpha{}({})", i, to_string(d)), to_string(expected), *twin, to_string(found));
    }
  for (std::size_t k = 0; k < core_count_; ++k)
    if (const auto violation = twins_[k]->violation_near(touched); !violation.empty())
      return differ("validity", "a valid map expected", *twins_[k], violation);
  for (int i = 0; i <= n_; ++i) {
    if (i == changed) continue;
    ++covered_epoch_;
    for (const Dart d : touched)
      if (covered_[d.index] != covered_epoch_)
        if (auto found = compare_cell(i, d)) return found;
  }
  return std::nullopt;
}

// Each carrier's walk must visit every dart of ours once: it turns the stamp of the carrier before it into its own.
std::optional<Disagreement> Lockstep::compare_cell(int i, Dart d) {
  const Involutions set = cell_involutions(n_, i);
  twins_[0]->orbit(set, d, orbit_);
  ++epoch_;
  const auto unknown = [&](Dart e) { return e.index >= next_name_; };
  for (const Dart e : orbit_) {
    if (unknown(e))
      return differ(fmt::format("the {}-cell of {}", i, to_string(d)), "live darts expected", *twins_[0], "another");
    covered_[e.index] = covered_epoch_;
    stamp_[e.index] = epoch_;
  }
  for (std::size_t k = 1; k < twins_.size(); ++k) {
    twins_[k]->orbit(set, d, other_);
    const auto stranger = std::find_if(other_.begin(), other_.end(), [&](Dart e) {
      return unknown(e) || std::exchange(stamp_[e.index], epoch_ + 1) != epoch_;
    });
    ++epoch_;
    if (stranger != other_.end() || other_.size() != orbit_.size())
      return differ(fmt::format("the {}-cell of {}", i, to_string(d)), fmt::format("{} darts", orbit_.size()),
                    *twins_[k],
                    fmt::format("{} darts{}", other_.size(),
                                stranger == other_.end() ? "" : fmt::format(", {} among them", to_string(*stranger))));
  }
  return std::nullopt;
}

// Cells that came or went. Unsewing a facet makes one facet more, and of the cells around it at most one more wherever
// the facet meets one; cells of top dimension stay. `unsewn` is the line of one side of the facet, if that was done.
std::optional<Disagreement> Lockstep::count_change(std::span<const Dart> touched, const std::vector<long>& before,
                                                   std::span<const Dart> unsewn) {
  const auto after = count_cells_around(*twins_[0], touched);
  for (int i = 0; i <= n_; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const long change = after[k] - before[k];
    cells_[k] += change;
    if (unsewn.empty()) continue;
    const long least = i == n_ - 1 ? 1 : 0;
    long most = least;
    if (i <
        n_ - 1)  // the facet meets an i-cell at two darts, or at one: the ends of an edge; corners and sides of a face
      for (const Dart d : unsewn) most += n_ == 2 || twins_[0]->alpha(1 - i, d) >= d ? 1 : 0;
    if (change < least || change > most)
      return differ(fmt::format("{}-cells more", i), std::to_string(change), *twins_[0],
                    fmt::format("{}, expected {} to {}", change, least, most));
  }
  return std::nullopt;
}

std::optional<Disagreement> Lockstep::compare_everything() const {
  try {
    std::vector<const MapTwin*> twins;
    for (const auto& twin : twins_) twins.push_back(twin.get());
    for (const AgreementRow& row : compare_twins(twins)) {
      if (row.agrees) continue;
      for (std::size_t k = 1; k < twins.size(); ++k)
        if (!row.answers[k].empty() && row.answers[k] != row.answers[0])
          return differ(row.what, row.answers[0], *twins[k], row.answers[k]);
      return differ(row.what, row.answers[0], *twins[0], "it should not");
    }
    const auto counts = twins_[0]->count_cells();
    for (std::size_t i = 0; i < cells_.size(); ++i)
      if (static_cast<long>(counts[i]) != cells_[i])
        return differ(fmt::format("{}-cells", i), std::to_string(counts[i]), *twins_[0],
                      fmt::format("{} by adding up what each operation changed", cells_[i]));
    const AlphaList alphas = twins_[0]->alphas();
    for (std::size_t k = core_count_; k < twins_.size(); ++k)
      if (!are_isomorphic(*twins_[k], alphas)) return differ("isomorphic to ours", "yes expected", *twins_[k], "no");
  } catch (const std::exception& error) {
    return Disagreement{0, "", "a twin threw", "no exception was expected", error.what()};
  }
  return std::nullopt;
}

}  // namespace dartboard
