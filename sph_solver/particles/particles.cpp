#include "particles/particles.hpp"

#include <cassert>

namespace littoral::sph {
template <int D>
void Particles<D>::reserve(std::size_t n) {
  for_each_shared_column([n](auto& c) { c.reserve(n); });
  for_each_owned_column([n](auto& c) { c.reserve(n); });
}

template <int D>
void Particles<D>::resize_ghosts(std::size_t n) {
  n_ghost = n;
  for_each_shared_column([this](auto& c) { c.resize(size()); });
}

template <int D>
void Particles<D>::append(const NewParticle<D>& born) {
  ++revision;
  drop_ghosts();
  for (std::size_t d = 0; d < D; ++d) {
    x[d].push_back(born.x[d]);
    u[d].push_back(born.u[d]);
    normal[d].push_back(0.0);
    shift[d].push_back(0.0);
  }
  V.push_back(born.V);
  m.push_back(born.m);
  rho.push_back(born.m / born.V);
  p.push_back(born.p);
  zone.push_back(born.zone);
  surface.push_back(SurfaceFlag::none);
  id.push_back(next_id++);
  donor_hint.push_back(-1);
  ++n_owned;
}

template <int D>
void Particles<D>::remove(const std::vector<char>& doomed) {
  ++revision;
  assert(doomed.size() == n_owned);
  drop_ghosts();
  std::size_t n_kept = 0;
  const auto compact = [&doomed, &n_kept](auto& c) {
    n_kept = 0;
    for (std::size_t i = 0; i < doomed.size(); ++i)
      if (!doomed[i]) c[n_kept++] = c[i];
    c.resize(n_kept);
  };
  for_each_shared_column(compact);
  for_each_owned_column(compact);
  n_owned = n_kept;
}

template <int D>
void Particles<D>::permute(const std::vector<std::int32_t>& order) {
  ++revision;
  assert(order.size() == n_owned);
  drop_ghosts();
  const auto reorder = [&order](auto& c) {
    auto old = c;
    const auto n = static_cast<std::ptrdiff_t>(order.size());
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t k = 0; k < n; ++k)
      c[static_cast<std::size_t>(k)] = old[static_cast<std::size_t>(order[static_cast<std::size_t>(k)])];
  };
  for_each_shared_column(reorder);
  for_each_owned_column(reorder);
}

template struct Particles<2>;
template struct Particles<3>;

}  // namespace littoral::sph
