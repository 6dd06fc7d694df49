#pragma once

#include <cstddef>
#include <vector>

#include "coupling/face_elements.hpp"

namespace littoral::sph {

/// In which round each of the due elements looks for a place, so that the ranks that own them find the places
/// one rank would: an element waits for those before it in `due` that belong to another rank and are so near
/// that their particles could matter to it. Elements of one round are independent or of one rank, in order.
/// owner: rank of each of `due`. near [m]: centres further apart do not matter to each other. pure
template <int D>
std::vector<std::size_t> injection_rounds(const FaceElements<D>& elements,
                                          const std::vector<std::size_t>& due,
                                          const std::vector<std::size_t>& owner, double near);

}  // namespace littoral::sph
