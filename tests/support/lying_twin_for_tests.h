#pragma once
// A carrier that answers one question wrongly, and all others as the twin behind it.

#include <functional>
#include <memory>
#include <utility>

#include "validation/cgal/map_twin.h"

namespace dartboard {

/// Functions that replace the answers; an empty function means the true answer.
struct Lies {
  std::function<std::size_t(std::size_t)> dart_count{};
  std::function<bool(Dart, bool)> is_live{};
  std::function<Dart(int, Dart, Dart)> alpha{};                  // i, the dart, the true answer
  std::function<void(Involutions, std::vector<Dart>&)> orbit{};  // changes the list
  std::function<void(std::vector<std::size_t>&)> count_cells{};  // changes the counts
  std::function<std::optional<bool>(std::optional<bool>)> is_orientable{};
  std::function<std::string()> violation{}, violation_near{};
  std::function<bool(bool)> can_sew{};
  std::function<void(SplitCounts&)> dissociate{};
};

class LyingTwin final : public MapTwin {
 public:
  LyingTwin(std::unique_ptr<MapTwin> honest, Lies lies) : honest_(std::move(honest)), lies_(std::move(lies)) {}

  std::string library() const override { return "liar"; }
  int dimension() const override { return honest_->dimension(); }
  std::size_t dart_count() const override {
    return lies_.dart_count ? lies_.dart_count(honest_->dart_count()) : honest_->dart_count();
  }
  bool is_live(Dart d) const override {
    return lies_.is_live ? lies_.is_live(d, honest_->is_live(d)) : honest_->is_live(d);
  }
  std::vector<Dart> darts() const override { return honest_->darts(); }
  Dart alpha(int i, Dart d) const override {
    return lies_.alpha ? lies_.alpha(i, d, honest_->alpha(i, d)) : honest_->alpha(i, d);
  }
  bool can_walk(Involutions set) const override { return honest_->can_walk(set); }
  void orbit(Involutions set, Dart d, std::vector<Dart>& darts) const override {
    honest_->orbit(set, d, darts);
    if (lies_.orbit) lies_.orbit(set, darts);
  }
  std::vector<std::size_t> count_cells() const override {
    auto counts = honest_->count_cells();
    if (lies_.count_cells) lies_.count_cells(counts);
    return counts;
  }
  std::optional<bool> is_orientable() const override {
    return lies_.is_orientable ? lies_.is_orientable(honest_->is_orientable()) : honest_->is_orientable();
  }
  std::string violation() const override { return lies_.violation ? lies_.violation() : honest_->violation(); }
  std::string violation_near(std::span<const Dart> darts) const override {
    return lies_.violation_near ? lies_.violation_near() : honest_->violation_near(darts);
  }
  bool can_carry_sew(int i, Dart a, Dart b) const override { return honest_->can_carry_sew(i, a, b); }
  bool can_carry_unsew(int i) const override { return honest_->can_carry_unsew(i); }
  bool can_carry(CellKind kind) const override { return honest_->can_carry(kind); }
  bool can_sew(int i, Dart a, Dart b) const override {
    const bool verdict = honest_->can_sew(i, a, b);
    return lies_.can_sew ? lies_.can_sew(verdict) : verdict;
  }
  bool refuses_folds() const override { return honest_->refuses_folds(); }
  void sew(int i, Dart a, Dart b) override { honest_->sew(i, a, b); }
  void unsew(int i, Dart d) override { honest_->unsew(i, d); }
  SplitCounts dissociate(Dart d) override {
    SplitCounts split = honest_->dissociate(d);
    if (lies_.dissociate) lies_.dissociate(split);
    return split;
  }
  void add(CellKind kind, Dart first) override { honest_->add(kind, first); }
  void remove(Dart d) override { honest_->remove(d); }

 private:
  std::unique_ptr<MapTwin> honest_;
  Lies lies_;
};

}  // namespace dartboard
