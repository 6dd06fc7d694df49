#include "free_surface/fringe_faces.hpp"

#include "grid/loops.hpp"
#include "level_set/volume.hpp"

namespace littoral::fv {
namespace {

/// Value on a face from two cells' means on either side, of fourth order on a uniform grid: the mean of the
/// scheme's two third-order reconstructions.
double face_value(double before, double left, double right, double after) {
  return (7.0 * (left + right) - before - after) / 12.0;
}

}  // namespace

template <int D>
FringeFaces<D>::FringeFaces(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange) {
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
  any_ = exchange.ranks().largest(faces_.empty() ? 0.0 : 1.0) > 0.0;
}

template <int D>
double FringeFaces<D>::flux(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange,
                            const std::vector<State<D>>& states, const std::vector<Field>* phi,
                            const Fluid<D>* fluid) const {
  if (!any_) return 0.0;
  std::vector<Field> water(blocks.size());
  if (phi != nullptr) {
    for (std::size_t b = 0; b < water.size(); ++b) wet_shares<D>(blocks[b], (*phi)[b], water[b]);
    exchange.scalar(blocks, water, ScalarGhosts::cell_data);
  }
  double sum = 0.0;
  for (const Face& f : faces_) {
    const Block<D>& block = blocks[f.block];
    const State<D>& q = states[f.block];
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
    if (fluid != nullptr) flow *= fluid->rho(at(q.p));
    if (phi != nullptr)
      flow *= 0.5 * (water[f.block][static_cast<std::size_t>(f.cell)] +
                     water[f.block][static_cast<std::size_t>(f.cell + s)]);
    sum += flow;
  }
  return sum;
}

template class FringeFaces<2>;
template class FringeFaces<3>;

}  // namespace littoral::fv
