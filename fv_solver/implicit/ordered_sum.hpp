#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace littoral::fv {

/// Below this many terms a loop is not worth waking threads for.
inline constexpr std::ptrdiff_t k_worth_threads = 16384;

/// Sums of several quantities over [0, n): add(begin, end, sums) adds the terms of a piece. The pieces and
/// the order in which they are added do not depend on the number of threads.
template <std::size_t M, class Add>
std::array<double, M> ordered_sums(std::ptrdiff_t n, Add&& add) {
  constexpr std::ptrdiff_t k_piece = 4096;
  const std::ptrdiff_t pieces = (n + k_piece - 1) / k_piece;
  std::vector<std::array<double, M>> part(static_cast<std::size_t>(pieces), std::array<double, M>{});
#pragma omp parallel for schedule(static) if (n > k_worth_threads)
  for (std::ptrdiff_t k = 0; k < pieces; ++k)
    add(k * k_piece, std::min(n, (k + 1) * k_piece), part[static_cast<std::size_t>(k)]);
  std::array<double, M> sum{};
  for (const auto& p : part)
    for (std::size_t m = 0; m < M; ++m) sum[m] += p[m];
  return sum;
}

}  // namespace littoral::fv
