#pragma once
// What the processor and its memory allow a loop over springs: work of which no order of springs can leave anything
// out.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dartboard {

/// One square root and one division for each of some springs, all within the first cache; four at a time where the
/// processor has AVX2.
class RootsAndQuotients {
 public:
  RootsAndQuotients();
  /// For `count` springs, a multiple of 1024.
  void run(std::size_t count);
  std::uint64_t hash() const;

 private:
  std::vector<double> squares_, quotients_;
};

/// Columns that are read and written in turn: each pass reads one half of them and writes the other.
class CopiedColumns {
 public:
  /// `bytes` are those of both halves.
  explicit CopiedColumns(std::size_t bytes);
  /// An even number of passes, so that the numbers are what they were.
  void run(int passes);
  /// Passes by the threads in use, each with a part of its own.
  /// pre  threads_in_use() > 1
  void run_by_threads(int passes);
  std::size_t bytes() const { return 2 * sizeof(double) * first_.size(); }
  std::uint64_t hash() const;

 private:
  std::vector<double> first_, second_;
};

}  // namespace dartboard
