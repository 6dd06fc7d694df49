#pragma once

#include <mpi.h>

#include "parallel/regions.hpp"
#include "particles/particles.hpp"

namespace littoral::sph {

/// Divides space among the ranks by recursive coordinate bisection of the owned particles, an equal number
/// each (Zoltan, Boman et al. 2012). Cuts of an earlier call do not matter. Without any particle the first
/// rank has all of space. comm: collective. throws std::runtime_error: Zoltan failed (names its code)
template <int D>
Regions<D> bisect(const Particles<D>& particles, MPI_Comm comm);

}  // namespace littoral::sph
