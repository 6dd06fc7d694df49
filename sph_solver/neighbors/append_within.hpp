#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#if defined(__AVX512F__) && defined(__AVX512VL__)
#include <immintrin.h>
#endif

namespace littoral::sph {

constexpr std::size_t k_append_room = 8;  // places behind the last candidate that append_within may overwrite

/// Appends to `row` those of the candidates order[begin, end), at x_sorted[.][begin, end), that lie within
/// the reach of x, `self` excepted, in their order; returns their number. Without branches; eight at a time
/// where the machine can pack the survivors of a comparison. `row` must have room for all candidates and
/// k_append_room more.
template <int D>
std::size_t append_within(const std::array<std::vector<double>, D>& x_sorted, const std::int32_t* order,
                          const std::array<double, D>& x, double reach_squared, std::int32_t self,
                          std::size_t begin, std::size_t end, std::int32_t* row) {
  std::size_t n = 0, k = begin;
#if defined(__AVX512F__) && defined(__AVX512VL__)
  for (; k < end; k += 8) {
    const auto inside = static_cast<__mmask8>(end - k >= 8 ? 0xff : (1u << (end - k)) - 1u);
    __m512d r2 = _mm512_setzero_pd();
    for (std::size_t d = 0; d < D; ++d) {
      const __m512d apart =
          _mm512_sub_pd(_mm512_maskz_loadu_pd(inside, x_sorted[d].data() + k), _mm512_set1_pd(x[d]));
      r2 = _mm512_fmadd_pd(apart, apart, r2);
    }
    const __m256i j = _mm256_maskz_loadu_epi32(inside, order + k);
    __mmask8 kept = _mm512_mask_cmp_pd_mask(inside, r2, _mm512_set1_pd(reach_squared), _CMP_LT_OQ);
    kept = _mm256_mask_cmpneq_epi32_mask(kept, j, _mm256_set1_epi32(self));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(row + n), _mm256_maskz_compress_epi32(kept, j));
    n += static_cast<std::size_t>(__builtin_popcount(kept));
  }
#else
  for (; k < end; ++k) {
    double r2 = 0.0;
    for (std::size_t d = 0; d < D; ++d) r2 += (x_sorted[d][k] - x[d]) * (x_sorted[d][k] - x[d]);
    const std::int32_t j = order[k];
    row[n] = j;
    n += static_cast<std::size_t>(static_cast<int>(r2 < reach_squared) & static_cast<int>(j != self));
  }
#endif
  return n;
}

}  // namespace littoral::sph
