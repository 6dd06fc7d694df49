#pragma once

#include <mpi.h>

#include "parallel/regions.hpp"
#include "particles/particles.hpp"

namespace littoral::sph {

/// Sends the owned particles that stand in another rank's part of space there; the newcomers stand behind the
/// others, in the order of the ranks they come from. Copies are dropped where particles came or went.
/// returns the number that left. comm: collective
template <int D>
std::size_t migrate(Particles<D>& particles, const Regions<D>& regions, MPI_Comm comm);

}  // namespace littoral::sph
