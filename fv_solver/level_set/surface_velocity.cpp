#include <algorithm>
#include <cmath>

#include "grid/loops.hpp"
#include "level_set/extend.hpp"
#include "level_set/taylor.hpp"

namespace littoral::fv {
namespace {

template <int D>
struct Local {
  SpaceVector<D> u{};         // [m/s]
  SpaceMatrix<D> gradient{};  // [component][derivative] [1/s]
};

/// u and its gradient at the place r [m] from the centre of cell c: quadratic Lagrange polynomials along each
/// direction of the grid around the cell nearest to the place, as far as ghosts reach; or, if `keep`, around
/// the one at `step`, of the call before.
template <int D>
Local<D> interpolate(const Block<D>& block, const VectorField<D>& u, std::ptrdiff_t c,
                     const SpaceVector<D>& r, bool keep, StencilStep<D>& step) {
  const LocalMap<D> map(block, c);
  SpaceVector<D> xi = map.index_of(r);
  const std::array<int, D> index = block.extent.index(c);
  std::array<int, D> centre = index;
  std::array<std::array<double, 3>, D> weight, slope;
  for (std::size_t d = 0; d < D; ++d) {
    if (!std::isfinite(xi[d])) xi[d] = 0.0;
    if (!keep) step[d] = static_cast<std::int8_t>(std::lround(std::clamp(xi[d], -2.0, 2.0)));
    centre[d] = std::clamp(index[d] + step[d], -1, block.extent.n[d]);
    constexpr double k_outside = 1.0;  // no further than the stencil
    const double x = std::clamp(xi[d] - (centre[d] - index[d]), -k_outside, k_outside);
    weight[d] = {0.5 * x * (x - 1.0), 1.0 - x * x, 0.5 * x * (x + 1.0)};
    slope[d] = {x - 0.5, -2.0 * x, x + 0.5};
  }
  Local<D> local;
  SpaceMatrix<D> by_index{};  // [component][direction]
  const auto& stride = block.extent.stride;
  for_each_around<D>(stride, block.extent.at(centre),
                     [&](const std::array<int, D>& corner, std::ptrdiff_t at) {
                       double w = 1.0;
                       SpaceVector<D> dw;
                       dw.fill(1.0);
                       for (std::size_t d = 0; d < D; ++d) {
                         const auto s = static_cast<std::size_t>(corner[d] + 1);
                         w *= weight[d][s];
                         for (std::size_t k = 0; k < D; ++k) dw[k] *= k == d ? slope[d][s] : weight[d][s];
                       }
                       for (std::size_t k = 0; k < D; ++k) {
                         const double value = u[k][static_cast<std::size_t>(at)];
                         local.u[k] += w * value;
                         for (std::size_t d = 0; d < D; ++d) by_index[k][d] += dw[d] * value;
                       }
                     });
  for (std::size_t k = 0; k < D; ++k)
    for (std::size_t l = 0; l < D; ++l)
      for (std::size_t d = 0; d < D; ++d) local.gradient[k][l] += by_index[k][d] * map.to_index[d][l];
  return local;
}

}  // namespace

template <int D>
void SurfaceVelocity<D>::follow(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange,
                                const Band<D>& band, const SurfacePatches<D>& patches,
                                const std::vector<Field>& phi, const std::vector<const VectorField<D>*>& u,
                                bool settled, std::vector<VectorField<D>>& u_s) {
  base_.resize(blocks.size());
  step_.resize(blocks.size());
  gradient_.resize(blocks.size());
  u_s.resize(blocks.size());
  std::vector<std::vector<Field*>> carried(D + D * D), result(D);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (!settled) step_[b].assign(static_cast<std::size_t>(band.cells(b, 0, 1).size()), {});
    std::size_t number = 0;
    const auto field = [&](Field& f) {
      f.resize(blocks[b].extent.size);
      return &f;
    };
    for (std::size_t k = 0; k < D; ++k) {
      result[k].push_back(field(u_s[b][k]));
      carried[number++].push_back(field(base_[b][k]));
      for (std::size_t l = 0; l < D; ++l) carried[number++].push_back(field(gradient_[b][k][l]));
    }
  }
  for (int layer = 0; layer < band.layers(); ++layer) {
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      const Block<D>& block = blocks[b];
      const auto cells = band.cells(b, layer, layer + 1);
      const std::ptrdiff_t before = cells.begin() - band.cells(b).begin();
#pragma omp parallel for schedule(static) if (cells.size() > k_cells_for_threads)
      for (std::ptrdiff_t i = 0; i < cells.size(); ++i) {
        const std::ptrdiff_t c = cells[i];
        const auto at = static_cast<std::size_t>(c);
        Local<D> local;
        SpaceVector<D> aside{};  // of the foot from the base
        if (layer == 0) {
          SurfacePatch<D> patch;
          if (!own_patch(block, band, phi[b], b, c, patch) && patches.has(b, c)) patch = patches.at(b, c);
          local =
              interpolate<D>(block, *u[b], c, patch.to_base, settled, step_[b][static_cast<std::size_t>(i)]);
        } else if (patches.has(b, c)) {
          const auto from = static_cast<std::size_t>(patches.source(block, b, c));
          const SpaceVector<D> base = patches.at(b, c).to_base, foot = patches.foot(b, before + i).to;
          for (std::size_t k = 0; k < D; ++k) {
            aside[k] = foot[k] - base[k];
            local.u[k] = base_[b][k][from];
            for (std::size_t l = 0; l < D; ++l) local.gradient[k][l] = gradient_[b][k][l][from];
          }
        }
        for (std::size_t k = 0; k < D; ++k) {
          base_[b][k][at] = local.u[k];
          for (std::size_t l = 0; l < D; ++l) gradient_[b][k][l][at] = local.gradient[k][l];
          u_s[b][k][at] = local.u[k] + dot(local.gradient[k], aside);
        }
      }
    }
    if (layer + 1 < band.layers()) exchange.scalars(blocks, carried, ScalarGhosts::cell_data);
  }
  exchange.scalars(blocks, result, ScalarGhosts::cell_data);
}

template class SurfaceVelocity<2>;
template class SurfaceVelocity<3>;

}  // namespace littoral::fv
