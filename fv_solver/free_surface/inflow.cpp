#include "free_surface/inflow.hpp"

#include "boundary/boundary_flux.hpp"
#include "boundary/line.hpp"
#include "boundary/opening.hpp"
#include "grid/loops.hpp"
#include "level_set/volume.hpp"

namespace littoral::fv {
namespace {

/// Part of a boundary face under the surface.
template <int D>
double wet_part(const Block<D>& block, const Field& phi, const Line<D>& line, std::size_t normal) {
  std::array<double, D> slope{};
  for (std::size_t d = 0; d < D; ++d) {
    if (d == normal) continue;
    const auto s = static_cast<std::size_t>(block.extent.stride[d]);
    slope[d] = 0.25 * (phi[line.inner[0] + s] - phi[line.inner[0] - s]);
  }
  return wet_share<D>(0.5 * (phi[line.inner[0]] + phi[line.ghost[0]]), slope);
}

/// Volume flux along +direction of the mean of both sides' third-order values.
template <int D>
double central_flux(const Block<D>& block, const State<D>& q, const Line<D>& line, std::size_t direction) {
  double flux = 0.0;
  for (std::size_t k = 0; k < D; ++k) {
    const Field& u = q.u[k];
    const double near = u[line.inner[0]] + u[line.ghost[0]], far = u[line.inner[1]] + u[line.ghost[1]];
    flux += block.area[direction][k][line.face] * (0.5 * near + (near - far) / 12.0);
  }
  return flux;
}

}  // namespace

template <int D>
double inflow_through_openings(const std::vector<Block<D>>& blocks, const Equations<D>& equations, double dt,
                               const std::vector<Field>& phi, const std::vector<State<D>>& q) {
  double sum = 0.0;
  BoundaryFluxes<D> fluxes;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const Block<D>& block = blocks[b];
    bool any = false;
    for (const Window<D>& w : block.windows) any = any || is_opening(w.condition);
    if (!any) continue;
    Field p = q[b].p;
    for (std::size_t c = 0; c < p.size(); ++c) p[c] -= block.reference_pressure[c];
    compute_boundary_fluxes<D>(block, equations.fluid, equations.speeds, dt, p.data(), q[b], fluxes);
    for (const Window<D>& w : block.windows) {
      if (!is_opening(w.condition)) continue;
      const auto d = static_cast<std::size_t>(w.direction);
      const FaceFlux<D>& given = fluxes[d][static_cast<std::size_t>(w.side)];
      std::array<int, D> lower = w.lower, upper = w.upper;
      lower[d] = w.side == 0 ? 0 : block.extent.n[d] - 1;
      upper[d] = lower[d] + 1;
      for_each_index<D>(lower, upper, [&](const std::array<int, D>& index) {
        const Line<D> line(block, w, block.extent.at(index));
        const double wet = wet_part<D>(block, phi[b], line, d);
        if (wet == 0.0) return;
        const std::size_t position = face_position<D>(block, d, index);
        const double flux = given.given[position] != 0 ? given.mass[position] / equations.fluid.density
                                                       : central_flux<D>(block, q[b], line, d);
        sum += (w.side == 0 ? 1.0 : -1.0) * wet * flux;
      });
    }
  }
  return sum;
}

template double inflow_through_openings<2>(const std::vector<Block<2>>&, const Equations<2>&, double,
                                           const std::vector<Field>&, const std::vector<State<2>>&);
template double inflow_through_openings<3>(const std::vector<Block<3>>&, const Equations<3>&, double,
                                           const std::vector<Field>&, const std::vector<State<3>>&);

}  // namespace littoral::fv
