#include "core/topology/mark.h"

#include <algorithm>

namespace dartboard {

void MarkPool::Bits::make_room(std::size_t count) {
  if (words.size() >= count) return;
  words.resize(count, 0);
  used.resize(count / 8 + 64);
}

MarkPool::Bits& MarkPool::take(std::size_t dart_slots) {
  const auto idle = std::find_if(all_.begin(), all_.end(), [](const auto& bits) { return !bits->in_use; });
  Bits& bits = idle != all_.end() ? **idle : *all_.emplace_back(std::make_unique<Bits>());
  bits.in_use = true;
  bits.stack.clear();
  bits.make_room((dart_slots + 15) / 16);
  return bits;
}

void MarkPool::forget(Dart d) {
  for (auto& bits : all_)
    if (d.index / 16 < bits->words.size())
      bits->words[d.index / 16] &= static_cast<std::uint16_t>(~(1u << d.index % 16));
}

std::size_t MarkPool::in_use() const {
  return static_cast<std::size_t>(
      std::count_if(all_.begin(), all_.end(), [](const auto& bits) { return bits->in_use; }));
}

void Mark::add_words(std::uint32_t at) {
  bits_->make_room(std::size_t{at} + 1 + at / 2);
  look();
}

void Mark::clear_all() {
  std::fill_n(words_, word_count_, std::uint16_t{0});
  is_list_whole_ = true;
  used_count_ = 0;
}

}  // namespace dartboard
