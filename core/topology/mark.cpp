#include "core/topology/mark.h"

#include <algorithm>

namespace dartboard {
namespace {

// Epoch 0 is never current, so a stamp of 0 is unmarked for good.
void next_epoch(MarkPool::Stamps& s) {
  if (++s.epoch == 0) {
    std::fill(s.stamp.begin(), s.stamp.end(), 0u);
    s.epoch = 1;
  }
}

}  // namespace

MarkPool::Stamps& MarkPool::take(std::size_t dart_slots) {
  const auto idle = std::find_if(all_.begin(), all_.end(), [](const auto& s) { return !s->in_use; });
  Stamps& s = idle != all_.end() ? **idle : *all_.emplace_back(std::make_unique<Stamps>());
  s.in_use = true;
  s.stack.clear();
  if (s.stamp.size() < dart_slots) s.stamp.resize(dart_slots, 0u);
  next_epoch(s);
  return s;
}

void MarkPool::forget(Dart d) {
  for (auto& s : all_)
    if (d.index < s->stamp.size()) s->stamp[d.index] = 0;
}

std::size_t MarkPool::in_use() const {
  return static_cast<std::size_t>(std::count_if(all_.begin(), all_.end(), [](const auto& s) { return s->in_use; }));
}

void Mark::clear() { next_epoch(*stamps_); }

void Mark::grow(Dart d) { stamps_->stamp.resize(static_cast<std::size_t>(d.index) + 1 + d.index / 2, 0u); }

}  // namespace dartboard
