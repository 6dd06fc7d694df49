#pragma once

#include "bodies/wall_list.hpp"
#include "physics/gradients.hpp"

namespace littoral::sph {

/// Gradient of the pressure next to walls (S13): each dummy adds what the wall knows, the slope along its
/// normal, rho (f - a_w) . n = s, to the least squares (S3):
///   (sum_j V_j x_ij grad W_ij + sum_w V_w (x_iw . n)^2 F_iw n n^T) grad p = sum_j V_j p_ij grad W_ij
///                                                                  + sum_w V_w (x_iw . n)^2 F_iw s n,
/// exact for water at rest; a row of particles on a floor has a gradient along it. Velocities keep (S3).
/// out   known: both sums over w, a row of the list each     comm  local
template <int D>
void find_known_slopes(const Particles<D>& particles, const std::vector<Body>& bodies,
                       const Dummies<D>& dummies, const WallList<D>& list,
                       const RowAccelerations<D>& mass_force, double kernel_radius, KnownSlopes<D>& known);

extern template void find_known_slopes<2>(const Particles<2>&, const std::vector<Body>&, const Dummies<2>&,
                                          const WallList<2>&, const RowAccelerations<2>&, double,
                                          KnownSlopes<2>&);
extern template void find_known_slopes<3>(const Particles<3>&, const std::vector<Body>&, const Dummies<3>&,
                                          const WallList<3>&, const RowAccelerations<3>&, double,
                                          KnownSlopes<3>&);

}  // namespace littoral::sph
