#include "level_set/extend.hpp"

#include <algorithm>
#include <cmath>

#include "grid/between.hpp"
#include "grid/loops.hpp"

namespace littoral::fv {
namespace {

constexpr double k_poor = 0.5;    // mark of water whose own neighbours give no full gradient
constexpr double k_beyond = 1e9;  // of cells that no pass has reached
constexpr int k_at_surface = 3;   // layers whose velocities move the surface or carry momentum through it

/// body(neighbour) for the 3^D - 1 cells around c that are cells of the grid, or ghosts that stand for one.
template <int D, class Body>
void for_each_neighbour(const Block<D>& block, const Band<D>& band, std::size_t b, std::ptrdiff_t c,
                        Body&& body) {
  for_each_around<D>(block.extent.stride, c, [&](const std::array<int, D>&, std::ptrdiff_t other) {
    if (other != c && band.stands_for_cell(b, other)) body(other);
  });
}

/// Inverse of a symmetric matrix of least squares. degenerate: there are directions in which no neighbour
/// lies; they get no gradient
template <int D>
SpaceMatrix<D> inverse_of_squares(SpaceMatrix<D> m, bool& degenerate) {
  double trace = 0.0;
  for (std::size_t k = 0; k < D; ++k) trace += m[k][k];
  double det;
  if constexpr (D == 2)
    det = m[0][0] * m[1][1] - m[0][1] * m[1][0];
  else
    det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
          m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
          m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  constexpr double k_degenerate = 1e-5, k_ridge = 1e-3;  // of the mean eigenvalue's power D; of the trace
  degenerate = det < k_degenerate * std::pow(trace / D, D);
  if (degenerate)
    for (std::size_t k = 0; k < D; ++k) m[k][k] += k_ridge * trace;
  return inverse<D>(m);
}

/// The gradient nearest to one of least squares whose divergence is 0: the change goes where the squares say
/// least. Where no neighbour lies across a thread of water, that is how the flow draws it thinner.
template <int D>
void close_divergence(const SpaceMatrix<D>& inverse, SpaceMatrix<D>& gradient) {
  double divergence = 0.0, trace = 0.0;
  for (std::size_t k = 0; k < D; ++k) {
    divergence += gradient[k][k];
    trace += inverse[k][k];
  }
  for (std::size_t k = 0; k < D; ++k)
    for (std::size_t l = 0; l < D; ++l) gradient[k][l] -= divergence / trace * inverse[l][k];
}

/// At the tip of a wedge or in a film a cell's water neighbours may lie on one line: it takes the mean
/// gradient of those that know better, if there are any.
template <int D>
void borrow_gradients(const std::vector<Block<D>>& blocks, const Band<D>& band,
                      const std::vector<Field>& reached,
                      std::vector<std::array<VectorField<D>, D>>& gradient) {
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for (const std::ptrdiff_t c : band.cells(b)) {
      if (reached[b][static_cast<std::size_t>(c)] != k_poor) continue;
      SpaceMatrix<D> sum{};
      int n = 0;
      for_each_neighbour<D>(blocks[b], band, b, c, [&](std::ptrdiff_t other) {
        if (reached[b][static_cast<std::size_t>(other)] != 0.0) return;
        ++n;
        for (std::size_t k = 0; k < D; ++k)
          for (std::size_t l = 0; l < D; ++l) sum[k][l] += gradient[b][k][l][static_cast<std::size_t>(other)];
      });
      for (std::size_t k = 0; k < D && n > 0; ++k)
        for (std::size_t l = 0; l < D; ++l) gradient[b][k][l][static_cast<std::size_t>(c)] = sum[k][l] / n;
    }
}

}  // namespace

template <int D>
void VelocityExtension<D>::gradients_of_water(const std::vector<Block<D>>& blocks, const Band<D>& band,
                                              const std::vector<VectorField<D>*>& u) {
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const Block<D>& block = blocks[b];
    const auto cells = band.cells(b);
#pragma omp parallel for schedule(static) if (cells.size() > k_cells_for_threads)
    for (std::ptrdiff_t i = 0; i < cells.size(); ++i) {
      const std::ptrdiff_t c = cells[i];
      if (reached_[b][static_cast<std::size_t>(c)] > k_poor) continue;
      SpaceMatrix<D> squares{}, sums{};  // sums[component][direction]
      for_each_neighbour<D>(block, band, b, c, [&](std::ptrdiff_t other) {
        const auto o = static_cast<std::size_t>(other);
        if (reached_[b][o] > k_poor) return;
        const SpaceVector<D> r = between(block, c, other);
        const double w = 1.0 / dot(r, r);
        for (std::size_t k = 0; k < D; ++k)
          for (std::size_t l = 0; l < D; ++l) {
            squares[k][l] += w * r[k] * r[l];
            sums[k][l] += w * ((*u[b])[k][o] - (*u[b])[k][static_cast<std::size_t>(c)]) * r[l];
          }
      });
      double trace = 0.0;
      for (std::size_t k = 0; k < D; ++k) trace += squares[k][k];
      SpaceMatrix<D> solved{};
      bool degenerate = true;
      if (trace > 0.0) {
        const SpaceMatrix<D> inverse = inverse_of_squares<D>(squares, degenerate);
        for (std::size_t k = 0; k < D; ++k) solved[k] = times(inverse, sums[k]);
        if (degenerate) close_divergence<D>(inverse, solved);
      }
      for (std::size_t k = 0; k < D; ++k)
        for (std::size_t l = 0; l < D; ++l) gradient_[b][k][l][static_cast<std::size_t>(c)] = solved[k][l];
      if (degenerate) reached_[b][static_cast<std::size_t>(c)] = k_poor;
    }
  }
}

