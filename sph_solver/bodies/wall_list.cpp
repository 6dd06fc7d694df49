#include "bodies/wall_list.hpp"

#include <algorithm>

namespace littoral::sph {

template <int D>
void WallList<D>::build(const Particles<D>& particles, const Dummies<D>& dummies,
                        const std::vector<Body>& bodies, const Sheets<D>& sheets, double reach) {
  grid_.bin(dummies.x(), dummies.size(), 0.5 * reach);
  const auto& order = grid_.order();
  const auto n = static_cast<std::ptrdiff_t>(particles.n_owned);
  const auto each = [&](std::size_t i, const auto& f) {
    std::array<double, D> x;
    for (std::size_t d = 0; d < D; ++d) x[d] = particles.x[d][i];
    grid_.for_each_range(x, reach, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        const auto e = static_cast<std::size_t>(order[k]);
        double r2 = 0.0;
        for (std::size_t d = 0; d < D; ++d) r2 += (dummies[e].x[d] - x[d]) * (dummies[e].x[d] - x[d]);
        if (r2 < reach * reach && (sheets.none() || sheets.shows(bodies, dummies, e, x))) f(order[k]);
      }
    });
  };
  std::vector<std::int32_t> count(particles.n_owned, 0);
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t i = 0; i < n; ++i)
    each(static_cast<std::size_t>(i), [&](std::int32_t) { ++count[static_cast<std::size_t>(i)]; });

  particle_.clear();
  row_of_.assign(particles.n_owned, -1);
  start_.assign(1, 0);
  for (std::size_t i = 0; i < particles.n_owned; ++i) {
    if (count[i] == 0) continue;
    row_of_[i] = static_cast<std::int32_t>(particle_.size());
    particle_.push_back(static_cast<std::int32_t>(i));
    start_.push_back(start_.back() + static_cast<std::size_t>(count[i]));
  }
  list_.resize(start_.back());
  const auto rows = static_cast<std::ptrdiff_t>(n_rows());
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t k = 0; k < rows; ++k) {
    const auto row = static_cast<std::size_t>(k);
    std::size_t fill = start_[row];
    each(particle(row), [&](std::int32_t e) { list_[fill++] = e; });
    std::stable_sort(
        list_.begin() + static_cast<std::ptrdiff_t>(start_[row]),
        list_.begin() + static_cast<std::ptrdiff_t>(start_[row + 1]), [&](std::int32_t a, std::int32_t b) {
          return dummies[static_cast<std::size_t>(a)].body < dummies[static_cast<std::size_t>(b)].body;
        });
  }
}

template class WallList<2>;
template class WallList<3>;

}  // namespace littoral::sph
