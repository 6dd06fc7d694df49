#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "parallel/regions.hpp"
#include "particles/particles.hpp"

namespace littoral::sph {

/// What goes where: the owned particles that stand in another rank's part of space.
struct MigrationPlan {
  std::vector<std::vector<std::int32_t>> to;  // (ranks) indices, ascending
  std::vector<char> leaves;                   // (n_owned)
  std::size_t n_leaving = 0;
};

/// pure
template <int D>
MigrationPlan plan_migration(const Particles<D>& particles, const Regions<D>& regions, std::size_t rank);

/// Bytes of every column, owned ones included, of the particles `which`, column after column.
/// out: appended to `bytes`
template <int D>
void pack_particles(const Particles<D>& particles, const std::vector<std::int32_t>& which,
                    std::vector<char>& bytes);
std::size_t particle_bytes(int dimension);  ///< of one packed particle
/// Appends n packed particles to the owned ones, ids and all. The memory of a search among the partner's
/// cells does not come along: another rank has other cells. returns the end of what was read. Copies are
/// dropped
template <int D>
const char* unpack_particles(const char* bytes, std::size_t n, Particles<D>& particles);

}  // namespace littoral::sph
