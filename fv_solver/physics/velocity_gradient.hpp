#pragma once

#include <array>

#include "grid/block.hpp"
#include "littoral/coupler/types.hpp"

namespace littoral::fv {

/// [component][derivative] [1/s]
template <int D>
using VelocityGradient = std::array<std::array<double, D>, D>;

/// Gradient of u at cell offset c: central differences along the grid lines, turned into space by those of
/// the centres, so exact for linear fields on any grid. pre: ghosts of q current
template <int D>
VelocityGradient<D> velocity_gradient(const Block<D>& block, const State<D>& q, std::ptrdiff_t c);

/// curl u, x y z whatever the dimension [1/s]; in the plane only the y component, du/dz - dw/dx.
template <int D>
coupler::Vec3 vorticity(const VelocityGradient<D>& gradient);

/// Q = |E|^2 - |Omega|^2 with E, Omega the symmetric and skew parts of grad u (paper, section 5.3): the
/// paper's sign, *negative* inside vortices, the opposite of the usual definition [1/s^2].
template <int D>
double q_criterion(const VelocityGradient<D>& gradient);

}  // namespace littoral::fv
