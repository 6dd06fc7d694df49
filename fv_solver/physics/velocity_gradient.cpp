#include "physics/velocity_gradient.hpp"

#include "grid/small_matrix.hpp"

namespace littoral::fv {

template <int D>
VelocityGradient<D> velocity_gradient(const Block<D>& block, const State<D>& q, std::ptrdiff_t c) {
  std::array<std::array<double, D>, D> dx, du;  // [component][grid direction], over two cells
  for (std::size_t d = 0; d < D; ++d) {
    const auto up = static_cast<std::size_t>(c + block.extent.stride[d]);
    const auto low = static_cast<std::size_t>(c - block.extent.stride[d]);
    for (std::size_t k = 0; k < D; ++k) {
      dx[k][d] = block.centre[k][up] - block.centre[k][low];
      du[k][d] = q.u[k][up] - q.u[k][low];
    }
  }
  const auto along = inverse<D>(dx);  // [grid direction][derivative]
  VelocityGradient<D> gradient{};
  for (std::size_t k = 0; k < D; ++k)
    for (std::size_t l = 0; l < D; ++l)
      for (std::size_t d = 0; d < D; ++d) gradient[k][l] += du[k][d] * along[d][l];
  return gradient;
}

template <int D>
coupler::Vec3 vorticity(const VelocityGradient<D>& g) {
  if constexpr (D == 2)
    return {0.0, g[0][1] - g[1][0], 0.0};
  else
    return {g[2][1] - g[1][2], g[0][2] - g[2][0], g[1][0] - g[0][1]};
}

template <int D>
double q_criterion(const VelocityGradient<D>& g) {
  double q = 0.0;  // |E|^2 - |Omega|^2 = sum_ij g_ij g_ji
  for (std::size_t k = 0; k < D; ++k)
    for (std::size_t l = 0; l < D; ++l) q += g[k][l] * g[l][k];
  return q;
}

template VelocityGradient<2> velocity_gradient<2>(const Block<2>&, const State<2>&, std::ptrdiff_t);
template VelocityGradient<3> velocity_gradient<3>(const Block<3>&, const State<3>&, std::ptrdiff_t);
template coupler::Vec3 vorticity<2>(const VelocityGradient<2>&);
template coupler::Vec3 vorticity<3>(const VelocityGradient<3>&);
template double q_criterion<2>(const VelocityGradient<2>&);
template double q_criterion<3>(const VelocityGradient<3>&);

}  // namespace littoral::fv
