#include "implicit/transfer.hpp"

#include <cmath>

#include "grid/loops.hpp"

namespace littoral::fv {

template <int D>
Transfer<D>::Transfer(const LevelGrid<D>& fine, const LevelGrid<D>& coarse, const std::array<int, D>& ratio)
    : fine_(fine.extent), coarse_(coarse.extent) {
  for (std::size_t d = 0; d < D; ++d) {
    const int nf = fine_.n[d], nc = coarse_.n[d], r = ratio[d];
    const auto centre = [&](int i) {  // of coarse cell i in units of fine cells; outside: image
      if (i < 0) return fine.periodic[d] ? 0.5 * ((nc - 1) * r + nf) - nf : -0.5 * std::min(r, nf);
      if (i >= nc) {
        const double last = 0.5 * ((nc - 1) * r + nf);
        return fine.periodic[d] ? nf + 0.5 * r : 2.0 * nf - last;
      }
      return 0.5 * (i * r + std::min((i + 1) * r, nf));
    };
    auto& down = down_[d];
    down.resize(static_cast<std::size_t>(nf));
    for (int j = 0; j < nf; ++j) {
      Fine& f = down[static_cast<std::size_t>(j)];
      f.parent = f.neighbour = j / r;
      const double offset = j + 0.5 - centre(f.parent);
      if (std::abs(offset) < 1e-12) continue;
      f.neighbour = f.parent + (offset > 0.0 ? 1 : -1);
      f.weight = offset / (centre(f.neighbour) - centre(f.parent));
    }
    // the transpose; ghost cells carry the weights of the cells they are images of
    auto& up = up_[d];
    up.resize(static_cast<std::size_t>(nc));
    const auto collect = [&](int i, int j, double w) {
      if (w == 0.0) return;
      Coarse& target = up[static_cast<std::size_t>(i)];
      target.cell[static_cast<std::size_t>(target.count)] = j;
      target.weight[static_cast<std::size_t>(target.count++)] = w;
    };
    for (int i = 0; i < nc; ++i) {
      if (i == 0) {
        const Fine& image = down[static_cast<std::size_t>(fine.periodic[d] ? nf - 1 : 0)];
        if (fine.periodic[d] ? image.neighbour == nc : image.neighbour == -1) collect(0, -1, image.weight);
      }
      for (int j = std::max(0, i * r - 1); j < std::min(nf, (i + 1) * r + 1); ++j) {
        const Fine& f = down[static_cast<std::size_t>(j)];
        if (f.parent == i) collect(i, j, 1.0 - f.weight);
        if (f.neighbour == i && f.parent != i) collect(i, j, f.weight);
      }
      if (i == nc - 1) {
        const Fine& image = down[static_cast<std::size_t>(fine.periodic[d] ? 0 : nf - 1)];
        if (fine.periodic[d] ? image.neighbour == -1 : image.neighbour == nc) collect(i, nf, image.weight);
      }
    }
  }
  set_solved(fine, coarse);
}

template <int D>
void Transfer<D>::set_solved(const LevelGrid<D>& fine, const LevelGrid<D>& coarse) {
  fine_solved_.assign(fine_.size, 0);
  coarse_solved_.assign(coarse_.size, 0);
  for_each_cell<D>(fine_, [&](const auto&, std::ptrdiff_t c) {
    fine_solved_[static_cast<std::size_t>(c)] = fine.solved(c) ? 1 : 0;
  });
  for_each_cell<D>(coarse_, [&](const auto&, std::ptrdiff_t c) {
    coarse_solved_[static_cast<std::size_t>(c)] = coarse.solved(c) ? 1 : 0;
  });
}

namespace {

/// body(offset of the row's first cell, index of the row) for all rows of cells; scratch holds `width`
/// numbers.
template <int D, class Real, class Body>
void for_each_row(const Extent<D>& extent, std::size_t width, Body&& body) {
  const std::ptrdiff_t rows = extent.cells() / extent.n[0];
#pragma omp parallel if (extent.cells() > 16384)
  {
    std::vector<Real> scratch(width);
#pragma omp for schedule(static)
    for (std::ptrdiff_t k = 0; k < rows; ++k) {
      std::array<int, D> index{};
      std::ptrdiff_t rest = k;
      for (std::size_t d = 1; d < D; ++d) {
        index[d] = static_cast<int>(rest % extent.n[d]);
        rest /= extent.n[d];
      }
      body(index, extent.at(index), scratch.data());
    }
  }
}

/// sum[i] = sum over rows of weight * values[offset + i], i from -1 to n: one ghost at each end
template <class Real, class Rows>
void combine(const Real* values, const Rows& rows, std::size_t count, int n, Real* sum) {
  for (std::size_t k = 0; k < count; ++k) {
    const Real* __restrict row = values + rows[k].offset - 1;
    const Real w = static_cast<Real>(rows[k].weight);
    Real* __restrict s = sum;
    if (k == 0)
      for (int i = 0; i < n + 2; ++i) s[i] = w * row[i];
    else
      for (int i = 0; i < n + 2; ++i) s[i] += w * row[i];
  }
}

}  // namespace

// Both run row by row: the rows of the other level are combined first, then weighted along direction 0.

template <int D>
template <class Real>
void Transfer<D>::restrict_residual(const Correction<D, Real>& fine, Correction<D, Real>& coarse) const {
  const int n = coarse_.n[0], n_fine = fine_.n[0];
  // of each coarse cell up to four fine ones, by their place in the combined row
  std::vector<int> cell(4 * static_cast<std::size_t>(n), 0);
  std::vector<Real> weight(cell.size(), Real(0));
  for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i)
    for (std::size_t t = 0; t < static_cast<std::size_t>(up_[0][i].count); ++t) {
      cell[4 * i + t] = up_[0][i].cell[t] + 1;
      weight[4 * i + t] = static_cast<Real>(up_[0][i].weight[t]);
    }
  for_each_row<D, Real>(
      coarse_, static_cast<std::size_t>(n_fine) + 2,
      [&](const std::array<int, D>& index, std::ptrdiff_t first, Real* sum) {
        std::array<Row, k_most_rows> rows;
        std::size_t count = 1;
        rows[0] = {fine_.origin, 1.0};
        for (std::size_t d = 1; d < D; ++d) {
          const Coarse& taps = up_[d][static_cast<std::size_t>(index[d])];
          std::array<Row, k_most_rows> more;
          std::size_t m = 0;
          for (std::size_t k = 0; k < count; ++k)
            for (std::size_t t = 0; t < static_cast<std::size_t>(taps.count); ++t)
              more[m++] = {rows[k].offset + taps.cell[t] * fine_.stride[d], rows[k].weight * taps.weight[t]};
          rows = more;
          count = m;
        }
        for (std::size_t c = 0; c <= D; ++c) {
          combine(fine.q[c].data(), rows, count, n_fine, sum);
          Real* __restrict out = coarse.q[c].data() + first;
          const std::uint8_t* __restrict solved = coarse_solved_.data() + first;
          for (int i = 0; i < n; ++i) {
            const int* at = cell.data() + 4 * i;
            const Real* w = weight.data() + 4 * i;
            const Real value = w[0] * sum[at[0]] + w[1] * sum[at[1]] + w[2] * sum[at[2]] + w[3] * sum[at[3]];
            out[i] = solved[i] ? value : Real(0);
          }
        }
      });
}

