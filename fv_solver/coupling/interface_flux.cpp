#include "coupling/interface_flux.hpp"

#include "grid/loops.hpp"

namespace littoral::fv {
namespace {

/// Value on a face from two cells' means on either side, of fourth order on a uniform grid: the mean of the
/// scheme's two third-order reconstructions.
double face_value(double before, double left, double right, double after) {
  return (7.0 * (left + right) - before - after) / 12.0;
}

}  // namespace

template <int D>
double interface_mass_flux(const std::vector<Block<D>>& blocks, const Equations<D>& equations,
                           const std::vector<State<D>>& state) {
  double flux = 0.0;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const Block<D>& block = blocks[b];
    const State<D>& q = state[b];
    for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
      const std::ptrdiff_t cell = block.extent.at(index);
      if (block.status[static_cast<std::size_t>(cell)] != CellStatus::computed) return;
      for (std::size_t d = 0; d < D; ++d)
        for (const int step : {-1, 1}) {
          std::array<int, D> other = index;
          other[d] += step;
          if (block.periodic[d]) other[d] = (other[d] + block.extent.n[d]) % block.extent.n[d];
          if (other[d] < 0 || other[d] >= block.extent.n[d]) continue;
          if (block.status[static_cast<std::size_t>(block.extent.at(other))] != CellStatus::fringe) continue;
          const std::ptrdiff_t s = step * block.extent.stride[d];  // ghosts hold the periodic images
          const auto at = [&](const Field& f) {
            return face_value(f[static_cast<std::size_t>(cell - s)], f[static_cast<std::size_t>(cell)],
                              f[static_cast<std::size_t>(cell + s)],
                              f[static_cast<std::size_t>(cell + 2 * s)]);
          };
          const auto face = static_cast<std::size_t>(step < 0 ? cell : cell + s);
          double flow = 0.0;
          for (std::size_t k = 0; k < D; ++k) flow += step * at(q.u[k]) * block.area[d][k][face];
          flux += equations.fluid.rho(at(q.p)) * flow;
        }
    });
  }
  return flux;
}

template double interface_mass_flux(const std::vector<Block<2>>&, const Equations<2>&,
                                    const std::vector<State<2>>&);
template double interface_mass_flux(const std::vector<Block<3>>&, const Equations<3>&,
                                    const std::vector<State<3>>&);

}  // namespace littoral::fv
