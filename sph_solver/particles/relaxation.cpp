#include "particles/relaxation.hpp"

#include <algorithm>
#include <numeric>
#include <random>

#include "boundary/ghosts.hpp"
#include "neighbors/neighbor_list.hpp"
#include "physics/shifting.hpp"

namespace littoral::sph {
namespace {

// Disorder of half a spacing either way: .19 dx rms off the rows once spread. A sweep moves a particle by .1
// R times the vector (15), at most .025 R. Afterwards the spread of sum V W is that of a lattice (.0014
// against .0012, R = 4 dx) and the vector (15) is .0012.
constexpr double k_disorder = 0.5;
constexpr double k_step = 0.1;
constexpr int k_sweeps = 200;
constexpr double k_mirror_tolerance = 0.5;  // of dx

/// Random displacements, drawn in the order of the ids.
template <int D>
void disorder(Particles<D>& particles, double most) {
  std::vector<std::int32_t> by_id(particles.n_owned);
  std::iota(by_id.begin(), by_id.end(), 0);
  const auto id = [&](std::int32_t i) { return particles.id[static_cast<std::size_t>(i)]; };
  std::sort(by_id.begin(), by_id.end(), [&](std::int32_t a, std::int32_t b) { return id(a) < id(b); });
  std::mt19937 random(1);  // its sequence is fixed by the standard, that of a distribution is not
  const double to_unit = 2.0 / static_cast<double>(std::mt19937::max());
  std::int64_t next = 0;
  for (const std::int32_t i : by_id) {
    random.discard(static_cast<unsigned long long>((id(i) - next) * D));
    next = id(i) + 1;
    for (std::size_t d = 0; d < D; ++d)
      particles.x[d][static_cast<std::size_t>(i)] += most * (to_unit * static_cast<double>(random()) - 1.0);
  }
}

}  // namespace

template <int D>
void relax(Particles<D>& particles, const Numerics<D>& numerics, const DomainBox<D>& box,
           OtherRanks<D>* others) {
  disorder(particles, k_disorder * numerics.spacing);
  Ghosts<D> ghosts(box, others);
  NeighborList<D> neighbors(numerics.kernel_radius, numerics.skin);
  const Shifting<D> shifting(1.0);
  for (int sweep = 0; sweep < k_sweeps; ++sweep) {
    ghosts.bring_back(particles, k_mirror_tolerance * numerics.spacing, 0.0);
    if (others != nullptr) others->migrate(particles);
    ghosts.create(particles, neighbors.reach());
    neighbors.build(particles);
    shifting.compute(particles, neighbors, nullptr);
    for (std::size_t d = 0; d < D; ++d)
      for (std::size_t i = 0; i < particles.n_owned; ++i)
        particles.x[d][i] += k_step * numerics.kernel_radius * particles.shift[d][i];
  }
  ghosts.bring_back(particles, k_mirror_tolerance * numerics.spacing, 0.0);
  particles.drop_ghosts();
}

template void relax<2>(Particles<2>&, const Numerics<2>&, const DomainBox<2>&, OtherRanks<2>*);
template void relax<3>(Particles<3>&, const Numerics<3>&, const DomainBox<3>&, OtherRanks<3>*);

}  // namespace littoral::sph
