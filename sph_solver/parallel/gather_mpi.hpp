#pragma once

#include <mpi.h>

#include <cstdint>
#include <vector>

#include "particles/particles.hpp"

namespace littoral::sph {

/// The owned particles of all ranks on rank 0, in the order of the ranks; nothing elsewhere.
/// counts: of each rank (on rank 0). comm: collective
template <int D>
Particles<D> gather_on_root(const Particles<D>& particles, MPI_Comm comm,
                            std::vector<std::int64_t>* counts = nullptr);
/// Of each rank only the chosen ones.
template <int D>
Particles<D> gather_on_root(const Particles<D>& particles, const std::vector<std::int32_t>& chosen,
                            MPI_Comm comm, std::vector<std::int64_t>* counts = nullptr);

}  // namespace littoral::sph
