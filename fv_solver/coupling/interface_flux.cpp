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
InterfaceFlux<D>::InterfaceFlux(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange)
    : ranks_(exchange.ranks()) {
  std::vector<Field> fringe;  // 1 in fringe cells, and ghosts that stand for one
  for (const Block<D>& block : blocks) {
    fringe.emplace_back(block.extent.size, 0.0);
    for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
      const auto c = static_cast<std::size_t>(block.extent.at(index));
      if (block.status[c] == CellStatus::fringe) fringe.back()[c] = 1.0;
    });
  }
  exchange.scalar(blocks, fringe, ScalarGhosts::cell_data);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const Block<D>& block = blocks[b];
    for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
      const std::ptrdiff_t cell = block.extent.at(index);
      if (block.status[static_cast<std::size_t>(cell)] != CellStatus::computed) return;
      for (std::size_t d = 0; d < D; ++d)
        for (const int step : {-1, 1})
          if (fringe[b][static_cast<std::size_t>(cell + step * block.extent.stride[d])] != 0.0)
            faces_.push_back({b, d, cell, step});
    });
  }
}

template <int D>
double InterfaceFlux<D>::mass_flux(const Stepper<D>& stepper) const {
  double flux = 0.0;
  std::vector<Field> water(stepper.blocks().size());
  if (stepper.surface() != nullptr) {
    for (std::size_t b = 0; b < water.size(); ++b)
      wet_shares<D>(stepper.blocks()[b], stepper.surface()->phi()[b], water[b]);
    stepper.exchange().scalar(stepper.blocks(), water, ScalarGhosts::cell_data);
  }
  for (const Face& f : faces_) {
    const Block<D>& block = stepper.blocks()[f.block];
    const State<D>& q = stepper.state()[f.block];
    const std::ptrdiff_t s =
        f.step * block.extent.stride[f.direction];  // ghosts hold images and other blocks
    const auto at = [&](const Field& field) {
      return face_value(field[static_cast<std::size_t>(f.cell - s)], field[static_cast<std::size_t>(f.cell)],
                        field[static_cast<std::size_t>(f.cell + s)],
                        field[static_cast<std::size_t>(f.cell + 2 * s)]);
    };
    const auto face = static_cast<std::size_t>(f.step < 0 ? f.cell : f.cell + s);
    double flow = 0.0;
    for (std::size_t k = 0; k < D; ++k) flow += f.step * at(q.u[k]) * block.area[f.direction][k][face];
    double share = 1.0;
    if (stepper.surface() != nullptr)
      share = 0.5 * (water[f.block][static_cast<std::size_t>(f.cell)] +
                     water[f.block][static_cast<std::size_t>(f.cell + s)]);
    flux += share * stepper.equations().fluid.rho(at(q.p)) * flow;
  }
  return ranks_.sum(flux);
}

template class InterfaceFlux<2>;
template class InterfaceFlux<3>;

}  // namespace littoral::fv
