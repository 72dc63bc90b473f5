#pragma once
// Functions that use AVX2 where the processor has it, whatever the flags of the build.

#if defined(__x86_64__)
#include <immintrin.h>
#define DARTBOARD_HAS_AVX2 1
// FMA is not among them, as it would change bits.
#define DARTBOARD_AVX2 __attribute__((target("avx2")))
#define DARTBOARD_AVX2_INLINE __attribute__((target("avx2"), always_inline)) inline
#endif

namespace dartboard {

/// Does this processor have it? Never where functions cannot be compiled for it.
inline bool has_avx2() {
#ifdef DARTBOARD_HAS_AVX2
  __builtin_cpu_init();
  return __builtin_cpu_supports("avx2") != 0;
#else
  return false;
#endif
}

}  // namespace dartboard
