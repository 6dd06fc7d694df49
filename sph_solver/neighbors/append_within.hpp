#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#if defined(__AVX512F__) && defined(__AVX512VL__)
#include <immintrin.h>
#endif

namespace littoral::sph {

constexpr std::size_t k_append_room = 8;  // places behind the last candidate that append_within may overwrite

/// Points, each with the straight way [m] it is about to go.
template <int D>
struct Paths {
  std::array<std::vector<double>, D> from, way;
};

/// Appends to `row` those of the candidates order[begin, end), on paths[begin, end), that come within `reach`
/// of one that goes from x by `way` meanwhile, at the same pace, `self` excepted, in their order; returns
/// their number. Without branches; eight at a time where the machine can pack the survivors of a comparison.
/// `row` must have room for all candidates and k_append_room more.
template <int D>
std::size_t append_within(const Paths<D>& paths, const std::int32_t* order, const std::array<double, D>& x,
                          const std::array<double, D>& way, double reach, std::int32_t self,
                          std::size_t begin, std::size_t end, std::int32_t* row) {
  constexpr double k_tiny = 1e-300;  // way^2 of those that go together
  std::size_t n = 0, k = begin;
#if defined(__AVX512F__) && defined(__AVX512VL__)
  for (; k < end; k += 8) {
    const auto inside = static_cast<__mmask8>(end - k >= 8 ? 0xff : (1u << (end - k)) - 1u);
    __m512d r2 = _mm512_setzero_pd(), along = r2, way2 = r2;
    for (std::size_t d = 0; d < D; ++d) {
      const auto difference = [&](const std::vector<double>& column, double mine) {
        return _mm512_sub_pd(_mm512_maskz_loadu_pd(inside, column.data() + k), _mm512_set1_pd(mine));
      };
      const __m512d apart = difference(paths.from[d], x[d]), w = difference(paths.way[d], way[d]);
      r2 = _mm512_fmadd_pd(apart, apart, r2);
      along = _mm512_fmadd_pd(apart, w, along);
      way2 = _mm512_fmadd_pd(w, w, way2);
    }
    // closest at the part s of the way, 0 to 1: |apart + s w|^2
    __m512d s = _mm512_div_pd(along, _mm512_maskz_max_pd(inside, way2, _mm512_set1_pd(k_tiny)));
    s = _mm512_maskz_min_pd(
        inside, _mm512_maskz_max_pd(inside, _mm512_sub_pd(_mm512_setzero_pd(), s), _mm512_setzero_pd()),
        _mm512_set1_pd(1.0));
    r2 = _mm512_fmadd_pd(s, _mm512_fmadd_pd(s, way2, _mm512_add_pd(along, along)), r2);
    const __m256i j = _mm256_maskz_loadu_epi32(inside, order + k);
    __mmask8 kept = _mm512_mask_cmp_pd_mask(inside, r2, _mm512_set1_pd(reach * reach), _CMP_LT_OQ);
    kept = _mm256_mask_cmpneq_epi32_mask(kept, j, _mm256_set1_epi32(self));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(row + n), _mm256_maskz_compress_epi32(kept, j));
    n += static_cast<std::size_t>(__builtin_popcount(kept));
  }
#else
  for (; k < end; ++k) {
    double r2 = 0.0, along = 0.0, way2 = 0.0;
    for (std::size_t d = 0; d < D; ++d) {
      const double apart = paths.from[d][k] - x[d], w = paths.way[d][k] - way[d];
      r2 += apart * apart;
      along += apart * w;
      way2 += w * w;
    }
    // closest at the part s of the way: |apart + s w|^2
    const double s = std::clamp(-along / std::max(way2, k_tiny), 0.0, 1.0);
    r2 += s * (2.0 * along + s * way2);
    const std::int32_t j = order[k];
    row[n] = j;
    n += static_cast<std::size_t>(static_cast<int>(r2 < reach * reach) & static_cast<int>(j != self));
  }
#endif
  return n;
}

}  // namespace littoral::sph
