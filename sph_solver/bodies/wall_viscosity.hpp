#pragma once

#include "bodies/wall_fluxes.hpp"

namespace littoral::sph {

/// Friction on walls without slip (S14), the pair term (S8) with dummies whose velocity carries the
/// particle's on through the wall by its gradient and mirrors what is left at the wall about the wall's:
///   u_w = u_i + grad u_i . dx + 2 (u_wall - u_i - d grad u_i . n)
/// Exact for a linear shear; without gradient (spray) the mirror image alone. Both components count: the
/// mirrored normal one stops nothing that (S12) has not stopped.
/// in    gradients.u of the rows; sticks: of each body     out  rate and forces added to      comm  local
template <int D>
void add_wall_friction(const Particles<D>& particles, const Gradients<D>& gradients,
                       const std::vector<Body>& bodies, const Dummies<D>& dummies, const WallList<D>& list,
                       const Numerics<D>& numerics, const std::vector<char>& sticks, Rate<D>& rate,
                       RowForces<D>& forces);

extern template void add_wall_friction<2>(const Particles<2>&, const Gradients<2>&, const std::vector<Body>&,
                                          const Dummies<2>&, const WallList<2>&, const Numerics<2>&,
                                          const std::vector<char>&, Rate<2>&, RowForces<2>&);
extern template void add_wall_friction<3>(const Particles<3>&, const Gradients<3>&, const std::vector<Body>&,
                                          const Dummies<3>&, const WallList<3>&, const Numerics<3>&,
                                          const std::vector<char>&, Rate<3>&, RowForces<3>&);

}  // namespace littoral::sph
