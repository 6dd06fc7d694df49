#pragma once

#include <string>

#include "bodies/walls.hpp"
#include "coupling/face_elements.hpp"
#include "coupling/zones.hpp"

namespace littoral::sph {

/// A body in the coupling layers or in an outer face: the layers drive particles into it, as the partner does
/// not know it there, and the face would count flux and make particles where it stands. Says which, where,
/// and what to do; empty: there is none. comm: local, the same on all ranks
template <int D>
std::string body_in_the_layers(const Walls<D>& walls, const Layers<D>& layers,
                               const FaceElements<D>& elements);

}  // namespace littoral::sph
