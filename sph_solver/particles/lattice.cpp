#include "particles/lattice.hpp"

#include <cmath>

#include "boundary/domain_box.hpp"

namespace littoral::sph {

template <int D>
void fill_lattice(const std::array<double, D>& lower, const std::array<double, D>& upper, double spacing,
                  const support::Scene& scene, const LinearEos& eos, Particles<D>& particles,
                  const LatticeShare& share, const Walls<D>* walls) {
  constexpr double k_round_off = 1e-9;  // a row whose centre lies on the upper face to round-off stays out
  const auto& start = scene.initial;
  std::array<long, D> n;
  long total = 1;
  for (std::size_t d = 0; d < D; ++d) {
    n[d] = std::max(0L, std::lround(std::floor((upper[d] - lower[d]) / spacing + 0.5 - k_round_off)));
    total *= n[d];
  }
  const long first = total * share.rank / share.size, last = total * (share.rank + 1) / share.size;
  for (long place = 0; place < total; ++place) {
    NewParticle<D> born;
    std::array<double, 3> x{};
    long rest = place;
    for (std::size_t d = D; d-- > 0; rest /= n[d]) {
      born.x[d] = lower[d] + (static_cast<double>(rest % n[d]) + 0.5) * spacing;
      x[scene_axis<D>(d)] = born.x[d];
    }
    if (start.surface && !((*start.surface)(x[0], x[1], x[2], 0.0) < 0.0)) continue;
    if (walls != nullptr && walls->inside(born.x)) continue;
    if (place < first || place >= last) {
      ++particles.next_id;
      continue;
    }
    const std::array<const support::Formula*, 3> velocity = {&start.u, &start.v, &start.w};
    for (std::size_t d = 0; d < D; ++d) born.u[d] = (*velocity[scene_axis<D>(d)])(x[0], x[1], x[2], 0.0);
    born.p = start.p(x[0], x[1], x[2], 0.0);
    born.V = std::pow(spacing, D);
    born.m = eos.density(born.p) * born.V;
    particles.append(born);
  }
}

template <int D>
void set_start_states(const support::Scene& scene, const LinearEos& eos, Particles<D>& particles) {
  const auto& start = scene.initial;
  const std::array<const support::Formula*, 3> velocity = {&start.u, &start.v, &start.w};
  for (std::size_t i = 0; i < particles.n_owned; ++i) {
    std::array<double, 3> x{};
    for (std::size_t d = 0; d < D; ++d) x[scene_axis<D>(d)] = particles.x[d][i];
    for (std::size_t d = 0; d < D; ++d)
      particles.u[d][i] = (*velocity[scene_axis<D>(d)])(x[0], x[1], x[2], 0.0);
    particles.p[i] = start.p(x[0], x[1], x[2], 0.0);
    particles.rho[i] = eos.density(particles.p[i]);
    particles.m[i] = particles.rho[i] * particles.V[i];
  }
}

template void set_start_states<2>(const support::Scene&, const LinearEos&, Particles<2>&);
template void set_start_states<3>(const support::Scene&, const LinearEos&, Particles<3>&);
template void fill_lattice<2>(const std::array<double, 2>&, const std::array<double, 2>&, double,
                              const support::Scene&, const LinearEos&, Particles<2>&, const LatticeShare&,
                              const Walls<2>*);
template void fill_lattice<3>(const std::array<double, 3>&, const std::array<double, 3>&, double,
                              const support::Scene&, const LinearEos&, Particles<3>&, const LatticeShare&,
                              const Walls<3>*);

}  // namespace littoral::sph
