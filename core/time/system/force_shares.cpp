#include "core/time/system/force_shares.h"

#include <algorithm>
#include <numeric>

#include "core/base/bytes.h"
#include "core/base/thread_team.h"

namespace dartboard {
namespace {

// Of one thread [ns]: a spring four at a time, an element, a vertex where forces become accelerations.
constexpr double spring_ns = 3.0, piece_ns = 60.0, vertex_ns = 2.0;
// Below this, waking a thread twice for every evaluation costs more than it saves.
constexpr double worth_sharing_ns = 150e3;
// Springs are looked at by so many: a thread adds them four at a time where none of them belongs to another.
constexpr std::uint32_t springs_at_once = 8;

/// The runs of pieces with a vertex within `own`; those of a block of pieces are alike.
template <class Nodes>
std::vector<PieceRun> runs_at(VertexRange own, std::uint32_t count, std::uint32_t block, const Nodes& nodes_of) {
  std::vector<PieceRun> runs;
  for (std::uint32_t first = 0; first < count; first += block) {
    const std::uint32_t last = std::min(count, first + block);
    bool all = true, any = false;
    for (std::uint32_t k = first; k < last; ++k)
      for (const std::uint32_t node : nodes_of(k)) {
        const bool is_own = own.contains(node);
        all = all && is_own;
        any = any || is_own;
      }
    if (!any) continue;
    if (!runs.empty() && runs.back().last == first && runs.back().whole == all)
      runs.back().last = last;
    else
      runs.push_back({first, last, all});
  }
  runs.shrink_to_fit();
  return runs;
}

/// Ranges of vertices with about the same sum of weights.
std::vector<VertexRange> ranges_of(const std::vector<double>& weight, unsigned threads) {
  const double whole = std::accumulate(weight.begin(), weight.end(), 0.0);
  std::vector<VertexRange> ranges;
  double sum = 0.0;
  std::uint32_t first = 0;
  for (std::uint32_t i = 0; i < weight.size(); ++i) {
    sum += weight[i];
    if (ranges.size() + 1 < threads && sum >= whole * static_cast<double>(ranges.size() + 1) / threads) {
      ranges.push_back({first, i + 1});
      first = i + 1;
    }
  }
  ranges.push_back({first, static_cast<std::uint32_t>(weight.size())});
  ranges.resize(threads, {ranges.back().last, ranges.back().last});
  return ranges;
}

}  // namespace

std::vector<ForceShare> share_forces(const SpringSystem& system) {
  const unsigned threads = threads_in_use();
  if (threads == 1) return {};
  double work = spring_ns * static_cast<double>(system.ends.size());
  for (const ForceTerm* term : system.terms)
    if (term->adds_in_parts()) work += piece_ns * static_cast<double>(term->size());
  if (work < worth_sharing_ns) return {};

  std::vector<double> weight(system.vertex_count(), vertex_ns);
  for (const SpringEnds& ends : system.ends)
    for (const std::uint32_t i : ends) weight[i] += spring_ns / 2;
  for (const ForceTerm* term : system.terms)
    for (std::size_t k = 0; term->adds_in_parts() && k < term->size(); ++k)
      for (const std::uint32_t i : term->nodes(k)) weight[i] += piece_ns / static_cast<double>(term->nodes(k).size());

  std::vector<ForceShare> shares;
  for (const VertexRange own : ranges_of(weight, threads)) {
    ForceShare& share = shares.emplace_back();
    share.own = own;
    share.springs = runs_at(own, static_cast<std::uint32_t>(system.ends.size()), springs_at_once,
                            [&](std::uint32_t k) { return ForceTerm::Nodes(system.ends[k]); });
    for (const ForceTerm* term : system.terms)
      share.pieces.push_back(term->adds_in_parts() ? runs_at(own, static_cast<std::uint32_t>(term->size()), 1,
                                                             [&](std::uint32_t k) { return term->nodes(k); })
                                                   : std::vector<PieceRun>{});
  }
  return shares;
}

std::size_t bytes_of_shares(const std::vector<ForceShare>& shares) {
  std::size_t sum = 0;
  for (const ForceShare& share : shares) {
    sum += bytes_of(share.springs);
    for (const auto& pieces : share.pieces) sum += bytes_of(pieces);
  }
  return sum;
}

}  // namespace dartboard