template <int D>
void VelocityExtension<D>::reach_further(const Block<D>& block, const Band<D>& band,
                                         const SurfacePatches<D>& patches, std::size_t b, int pass,
                                         int layers, VectorField<D>& u, Pass& done) {
  bool found = false, misses = false;
  const auto cells = band.cells(b, 0, layers);
#pragma omp parallel for schedule(static) if (cells.size() > k_cells_for_threads) reduction(|| \
                                                                                            : found, misses)
  for (std::ptrdiff_t i = 0; i < cells.size(); ++i) {
    const std::ptrdiff_t c = cells[i];
    const auto at = static_cast<std::size_t>(c);
    if (reached_[b][at] < pass || !patches.has(b, c)) continue;
    const SpaceVector<D> normal = patches.foot(b, i).normal;
    double sum = 0.0, straightest = 0.0;
    SpaceVector<D> value{}, change{};
    SpaceMatrix<D> gradient{};
    for_each_neighbour<D>(block, band, b, c, [&](std::ptrdiff_t other) {
      const auto o = static_cast<std::size_t>(other);
      if (reached_[b][o] >= pass) return;
      const SpaceVector<D> r = between(block, other, c);
      const double r2 = dot(r, r), along = std::max(dot(r, normal), 0.0);
      constexpr double k_aside = 1e-2;  // of the weight straight below: where nothing else is there
      const double w = (along * along / r2 + k_aside) / r2;
      sum += w;
      straightest = std::max(straightest, along * along / r2);
      for (std::size_t k = 0; k < D; ++k) {
        value[k] += w * u[k][o];
        for (std::size_t l = 0; l < D; ++l) {
          change[k] += w * gradient_[b][k][l][o] * r[l];
          gradient[k][l] += w * gradient_[b][k][l][o];
        }
      }
    });
    if (sum == 0.0) {
      misses = misses || band.layer(b, c) < k_at_surface;
      continue;
    }
    found = true;
    constexpr double k_below = 0.25;  // squared cosine: within 60 degrees of straight below
    const double part = straightest > k_below ? 1.0 / sum : 0.0;
    for (std::size_t k = 0; k < D; ++k) {
      u[k][at] = value[k] / sum + part * change[k];
      for (std::size_t l = 0; l < D; ++l) gradient_[b][k][l][at] = part * gradient[k][l];
    }
    reached_[b][at] = pass;
  }
  done = {done.found || found, done.misses || misses};
}

template <int D>
void VelocityExtension<D>::extend(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange,
                                  const Band<D>& band, const SurfacePatches<D>& patches,
                                  const std::vector<WetMask>& wet, int layers,
                                  const std::vector<VectorField<D>*>& u) {
  const std::size_t n = blocks.size();
  gradient_.resize(n);
  reached_.resize(n);
  std::vector<std::vector<Field*>> fields(D + D * D + 1);
  for (std::size_t b = 0; b < n; ++b) {
    const std::size_t size = blocks[b].extent.size;
    reached_[b].resize(size);
    for (std::size_t c = 0; c < size; ++c) reached_[b][c] = wet[b][c] != 0 ? 0.0 : k_beyond;
    std::size_t number = 0;
    fields[number++].push_back(&reached_[b]);
    for (std::size_t k = 0; k < D; ++k) {
      fields[number++].push_back(&(*u[b])[k]);
      for (std::size_t l = 0; l < D; ++l) {
        gradient_[b][k][l].resize(size);
        fields[number++].push_back(&gradient_[b][k][l]);
      }
    }
  }
  gradients_of_water(blocks, band, u);
  exchange.scalars(blocks, fields, ScalarGhosts::cell_data);
  borrow_gradients<D>(blocks, band, reached_, gradient_);
  bool more = true;
  for (int pass = 1; more; ++pass) {
    exchange.scalars(blocks, fields, ScalarGhosts::cell_data);
    Pass done;
    for (std::size_t b = 0; b < n; ++b)
      reach_further(blocks[b], band, patches, b, pass, pass <= layers ? band.layers() : k_at_surface, *u[b],
                    done);
    more = pass < layers || (exchange.ranks().any(done.misses) && exchange.ranks().any(done.found));
  }
  exchange.scalars(blocks, fields, ScalarGhosts::cell_data);
}

template <int D>
bool VelocityExtension<D>::reached(std::size_t block, std::size_t cell) const {
  return reached_[block][cell] < k_beyond;
}

template class VelocityExtension<2>;
template class VelocityExtension<3>;

}  // namespace littoral::fv
