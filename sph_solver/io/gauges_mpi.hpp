#pragma once

#include <mpi.h>

#include <vector>

#include "boundary/domain_box.hpp"
#include "io/gauges.hpp"

namespace littoral::sph {

/// gauge_values() of a run on several ranks: the particles around the gauges are brought to rank 0 and
/// evaluated there, in the order of their ids. Nothing on the other ranks. comm: collective
template <int D>
std::vector<double> gauge_values_on_root(const std::vector<GaugeConfig>& gauges,
                                         const Particles<D>& particles, const DomainBox<D>& box,
                                         const NeighborList<D>& neighbors, double spacing, MPI_Comm comm,
                                         const Walls<D>* walls = nullptr,
                                         const std::vector<double>& sensed = {});

/// Owned particles that lie within `reach` of a gauge, themselves or through one of their images. pure
template <int D>
std::vector<std::int32_t> near_gauges(const std::vector<GaugeConfig>& gauges, const Particles<D>& particles,
                                      const DomainBox<D>& box, double reach);

}  // namespace littoral::sph
