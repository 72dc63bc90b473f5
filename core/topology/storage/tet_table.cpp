#include "core/topology/storage/tet_table.h"

#include "core/base/cell_limits.h"
#include "core/topology/storage/hash.h"
#include "core/topology/storage/room.h"

namespace dartboard {
namespace {

constexpr std::uint32_t itself(std::uint32_t s) { return s << 3; }
constexpr std::uint32_t nothing = 0xFFFFFFFF;

// The turn that takes dart 0 of a face to dart e of the opposite one, given that dart r goes to dart q. Around the two
// faces the numbers run the same way (e even) or against each other (e odd).
constexpr std::uint32_t turn(std::uint32_t r, std::uint32_t q) {
  return (q + r) % 2 == 0 ? (q + 6 - r) % 6 : (q + r) % 6;
}

}  // namespace

Dart TetTable::add_tetrahedron() {
  const bool reuse = !free_.empty();
  const std::uint32_t t = reuse ? free_.back() : static_cast<std::uint32_t>(generation_.size());
  require_room(t, 1, most_tetrahedra, "tetrahedra");
  const std::uint32_t generation = ++births_;
  if (journal_) journal_->record({reuse ? Change::Kind::reuse : Change::Kind::append, t, 0, generation});
  appear(t, generation);
  return {24 * t};
}

void TetTable::remove_tetrahedron(Dart d) {
  const std::uint32_t t = d.index / 24;
  if (journal_) journal_->record({Change::Kind::remove, t, generation_[t], 0});
  vanish(t);
}

void TetTable::link(int, Dart a, Dart b) {
  const std::uint32_t s = a.index / 6, r = a.index % 6, z = b.index / 6, q = b.index % 6;
  write(s, 8 * z + turn(r, q));
  if (z != s) write(z, 8 * s + turn(q, r));
}

void TetTable::appear(std::uint32_t t, std::uint32_t generation) {
  if (t == generation_.size()) {
    generation_.push_back(generation);
    opposite_.resize(opposite_.size() + 4);
  } else {
    free_.pop_back();
    generation_[t] = generation;
  }
  for (std::uint32_t s = 4 * t; s < 4 * t + 4; ++s) opposite_[s] = itself(s);
}

void TetTable::vanish(std::uint32_t t) {
  generation_[t] = 0;
  for (std::uint32_t s = 4 * t; s < 4 * t + 4; ++s) opposite_[s] = nothing;
  free_.push_back(t);
}

void TetTable::undo(const Change& change) {
  switch (change.kind) {
    case Change::Kind::link: opposite_[change.where] = change.before; break;
    case Change::Kind::append:
      generation_.pop_back();
      opposite_.resize(opposite_.size() - 4);
      break;
    case Change::Kind::reuse: vanish(change.where); break;
    case Change::Kind::remove: appear(change.where, change.before); break;
  }
}

void TetTable::redo(const Change& change) {
  switch (change.kind) {
    case Change::Kind::link: opposite_[change.where] = change.after; break;
    case Change::Kind::append:
    case Change::Kind::reuse: appear(change.where, change.after); break;
    case Change::Kind::remove: vanish(change.where); break;
  }
}

std::uint64_t TetTable::hash() const {
  Hash h;
  h.add(opposite_);
  h.add(generation_);
  h.add(free_);
  return h.value();
}

}  // namespace dartboard
