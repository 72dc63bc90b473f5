#include "core/walks/embedding_lists.h"

namespace dartboard {

void EmbeddingList::push_back(std::uint32_t embedding, Dart dart) {
  if (nodes_.size() <= embedding) nodes_.resize(embedding + 1, {no_dart, end, end});
  nodes_[embedding] = {dart, last_, end};
  (last_ == end ? first_ : nodes_[last_].next) = embedding;
  last_ = embedding;
}

void EmbeddingList::erase(std::uint32_t embedding) {
  const Node node = nodes_[embedding];
  (node.previous == end ? first_ : nodes_[node.previous].next) = node.next;
  (node.next == end ? last_ : nodes_[node.next].previous) = node.previous;
  nodes_[embedding] = {no_dart, end, end};
}

void EmbeddingList::clear() {
  nodes_.clear();
  first_ = last_ = end;
}

}  // namespace dartboard
