#include "particles/relaxation.hpp"

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

}  // namespace

template <int D>
void relax(Particles<D>& particles, const Numerics<D>& numerics, const DomainBox<D>& box) {
  std::mt19937 random(1);  // its sequence is fixed by the standard, that of a distribution is not
  const double to_unit = 2.0 / static_cast<double>(std::mt19937::max());
  for (std::size_t i = 0; i < particles.n_owned; ++i)
    for (std::size_t d = 0; d < D; ++d)
      particles.x[d][i] += k_disorder * numerics.spacing * (to_unit * static_cast<double>(random()) - 1.0);

  Ghosts<D> ghosts(box);
  NeighborList<D> neighbors(numerics.kernel_radius, numerics.skin);
  const Shifting<D> shifting(1.0, numerics.spacing);
  for (int sweep = 0; sweep < k_sweeps; ++sweep) {
    ghosts.bring_back(particles, k_mirror_tolerance * numerics.spacing, 0.0);
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

template void relax<2>(Particles<2>&, const Numerics<2>&, const DomainBox<2>&);
template void relax<3>(Particles<3>&, const Numerics<3>&, const DomainBox<3>&);

}  // namespace littoral::sph
