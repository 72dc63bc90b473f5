#include "benchmarks/studies/step/machine_limits.h"

#include <cmath>
#include <span>

#include "core/base/thread_team.h"
#include "core/topology/storage/hash.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace dartboard {
namespace {

constexpr std::size_t in_cache = 1024;  // springs: 16 KiB

void roots_one_by_one(std::span<const double> square, std::span<double> quotient) {
  for (std::size_t k = 0; k < square.size(); ++k) quotient[k] = 1.0 / std::sqrt(square[k]);
}

#if defined(__x86_64__)
__attribute__((target("avx2"))) void roots_in_lanes(const double* square, double* quotient) {
  for (std::size_t k = 0; k < in_cache; k += 4)
    _mm256_storeu_pd(quotient + k, _mm256_div_pd(_mm256_set1_pd(1.0), _mm256_sqrt_pd(_mm256_loadu_pd(square + k))));
}
#endif

void scale(double factor, std::span<const double> from, std::span<double> to) {
  const double* const read = from.data();
  double* const written = to.data();
  // a product, so that no library copies past the caches
  for (std::size_t k = 0; k < from.size(); ++k) written[k] = factor * read[k];
}

}  // namespace

RootsAndQuotients::RootsAndQuotients() : squares_(in_cache), quotients_(in_cache) {
  for (std::size_t k = 0; k < in_cache; ++k) squares_[k] = 0.01 + 1e-5 * static_cast<double>(k);
}

void RootsAndQuotients::run(std::size_t count) {
  for (std::size_t done = 0; done < count; done += in_cache) {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2")) {
      roots_in_lanes(squares_.data(), quotients_.data());
      continue;
    }
#endif
    roots_one_by_one(squares_, quotients_);
  }
}

std::uint64_t RootsAndQuotients::hash() const {
  Hash hash;
  hash.add(quotients_);
  return hash.value();
}

CopiedColumns::CopiedColumns(std::size_t bytes)
    : first_(bytes / (2 * sizeof(double)), 1.0), second_(first_.size(), 0.0) {}

void CopiedColumns::run(int passes) {
  for (int k = 0; k < passes; k += 2) {
    scale(2.0, first_, second_);
    scale(0.5, second_, first_);
  }
}

void CopiedColumns::run_by_threads(int passes) {
  ThreadTeam& team = thread_team();
  const std::size_t threads = team.size(), size = first_.size();
  for (int k = 0; k < passes; ++k)
    team.run([&](unsigned thread) {
      const std::size_t from = size * thread / threads, count = size * (thread + 1) / threads - from;
      const auto one = std::span(first_).subspan(from, count), other = std::span(second_).subspan(from, count);
      k % 2 == 0 ? scale(2.0, one, other) : scale(0.5, other, one);
    });
}

std::uint64_t CopiedColumns::hash() const {
  Hash hash;
  hash.add(first_);
  hash.add(second_);
  return hash.value();
}

}  // namespace dartboard
