#pragma once

#include <cstddef>
#include <cstdint>

#include "neighbors/neighbor_list.hpp"
#include "particles/particles.hpp"
#include "physics/eos.hpp"
#include "physics/gradients.hpp"

/// The reference the pair loops stand beside: the unlimited MUSCL Riemann loop of (9), (11), (12) and nothing
/// else, every column gathered where it is, vectorised by the compiler. Returns the sum of its results, so
/// that none of it can be left out. comm local
double bare_pairs(const littoral::sph::Particles<2>& particles,
                  const littoral::sph::NeighborList<2>& neighbors,
                  const littoral::sph::Gradients<2>& gradients, const littoral::sph::LinearEos& eos);
double bare_pairs(const littoral::sph::Particles<3>& particles,
                  const littoral::sph::NeighborList<3>& neighbors,
                  const littoral::sph::Gradients<3>& gradients, const littoral::sph::LinearEos& eos);