template <int D>
template <class Real>
void Transfer<D>::add_prolonged(const Correction<D, Real>& coarse, Correction<D, Real>& fine) const {
  const int n = fine_.n[0], n_coarse = coarse_.n[0];
  std::vector<int> parent(static_cast<std::size_t>(n)), neighbour(parent.size());
  std::vector<Real> weight(parent.size());
  for (std::size_t i = 0; i < parent.size(); ++i) {
    parent[i] = down_[0][i].parent + 1;
    neighbour[i] = down_[0][i].neighbour + 1;
    weight[i] = static_cast<Real>(down_[0][i].weight);
  }
  for_each_row<D, Real>(
      fine_, static_cast<std::size_t>(n_coarse) + 2,
      [&](const std::array<int, D>& index, std::ptrdiff_t first, Real* sum) {
        std::array<Row, k_most_rows> rows;
        std::size_t count = 1;
        rows[0] = {coarse_.origin, 1.0};
        for (std::size_t d = 1; d < D; ++d) {
          const Fine& taps = down_[d][static_cast<std::size_t>(index[d])];
          const std::size_t before = count;
          for (std::size_t k = 0; k < before; ++k) {
            const Row row = rows[k];
            rows[k] = {row.offset + taps.parent * coarse_.stride[d], row.weight * (1.0 - taps.weight)};
            if (taps.weight != 0.0)
              rows[count++] = {row.offset + taps.neighbour * coarse_.stride[d], row.weight * taps.weight};
          }
        }
        for (std::size_t c = 0; c <= D; ++c) {
          combine(coarse.q[c].data(), rows, count, n_coarse, sum);
          Real* __restrict out = fine.q[c].data() + first;
          const std::uint8_t* __restrict solved = fine_solved_.data() + first;
          for (int i = 0; i < n; ++i) {
            const Real value =
                sum[parent[static_cast<std::size_t>(i)]] * (Real(1) - weight[static_cast<std::size_t>(i)]) +
                sum[neighbour[static_cast<std::size_t>(i)]] * weight[static_cast<std::size_t>(i)];
            out[i] += solved[i] ? value : Real(0);
          }
        }
      });
}

