#pragma once

#include "boundary/domain_box.hpp"
#include "parallel/other_ranks.hpp"
#include "particles/particles.hpp"
#include "physics/numerics.hpp"

namespace littoral::sph {

/// Moves the particles of a lattice to an even distribution off its rows: each by a random fraction of the
/// spacing, then all along the shift (14)-(15) until it has spread them. A lattice has directions in which a
/// flow strains it apart all at once, and the pressures and velocities this makes cost the flow energy; a
/// relaxed distribution has none. The same for any number of threads and ranks.
/// in, out  particles.x; copies dropped. States are those of the old places: set them anew
/// pre      water fills the domain, which has no open side; ids count from 0 without a gap over all ranks
/// comm     collective over `others`, if there are any
template <int D>
void relax(Particles<D>& particles, const Numerics<D>& numerics, const DomainBox<D>& box,
           OtherRanks<D>* others = nullptr);

extern template void relax<2>(Particles<2>&, const Numerics<2>&, const DomainBox<2>&, OtherRanks<2>*);
extern template void relax<3>(Particles<3>&, const Numerics<3>&, const DomainBox<3>&, OtherRanks<3>*);

}  // namespace littoral::sph
