#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "boundary/domain_box.hpp"
#include "parallel/regions.hpp"
#include "particles/particles.hpp"

namespace littoral::sph {

/// What a rank tells all others before the halo is made.
template <int D>
struct HaloBoxes {
  RankBox<D> holds;  // its owned particles
  RankBox<D> wants;  // the points around which its halo must be complete
};

/// The periodic displacements of a domain, the zero one first [m].
template <int D>
std::vector<std::array<double, D>> periodic_shifts(const DomainBox<D>& box);

/// True if particles of a rank that holds `from`, displaced by `shift`, may lie within `reach` of what the
/// other wants. Sender and receiver ask with the same numbers, so both know whether a message goes.
template <int D>
bool may_reach(const RankBox<D>& from, const std::array<double, D>& shift, const RankBox<D>& wants,
               double reach);

/// One copy that a neighbour gets: which particle, under which displacement.
struct HaloEntry {
  std::int32_t particle;
  std::int32_t shift;
};

/// Appends the owned particles that lie within `reach` of the box `wants`, under every displacement. pure
template <int D>
void choose_halo(const Particles<D>& particles, const HaloBoxes<D>& mine,
                 const std::vector<std::array<double, D>>& shifts, const RankBox<D>& wants, double reach,
                 std::vector<HaloEntry>& entries);

}  // namespace littoral::sph
