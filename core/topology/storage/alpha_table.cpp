#include "core/topology/storage/alpha_table.h"

#include "core/base/cell_limits.h"
#include "core/topology/storage/hash.h"
#include "core/topology/storage/room.h"

namespace dartboard {
namespace {
constexpr std::uint32_t dead = 0xFFFFFFFF;
}

template <int N>
Dart AlphaTable<N>::add_dart() {
  const bool reuse = !free_.empty();
  const std::uint32_t slot = reuse ? free_.back() : static_cast<std::uint32_t>(capacity());
  require_room(slot, 1, most_darts(N), "darts");
  const std::uint32_t generation = ++births_;
  if (journal_) journal_->record({reuse ? Change::Kind::reuse : Change::Kind::append, slot, 0, generation});
  appear(slot, generation);
  return {slot};
}

template <int N>
void AlphaTable<N>::remove_dart(Dart d) {
  if (journal_) journal_->record({Change::Kind::remove, d.index, generation_[d.index], 0});
  vanish(d.index);
}

// A slot comes alive: either the last of the free ones or one past the end.
template <int N>
void AlphaTable<N>::appear(std::uint32_t slot, std::uint32_t generation) {
  if (slot == capacity()) {
    generation_.push_back(generation);
    alphas_.resize(alphas_.size() + N + 1);
  } else {
    free_.pop_back();
    generation_[slot] = generation;
  }
  for (int i = 0; i <= N; ++i) alphas_[at(i, {slot})] = slot;
}

template <int N>
void AlphaTable<N>::vanish(std::uint32_t slot) {
  generation_[slot] = 0;
  for (int i = 0; i <= N; ++i) alphas_[at(i, {slot})] = dead;
  free_.push_back(slot);
}

template <int N>
void AlphaTable<N>::undo(const Change& change) {
  switch (change.kind) {
    case Change::Kind::link: alphas_[change.where] = change.before; break;
    case Change::Kind::append:
      generation_.pop_back();
      alphas_.resize(alphas_.size() - (N + 1));
      break;
    case Change::Kind::reuse: vanish(change.where); break;
    case Change::Kind::remove: appear(change.where, change.before); break;
  }
}

template <int N>
void AlphaTable<N>::redo(const Change& change) {
  switch (change.kind) {
    case Change::Kind::link: alphas_[change.where] = change.after; break;
    case Change::Kind::append:
    case Change::Kind::reuse: appear(change.where, change.after); break;
    case Change::Kind::remove: vanish(change.where); break;
  }
}

template <int N>
std::uint64_t AlphaTable<N>::hash() const {
  Hash h;
  h.add(alphas_);
  h.add(generation_);
  h.add(free_);
  return h.value();
}

template class AlphaTable<2>;
template class AlphaTable<3>;

}  // namespace dartboard