template <int D, class Real>
void fill_correction_ghosts(const LevelGrid<D>& grid, Correction<D, Real>& e) {
  for (std::size_t d = 0; d < D; ++d) {
    std::array<int, D> lower, upper;
    for (std::size_t k = 0; k < D; ++k) {  // ghosts of the directions done are part of the layer
      lower[k] = k < d ? -1 : 0;
      upper[k] = grid.extent.n[k] + (k < d ? 1 : 0);
    }
    lower[d] = 0;
    upper[d] = 1;
    for (std::size_t side = 0; side < 2; ++side) {
      for_each_index<D>(lower, upper, [&](std::array<int, D> index) {
        index[d] = side == 0 ? 0 : grid.extent.n[d] - 1;
        const std::ptrdiff_t c = grid.extent.at(index);
        const std::ptrdiff_t s = grid.extent.stride[d];
        const auto ghost = static_cast<std::size_t>(side == 0 ? c - s : c + s);
        if (grid.periodic[d]) {
          const std::ptrdiff_t span = s * (grid.extent.n[d] - 1);
          const auto image = static_cast<std::size_t>(side == 0 ? c + span : c - span);
          for (auto& field : e.q) field[ghost] = field[image];
          return;
        }
        std::array<int, D> inner = index;  // condition and normal of the nearest face, for edges and corners
        for (std::size_t k = 0; k < D; ++k) inner[k] = std::min(std::max(index[k], 0), grid.extent.n[k] - 1);
        const EdgeCondition condition = grid.edge[d][side][grid.face_index(static_cast<int>(d), inner)];
        if (condition == EdgeCondition::link) return;
        const auto face = static_cast<std::size_t>(grid.extent.at(inner) + (side == 0 ? 0 : s));
        std::array<double, D> area;
        for (std::size_t k = 0; k < D; ++k) area[k] = grid.area[d][k][face];
        const SmallMatrix<D> image = mirror<D>(condition, area, grid.imposed_distance[d]);
        for (std::size_t i = 0; i <= D; ++i) {
          double sum = 0.0;
          for (std::size_t j = 0; j <= D; ++j)
            sum += image[i][j] * static_cast<double>(e.q[j][static_cast<std::size_t>(c)]);
          e.q[i][ghost] = static_cast<Real>(sum);
        }
      });
    }
  }
}

template class Transfer<2>;
template class Transfer<3>;
#define LITTORAL_TRANSFER(D, Real)                                                                      \
  template void Transfer<D>::restrict_residual(const Correction<D, Real>&, Correction<D, Real>&) const; \
  template void Transfer<D>::add_prolonged(const Correction<D, Real>&, Correction<D, Real>&) const;     \
  template void fill_correction_ghosts(const LevelGrid<D>&, Correction<D, Real>&)
LITTORAL_TRANSFER(2, float);
LITTORAL_TRANSFER(2, double);
LITTORAL_TRANSFER(3, float);
LITTORAL_TRANSFER(3, double);
#undef LITTORAL_TRANSFER

}  // namespace littoral::fv
